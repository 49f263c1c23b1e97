//! `unwrapd verify`: what can be proven of existing UVs.

use super::console::{self, Lines, print_json, say};
use super::failure::Failure;
use super::input::read_upload;
use super::measure::{Which, certificate_text};
use crate::certificate::Overlap;
use crate::pipeline::{Proven, verify_document};

/// Checks exactly that every face of a file's UVs is positive relative to its chart, and what else is asked for.
#[derive(clap::Args)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "switches of the command line"
)]
pub(super) struct Args {
    #[command(flatten)]
    which: Which,
    /// Also check that no face overlaps another
    #[arg(long)]
    bijective: bool,
    /// Also check that no chart is seen from behind
    #[arg(long)]
    unmirrored: bool,
    /// Print the certificates as JSON
    #[arg(long)]
    json: bool,
    /// Say it with the exit status alone
    #[arg(short, long, conflicts_with = "json")]
    quiet: bool,
}

/// Runs `verify`; a file of which something asked for does not hold ends with exit status 4.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if args.quiet {
        console::direct(Lines::None);
    }
    let upload = read_upload(&args.which.input)?;
    let options = args.which.options();
    let is_alone = !args.bijective && options.padding.is_none() && options.bits.is_none();
    let overlap = if is_alone {
        Overlap::Skip
    } else {
        Overlap::Test
    };
    let verified = verify_document(&upload, &options, overlap)?;
    if args.json {
        print_json(&verified)?;
    } else {
        for group in &verified.groups {
            let text = certificate_text(&group.certificate);
            say(format_args!("{}: {text}", group.name));
        }
    }
    let proven = &verified.proven;
    if !holds(args, proven) {
        return Err(Failure::uncertified(format!("not valid: {proven}")));
    }
    if !args.json {
        say(format_args!("valid: {proven}"));
    }
    Ok(())
}

/// Whether everything that was asked for is proven.
fn holds(args: &Args, proven: &Proven) -> bool {
    proven.locally_injective
        && (proven.bijective || !args.bijective)
        && (proven.unmirrored || !args.unmirrored)
        && proven.padding.as_ref().is_none_or(|padding| padding.kept)
        && proven.aligned.unwrap_or(true)
        && proven.pages.as_ref().is_none_or(|pages| pages.kept)
        && proven.bits.as_ref().is_none_or(|bits| bits.hold)
}

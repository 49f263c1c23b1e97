//! `unwrapd verify`: what can be proven of existing UVs.

use super::console::{self, Lines, print_json, say, warn};
use super::failure::Failure;
use super::input::read_upload;
use super::measure::{Which, certificate_text};
use crate::certificate::Overlap;
use crate::pipeline::{Mirrored, verify_document};

/// The arguments of `verify`.
#[derive(clap::Args)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "switches of the command line"
)]
pub(super) struct Args {
    #[command(flatten)]
    which: Which,
    /// Also prove that no two faces overlap
    #[arg(long)]
    bijective: bool,
    /// Also prove that no chart is mirrored
    #[arg(long)]
    unmirrored: bool,
    /// Print the certificates as JSON
    #[arg(long)]
    json: bool,
    /// Print nothing; the exit status tells the result
    #[arg(short, long, conflicts_with = "json")]
    quiet: bool,
}

/// Runs `verify`; a file of which something asked for does not hold ends with exit status 4.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if args.quiet {
        console::direct(Lines::None);
    }
    let upload = read_upload(&args.which.mapped.input)?;
    let overlap = if args.bijective {
        Overlap::Test
    } else {
        Overlap::Skip
    };
    let verified = verify_document(&upload, &args.which.options, overlap)?;
    if args.json {
        print_json(&verified)?;
    } else {
        if let Some(mark) = &verified.mark {
            say(format_args!("judged by the record in the file: {mark}"));
        }
        for group in &verified.groups {
            let text = certificate_text(&group.certificate);
            say(format_args!("{}: {text}", group.label));
        }
    }
    warn(&verified.warnings);
    let proven = &verified.proven;
    let is_bijectivity_asked = args.bijective || verified.is_bijectivity_promised();
    let asked = (
        if is_bijectivity_asked {
            Overlap::Test
        } else {
            Overlap::Skip
        },
        if args.unmirrored {
            Mirrored::Refused
        } else {
            Mirrored::Allowed
        },
    );
    if !proven.lacks(asked.0, asked.1).is_empty() {
        return Err(Failure::uncertified(format!("not valid: {proven}")));
    }
    if !args.json {
        say(format_args!("valid: {proven}"));
    }
    Ok(())
}

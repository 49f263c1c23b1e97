//! `unwrapd verify`: proofs about existing UVs.

use super::console::{self, Lines, print_json, say, warn};
use super::failure::Failure;
use super::input::{Mapped, read_upload};
use super::measure::certificate_text;
use unwrapd_pipeline::{VerifyOptions, verify_document};

/// The arguments of `verify`.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    mapped: Mapped,
    #[command(flatten)]
    options: VerifyOptions,
    /// Print the certificates as JSON
    #[arg(long)]
    json: bool,
    /// Print nothing; the exit status tells the result
    #[arg(short, long, conflicts_with = "json")]
    quiet: bool,
}

/// Runs `verify`; exits with 4 if a requested property does not hold.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if args.quiet {
        console::direct(Lines::None);
    }
    // Judge the file.
    let upload = read_upload(&args.mapped.input)?;
    let verified = verify_document(&upload, &args.options)?;
    // Print what was required, and the certificates.
    if args.json {
        print_json(&verified)?;
    } else {
        say(format_args!("judged: {}", verified.judged));
        if let Some(mark) = &verified.mark {
            let required = mark.terms.to_string();
            if !required.is_empty() {
                say(format_args!(
                    "required by the record in the file: {required}"
                ));
            }
            let made_for = mark.terms.group_by;
            if made_for != verified.judged.group_by && args.options.judged.group_by.is_none() {
                say(format_args!(
                    "the record says that the UVs were made with --group-by {made_for}"
                ));
            }
        }
        for group in &verified.groups {
            let text = certificate_text(&group.certificate);
            say(format_args!("{}: {text}", group.label));
        }
    }
    warn(&verified.warnings);
    // Fail if a requirement does not hold.
    if !verified.certified {
        let lacking = verified.lacking.join(", ");
        return Err(Failure::uncertified(format!("not valid: {lacking}")));
    }
    if !args.json {
        say(format_args!("valid: {}", verified.proven));
    }
    Ok(())
}

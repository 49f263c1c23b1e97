//! `unwrapd warp`: warping of a picture by handles.

use std::path::PathBuf;

use super::console::{json, print_json, say, warn};
use super::failure::Failure;
use super::format::check_png;
use super::input::{read_file, read_upload};
use super::output::{OutputArgs, Outputs, caller};
use super::progress::Display;
use unwrapd_api::options::help_of;
use unwrapd_deform::Units;
use unwrapd_deform::warp::parse_handles;
use unwrapd_pipeline::{CommandOptions, PullReport, WarpOptions, warp_file};

/// Warps a picture by handles without folding it.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Picture: .png or .jpg; `-` is standard input
    #[arg(value_name = "IN")]
    input: PathBuf,
    #[arg(long, value_name = "H.json", help = help_of::<WarpOptions>("handles"))]
    handles: PathBuf,
    /// Output picture, as PNG; `-` is standard output
    #[arg(short, long, value_name = "OUT.png")]
    output: PathBuf,
    /// Write a report as JSON: status, iterations, energy, residual, proofs
    #[arg(long, value_name = "FILE", help_heading = "Files and messages")]
    report: Option<PathBuf>,
    #[command(flatten)]
    files: OutputArgs,
    #[command(flatten)]
    options: WarpOptions,
}

/// Runs `warp`; exits with 4 if the map has an inverted triangle, or is not bijective with a fixed border, and with 5
/// if targets cannot be reached.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    // Check options and paths before the work.
    let mut options = WarpOptions {
        caller: caller(&args.output),
        ..args.options.clone()
    };
    options.check().map_err(Failure::of_options)?;
    check_png(&args.output)?;
    let (report, inputs) = (&args.report, [args.input.as_path(), &args.handles]);
    let outputs = Outputs::check(&args.output, &[report], &inputs, &args.files)?;
    // Read the inputs and warp.
    options.handles = parse_handles(&read_file(&args.handles)?)?;
    let upload = read_upload(&args.input)?;
    let display = Display::new(&args.files.talk);
    let warped = warp_file(&upload, &options, &display);
    display.finish()?;
    let warped = warped?;
    // Write the result, even one without a certificate, and report.
    let written = outputs.write(&warped.files, &[(report, &json(&warped.report)?)])?;
    if args.files.talk.json {
        print_json(&warped.report)?;
    }
    warn(&warped.report.warnings);
    print_pull("", &warped.report.map);
    written.tell();
    if !warped.report.certified {
        return Err(Failure::uncertified("the map is not valid"));
    }
    Failure::unless_complete(warped.report.completion)
}

/// Prints one line about a map.
pub(super) fn print_pull(name: &str, report: &PullReport) {
    let summary = &report.summary;
    say(format_args!(
        "{name}{:?}: {} iterations, {} factorizations, energy {:.6e} {}, residual {:.1e}, {} inverted, {}",
        summary.status,
        summary.iterations,
        summary.factorizations,
        summary.energy,
        Units::Normalized,
        summary.residual,
        report.certificate.inverted,
        if report.bijective {
            "bijective"
        } else {
            "not bijective"
        }
    ));
}

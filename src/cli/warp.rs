//! `unwrapd warp`: a picture pulled by handles.

use std::path::PathBuf;

use super::console::{json, print_json, say, warn};
use super::failure::Failure;
use super::format::check_png;
use super::input::{read_file, read_upload};
use super::model::ModelArgs;
use super::output::{OutputArgs, Outputs, stem};
use super::progress::Display;
use crate::deform::warp::parse_handles;
use crate::pipeline::{Limits, PullReport, WarpOptions, warp_file};

/// Warps a picture by handles without folding it.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Picture: .png or .jpg; `-` is standard input
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// Handles in pixels, y down: {"handles": [{"at": [x, y], "to": [x, y]}, …]}. Each takes hold of its own point; next to
    /// a fixed border of the nearest inner vertex of the grid, whose target is shifted by the same offset
    #[arg(long, value_name = "H.json")]
    handles: PathBuf,
    /// Where the warped picture goes, as PNG; `-` is standard output
    #[arg(short, long, value_name = "OUT.png")]
    output: PathBuf,
    /// Cells of the grid along the longer side
    #[arg(long, default_value_t = 40, value_name = "N")]
    grid: usize,
    /// Hold the border, so that the map is bijective; handles next to it take hold of inner vertices
    #[arg(long)]
    fix_border: bool,
    /// End with the current valid map after this many seconds
    #[arg(long, value_name = "SECONDS")]
    time_budget: Option<f64>,
    /// Write a JSON report: status, iterations, energy, residual, what is proven
    #[arg(long, value_name = "FILE", help_heading = "Files and messages")]
    report: Option<PathBuf>,
    #[command(flatten)]
    files: OutputArgs,
    #[command(flatten)]
    model: ModelArgs,
}

/// Runs `warp`; exit 4 if the map has an inverted triangle, or with a fixed border is not bijective.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let mut options = WarpOptions {
        handles: Vec::new(),
        grid: args.grid,
        fix_border: args.fix_border,
        model: args.model.model(),
        time_budget: args.time_budget,
        stem: stem(&args.output),
        limits: Limits::default(),
    };
    options.check().map_err(Failure::of_options)?;
    check_png(&args.output)?;
    let (report, inputs) = (&args.report, [args.input.as_path(), &args.handles]);
    let outputs = Outputs::check(&args.output, &[report], &inputs, &args.files)?;
    options.handles = parse_handles(&read_file(&args.handles)?)?;
    let upload = read_upload(&args.input)?;
    let display = Display::new(&args.files.talk);
    let warped = warp_file(&upload, &options, &display);
    display.finish()?;
    let warped = warped?;
    outputs.write(&warped.files, &[(report, &json(&warped.report)?)])?;
    if args.files.talk.json {
        print_json(&warped.report)?;
    }
    warn(&warped.report.warnings);
    print_pull("", &warped.report.map);
    if warped.report.certified {
        Ok(())
    } else {
        Err(Failure::uncertified("the map is not valid"))
    }
}

/// One line about a map.
pub(super) fn print_pull(name: &str, report: &PullReport) {
    let summary = &report.summary;
    say(format_args!(
        "{name}{:?}: {} iterations, {} factorizations, energy {:.6e}, residual {:.1e}, {} inverted, {}",
        summary.status,
        summary.iterations,
        summary.factorizations,
        summary.energy,
        summary.residual,
        report.certificate.inverted,
        if report.bijective {
            "bijective"
        } else {
            "not bijective"
        }
    ));
}

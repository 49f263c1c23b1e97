//! `unwrapd measure`: the quality of existing UVs.

use super::console::{print_json, warn};
use super::failure::Failure;
use super::input::{Mapped, read_upload};
use unwrapd_maps::certificate::Certificate;
use unwrapd_pipeline::{self as pipeline, MeasureOptions};

/// Measures the UVs of a file: distortion, seams, packing, overlaps.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    mapped: Mapped,
    #[command(flatten)]
    options: MeasureOptions,
    /// Print the whole report as JSON
    #[arg(long)]
    json: bool,
}

/// Runs `measure`.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let upload = read_upload(&args.mapped.input)?;
    let report = pipeline::measure_document(&upload, &args.options)?;
    if args.json {
        print_json(&report)?;
    } else {
        super::table::print(&report.groups);
        warn(&report.warnings);
    }
    Ok(())
}

/// Formats the counts of faces and defects.
pub(super) fn certificate_text(certificate: &Certificate) -> String {
    let overlap = certificate
        .overlapping_pairs
        .map_or(String::new(), |n| format!(", {n} overlapping pairs"));
    format!(
        "{} faces ({} exempt), {} flipped, {} degenerate{overlap}",
        certificate.faces, certificate.exempt_faces, certificate.flipped, certificate.degenerate
    )
}

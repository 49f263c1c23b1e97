//! `unwrapd deform --cage`: the surfaces of a file in a cage of voxels.

use std::time::Instant;

use super::deform::{Args, read_handles};
use super::failure::Failure;
use super::files::{output_format, read_upload, say, write_outputs};
use super::solution::solve;
use crate::deform::Method;
use crate::pipeline::{CageOptions, CagedDocument};

/// Runs `deform` with a cage of `n_voxels` along its longest side.
pub(super) fn run(args: &Args, n_voxels: u32) -> Result<(), Failure> {
    let stem = args.output.file_stem().unwrap_or_default();
    let options = CageOptions {
        n_voxels,
        model: args.model(),
        format: output_format(&args.output)?,
        stem: stem.to_string_lossy().into_owned(),
    };
    let clock = Instant::now();
    let upload = read_upload(&args.input)?;
    let handles = read_handles(&args.handles)?;
    let caged = CagedDocument::read(&upload, &handles, options)?;
    let setup_seconds = clock.elapsed().as_secs_f64();
    let records = &args.records;
    let solved = solve(
        caged.problem(),
        Method::Projected,
        setup_seconds,
        records,
        None,
    )?;
    let (written, report) = caged.write(&solved.solution)?;
    write_outputs(&args.output, &written.files)?;
    for remark in &written.notes.remarks {
        say(format_args!("{remark}"));
    }
    say(format_args!(
        "{} voxels, {} tetrahedra, {} surface vertices, crossings {} before, {} after",
        report.voxels,
        report.tets,
        report.surface_vertices,
        report.crossings_before.pairs,
        report.crossings_after.pairs
    ));
    solved.finish(records, Some(report))
}

//! Deformation of files by handles: meshes, pictures, drawings, and surfaces in a cage.

use super::caged;
use super::frames::Frames;
use super::solution::{Deformed, solve};
use super::source::Source;
use crate::PipelineError;
use crate::arrays::unwrap::in_pool;
use crate::observer::Observer;
use crate::options::{CommandOptions, DeformOptions};
use crate::start::start;
use crate::tracker::Tracker;
use unwrapd_api::Stage;
use unwrapd_deform::{Problem, ProblemError};
use unwrapd_files::document::Upload;
use unwrapd_method::solver::Watch;

/// Deforms a planar or tetrahedral mesh, a picture's outline, a drawing, or surfaces in a cage by handles. With a
/// barrier no element is inverted in any iterate.
pub fn deform_file(
    upload: &Upload,
    options: &DeformOptions,
    observer: &dyn Observer,
) -> Result<Deformed, PipelineError> {
    options.check()?;
    if options.handles.is_empty() {
        return Err(ProblemError::NoHandle.into());
    }
    let tracker = Tracker::new(observer, options.caller.budget(options.budget));
    in_pool(options.caller.workers(options.workers), || {
        match options.cage {
            Some(n_voxels) => caged::deform(upload, options, n_voxels, &tracker),
            None => deform_body(upload, options, &tracker),
        }
    })?
}

fn deform_body(
    upload: &Upload,
    options: &DeformOptions,
    tracker: &Tracker,
) -> Result<Deformed, PipelineError> {
    // Read the body, bind the handles, and take the given start.
    tracker.stage(Stage::Read);
    let source = Source::read(upload, options.triangles, &options.caller.limits)?;
    let format = options.format.unwrap_or_else(|| source.format(upload));
    source.check(format, options.frames)?;
    let mut problem = Problem::new(source.body()?, &options.handles, &options.model)?;
    problem.search = options.pulling.search;
    if let Some(start) = start(upload, problem.start.len())? {
        problem.start = start;
        problem.untangle_start()?;
    }
    // Solve.
    let file = |x: &[f64]| source.frame(format, &problem, x);
    let frames = Frames {
        tracker,
        file: &file,
    };
    let viewer: Option<&dyn Watch> = if options.frames { Some(&frames) } else { None };
    let solved = solve(&problem, options.plan(), tracker, viewer)?;
    // Write the deformed body.
    tracker.stage(Stage::Write);
    Ok(Deformed {
        files: source.files(
            format,
            &options.caller.stem(upload),
            &problem,
            &solved.solution.x,
        )?,
        report: solved.report,
        trace: solved.trace,
    })
}

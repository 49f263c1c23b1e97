//! Solution of problems, from files and in memory.

use super::caged;
use super::solution::{DeformReport, Deformed, FrameObserver, solve};
use super::source::{Source, selection};
use crate::arrays::unwrap::in_pool;
use crate::documents::corner_selection::VertexSelection;
use crate::observer::Observer;
use crate::options::{CommandOptions, DeformOptions, SolveOptions};
use crate::start::{numbers, start};
use crate::tracker::Tracker;
use crate::{PipelineError, limits};
use unwrapd_api::{Limits, START, Stage};
use unwrapd_deform::{Handle, Problem, ProblemError, ProblemFile, ProblemHandles, Solution};
use unwrapd_files::document::{DocumentError, Upload};
use unwrapd_files::io::{ElementFormat, Elements};
use unwrapd_method::solver::Watch;

/// Solves a problem file, whose mesh and start are members of the upload. With a barrier no element is inverted in
/// any iterate.
pub fn solve_file(
    upload: &Upload,
    options: &SolveOptions,
    observer: &dyn Observer,
) -> Result<Deformed, PipelineError> {
    options.check()?;
    let tracker = Tracker::new(observer, options.caller.budget(options.budget));
    in_pool(options.caller.workers(options.workers), || {
        // Read the problem.
        tracker.stage(Stage::Read);
        let (mut problem, elements) = read(upload, &options.caller.limits)?;
        problem.search = options.pulling.search;
        // Solve it; frames show each iterate in the format of the result.
        let file = |x: &[f64]| options.format.write(&elements, &problem, x);
        let frames = FrameObserver {
            tracker: &tracker,
            file: &file,
        };
        let viewer: Option<&dyn Watch> = if options.frames { Some(&frames) } else { None };
        let solved = solve(&problem, options.plan(), &tracker, viewer)?;
        // Write the result.
        tracker.stage(Stage::Write);
        let stem = options.caller.stem(upload);
        Ok(Deformed {
            files: vec![(
                format!("{stem}.{}", options.format.extension()),
                file(&solved.solution.x),
            )],
            report: solved.report,
            trace: solved.trace,
        })
    })?
}

/// Solves a problem in memory, with the options that do not concern files. `viewer` sees every iterate once, and may
/// end the work early with the current map.
pub fn solve_problem(
    problem: &Problem,
    options: &SolveOptions,
    observer: &dyn Observer,
    viewer: &(dyn Watch + Sync),
) -> Result<(Solution, DeformReport), PipelineError> {
    options.check()?;
    let tracker = Tracker::new(observer, options.caller.budget(options.budget));
    in_pool(options.caller.workers(options.workers), || {
        let problem = Problem {
            search: options.pulling.search,
            ..problem.clone()
        };
        let solved = solve(&problem, options.plan(), &tracker, Some(viewer))?;
        Ok((solved.solution, solved.report))
    })?
}

/// Reads the problem and the mesh that its file names.
fn read(upload: &Upload, limits: &Limits) -> Result<(Problem, Elements), PipelineError> {
    let mut file = ProblemFile::parse(&upload.bytes)?;
    let format = ElementFormat::of_name(&file.mesh).ok_or(DocumentError::UnknownFormat)?;
    let elements = format.read(member(upload, &file.mesh)?)?;
    limits::check_count(limits, elements.triangles.len() + elements.tets.len())?;
    if let ProblemHandles::Handles(handles) = &mut file.handles {
        let selected = || {
            let mesh = Upload {
                name: file.mesh.clone(),
                bytes: member(upload, &file.mesh)?.to_vec(),
                resources: upload.resources.clone(),
            };
            selection(&mesh, &elements)
        };
        fill(handles, selected)?;
    }
    let start = file.initial.as_ref().map(|initial| {
        Ok::<_, PipelineError>(numbers(member(upload, initial)?).ok_or_else(|| {
            ProblemError::Malformed(format!("{initial} is not a list of numbers"))
        })?)
    });
    let problem = file.with(elements.clone(), start.transpose()?)?;
    Ok((problem, elements))
}

/// Returns a file that the problem names, by its path, or by its name if the client sent only that.
fn member<'a>(upload: &'a Upload, path: &str) -> Result<&'a [u8], PipelineError> {
    let name = path.rsplit('/').next().unwrap_or_default();
    let bytes = upload.resources.get(path).or(upload.resources.get(name));
    let bytes = bytes.ok_or_else(|| DocumentError::MissingResource(path.to_owned()))?;
    Ok(bytes)
}

// Deformation of files by handles: meshes, pictures, drawings, and surfaces in a cage.

/// Deforms a planar or tetrahedral mesh, a picture's outline, a drawing, or surfaces in a cage by handles. With a
/// barrier no element is inverted in any iterate. A mesh that comes with a start needs no handles: its energy is
/// minimized from there.
pub fn deform_file(
    upload: &Upload,
    options: &DeformOptions,
    observer: &dyn Observer,
) -> Result<Deformed, PipelineError> {
    options.check()?;
    let has_start = options.cage.is_none() && upload.resources.contains_key(START);
    if options.handles.is_empty() && !has_start {
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

/// Fills in what the selectors of handles name, in a body whose selection is made only if there is one.
fn fill(
    handles: &mut [Handle],
    selection: impl FnOnce() -> Result<Option<VertexSelection>, PipelineError>,
) -> Result<(), PipelineError> {
    let mut selects = handles.iter_mut().filter_map(Handle::select_mut).peekable();
    if selects.peek().is_none() {
        return Ok(());
    }
    selection()?.ok_or_else(no_selection)?.fill(selects)
}

/// Returns the error for a selector in a file without materials, objects and colors.
pub fn no_selection() -> PipelineError {
    let text = "the format of this file has no materials, objects and colors to select by";
    ProblemError::MalformedHandles(text.to_owned()).into()
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
    let body = source.body()?;
    let mut handles = options.handles.clone();
    fill(&mut handles, || source.selection(upload))?;
    let mut problem = if handles.is_empty() {
        Problem::at_rest(body, &options.model)?
    } else {
        Problem::new(body, &handles, &options.model)?
    };
    problem.search = options.pulling.search;
    if let Some(start) = start(upload, problem.start.len())? {
        problem.start = start;
        problem.untangle_start()?;
    }
    // Solve.
    let file = |x: &[f64]| source.frame(format, &problem, x);
    let frames = FrameObserver {
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

//! Problem files solved.

use serde::{Deserialize, Serialize};

use super::PipelineError;
use super::arrays::in_pool;
use super::bodies::BodyFormat;
use super::documents::stem;
use super::limits::{Limits, check_time_budget};
use super::observer::{Observer, Stage, Tracker};
use super::solution::{Deformed, Plan, WriteMap, solve};
use crate::deform::{Method, Problem, ProblemError, ProblemFile};
use crate::document::{DocumentError, Upload};
use crate::mesh::io::{ElementFormat, Elements};

/// How a problem file is solved. The command line's long names in snake case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct SolveOptions {
    /// How: projected Newton with advancing targets, or the paper's iteration.
    pub method: Method,
    /// Lower the barrier's strength while the energy without it falls.
    pub barrier_continuation: bool,
    /// Also minimize without a barrier and report that energy beside the solution's: the barrier's bias.
    pub bias: bool,
    /// Show the observer the map of every iteration; over HTTP they become files beside the result, 256 MiB of them at most.
    pub frames: bool,
    /// Seconds after which the current valid map is taken as it is.
    #[cfg_attr(feature = "service", schema(minimum = 0, maximum = 1e6))]
    pub time_budget: Option<f64>,
    /// Format of the result: positions as text if absent.
    pub format: BodyFormat,
    /// Name of the written file without extension; the problem's if absent. Not an option over HTTP.
    #[serde(skip)]
    pub stem: Option<String>,
    /// What may be used of all this. Not an option over HTTP.
    #[serde(skip)]
    pub limits: Limits,
}

impl Default for SolveOptions {
    fn default() -> Self {
        Self {
            method: Method::Projected,
            barrier_continuation: false,
            bias: false,
            frames: false,
            time_budget: None,
            format: BodyFormat::Txt,
            stem: None,
            limits: Limits::default(),
        }
    }
}

impl SolveOptions {
    /// Checks what can be checked without the file.
    pub fn check(&self) -> Result<(), PipelineError> {
        check_time_budget(self.time_budget)?;
        self.format.check_for_mesh()
    }
}

/// Solves a problem file, whose mesh and start are members of the upload. With a barrier no element is inverted in any iterate.
pub fn solve_file(
    upload: &Upload,
    options: &SolveOptions,
    observer: &dyn Observer,
) -> Result<Deformed, PipelineError> {
    options.check()?;
    let tracker = Tracker::new(observer, options.limits.time_budget(options.time_budget));
    in_pool(options.limits.threads, || {
        tracker.stage(Stage::Read);
        let (problem, elements) = read(upload, &options.limits)?;
        let plan = Plan {
            method: options.method,
            barrier_continuation: options.barrier_continuation,
            bias: options.bias,
        };
        let file = |x: &[f64]| options.format.write(&elements, problem.body.dim(), x);
        let frames: Option<&WriteMap> = if options.frames { Some(&file) } else { None };
        let solved = solve(&problem, plan, &tracker, frames)?;
        tracker.stage(Stage::Write);
        let stem = options.stem.clone().unwrap_or_else(|| stem(&upload.name));
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

/// The problem and the mesh that its file names.
fn read(upload: &Upload, limits: &Limits) -> Result<(Problem, Elements), PipelineError> {
    let file = ProblemFile::parse(&upload.bytes)?;
    let format = ElementFormat::of_name(&file.mesh).ok_or(DocumentError::UnknownFormat)?;
    let elements = format.read(member(upload, &file.mesh)?)?;
    limits.check_count(elements.triangles.len() + elements.tets.len())?;
    let start = file.initial.as_ref().map(|initial| {
        let not_numbers = || ProblemError::Malformed(format!("{initial} is not a list of numbers"));
        Ok::<_, PipelineError>(numbers(member(upload, initial)?).ok_or_else(not_numbers)?)
    });
    let problem = file.with(elements.clone(), start.transpose()?)?;
    Ok((problem, elements))
}

/// A file that the problem names, by its path or, where a client sent only that, its name.
fn member<'a>(upload: &'a Upload, path: &str) -> Result<&'a [u8], PipelineError> {
    let name = path.rsplit('/').next().unwrap_or_default();
    let bytes = upload.resources.get(path).or(upload.resources.get(name));
    let bytes = bytes.ok_or_else(|| DocumentError::MissingResource(path.to_owned()))?;
    Ok(bytes)
}

/// Numbers separated by blanks.
fn numbers(bytes: &[u8]) -> Option<Vec<f64>> {
    let text = std::str::from_utf8(bytes).ok()?;
    text.split_ascii_whitespace()
        .map(|word| word.parse().ok())
        .collect()
}

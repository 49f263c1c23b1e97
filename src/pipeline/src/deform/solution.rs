//! Problems solved under observation: the map, a report, one line per iteration.

use crate::PipelineError;
use crate::options::SolutionPlan;
use crate::tracker::Tracker;
use serde::Serialize;
use std::cell::RefCell;
use std::fmt::Write;
use unwrapd_deform::{
    BodyElements, MapQuality, Method, Problem, PullSummary, Solution, Turns, Units, Unreached,
};
use unwrapd_files::document::Warning;
use unwrapd_maps::certificate::{Crossings, PlanarCertificate, boundary_crossings};
use unwrapd_method::solver::{Control, Iterate, Status, Summary, Watch};

/// Result of deforming a body.
#[derive(Clone, Debug)]
pub struct Deformed {
    /// Written files by relative name, the main file first.
    pub files: Vec<(String, Vec<u8>)>,
    /// Report on the map.
    pub report: DeformReport,
    /// Trace as CSV, one line per iteration: energy without the barrier, the barrier's and the constraints' share,
    /// smallest element, μ, σ, α and the residual, as in [`Iterate`].
    pub trace: String,
}

/// Report on a deformation: the quality of the map and the work of the solver.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct DeformReport {
    /// Solver that was used.
    pub method: Method,
    /// Summary of the solver.
    #[serde(flatten)]
    pub summary: Summary,
    /// Quality of the map.
    #[serde(flatten)]
    pub quality: MapQuality,
    /// Degree to which the request was completed.
    pub completion: Completion,
    /// The handles that did not come to their targets, and how far from them they are.
    pub unreached: Vec<Unreached>,
    /// Unit of its energies.
    pub units: Units,
    /// Pairs of boundary edges that cross or touch, exactly; of a body of the plane only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crossings: Option<u64>,
    /// Turns that handles ask for, and those that the map holds, of each handle that makes half a turn or more.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub turns: Vec<Turns>,
    /// Elements of the supplied start that were inverted and had to be untangled.
    pub untangled: usize,
    /// The energy that the map tends to as the barrier strength tends to 0, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy_without_barrier: Option<f64>,
    /// The smallest size of an element over its rest size, over all iterates.
    pub smallest_ever: f64,
    /// Seconds of reading and checking, of a large cage with those of the coarser ones it starts from.
    pub setup_seconds: f64,
    /// Seconds of everything after that, but for writing.
    pub solve_seconds: f64,
    /// Warnings about the files.
    pub warnings: Vec<Warning>,
    /// The cage and the surfaces in it, if that is what was deformed.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub cage: Option<CageReport>,
}

/// A solution with its report and trace.
pub struct Solved {
    pub solution: Solution,
    pub report: DeformReport,
    pub trace: String,
}

/// Solves a problem; `viewer` sees every iteration once.
pub fn solve(
    problem: &Problem,
    plan: SolutionPlan,
    tracker: &Tracker,
    viewer: Option<&dyn Watch>,
) -> Result<Solved, PipelineError> {
    let setup_seconds = tracker.elapsed().as_secs_f64();
    let trace = Trace {
        tracker,
        viewer,
        x: RefCell::default(),
        iterates: RefCell::default(),
    };
    let settings = plan.settings;
    // Solve, then weaken the barrier and measure its bias if asked to.
    let mut solution = match plan.method {
        Method::Projected => problem.solve(&settings, &trace)?,
        Method::Levenberg => problem.solve_by_levenberg(&problem.levenberg, &trace)?,
    };
    if plan.barrier_continuation {
        solution = problem.with_weaker_barrier(solution, &settings, tracker)?;
    }
    let energy_without_barrier = if plan.bias {
        Some(problem.energy_without_barrier(&solution, &settings, tracker)?)
    } else {
        None
    };
    // Refuse a result that breaks a promise.
    if solution.quality.inverted > 0 && problem.forbids_inversion() {
        return Err(PipelineError::Inverted);
    }
    let crossings = crossings(problem, &solution.x);
    if problem.boundary_barrier.is_some() && crossings > Some(0) {
        return Err(PipelineError::Crossed);
    }
    // Report.
    let unreached = problem.unreached(&solution);
    let turns = problem.turns(&solution.x);
    let status = solution.summary.status;
    let completion = Completion::of(status);
    let warnings = (tracker.warning().into_iter()).chain(completion.warning(status, &unreached));
    let report = DeformReport {
        method: plan.method,
        summary: solution.summary,
        quality: solution.quality,
        completion,
        unreached,
        units: problem.units,
        crossings,
        untangled: problem.untangled,
        energy_without_barrier,
        smallest_ever: trace.smallest().min(solution.quality.smallest),
        setup_seconds,
        solve_seconds: tracker.elapsed().as_secs_f64() - setup_seconds,
        warnings: warnings.chain(turns_lost(&turns)).collect(),
        turns,
        cage: None,
    };
    Ok(Solved {
        solution,
        report,
        trace: trace.csv(),
    })
}

/// Returns a warning for each handle that lost turns, with the number that is left.
fn turns_lost(turns: &[Turns]) -> impl Iterator<Item = Warning> {
    let lost = turns.iter().filter(|turns| turns.are_lost());
    lost.map(|Turns { handle, asked, left }| {
        let message = format!(
            "handle {handle} asks for {asked:.2} turns, of which the body holds {left:.2}: the others went into a coil, or were \
             lost where it passed through itself; a body that is stretched as well keeps more"
        );
        Warning::new("turns_lost", message)
    })
}

/// Counts the crossings of the boundary of a planar body; `None` for other bodies.
fn crossings(problem: &Problem, x: &[f64]) -> Option<u64> {
    match &problem.body.elements {
        BodyElements::Triangles { corners, .. } => {
            Some(boundary_crossings(x.as_chunks().0, corners))
        }
        BodyElements::Tetrahedra { .. } => None,
    }
}

/// Trace of all iterations.
struct Trace<'a> {
    tracker: &'a Tracker<'a>,
    viewer: Option<&'a dyn Watch>,
    /// Positions of the next iterate.
    x: RefCell<Vec<f64>>,
    iterates: RefCell<Vec<Iterate>>,
}

impl Watch for Trace<'_> {
    fn iterate(&self, iterate: &Iterate) -> Control {
        // Skip the first iterate of a further stage: it is the last one of the stage before.
        let mut iterates = self.iterates.borrow_mut();
        let is_new = iterates
            .last()
            .is_none_or(|last| last.iteration < iterate.iteration);
        let mut control = Control::Continue;
        if is_new {
            iterates.push(*iterate);
            if let Some(viewer) = self.viewer {
                viewer.positions(iterate, &self.x.borrow());
                control = viewer.iterate(iterate);
            }
        }
        match Watch::iterate(self.tracker, iterate) {
            Control::Continue => control,
            Control::Finish => Control::Finish,
        }
    }

    fn positions(&self, _: &Iterate, x: &[f64]) {
        if self.viewer.is_some() {
            self.x.replace(x.to_vec());
        }
    }
}

impl Trace<'_> {
    /// Returns the smallest size of an element over its rest size, over all iterates.
    fn smallest(&self) -> f64 {
        let iterates = self.iterates.borrow();
        let sizes = iterates.iter().map(|i| i.smallest);
        sizes.fold(f64::INFINITY, f64::min)
    }

    fn csv(&self) -> String {
        let mut text =
            String::from("iteration,energy,barrier,constraint,smallest,mu,sigma,alpha,residual\n");
        for i in self.iterates.borrow().iter() {
            let numbers = [
                i.energy - i.barrier,
                i.barrier,
                i.constraint,
                i.smallest,
                i.mu,
                i.sigma,
                i.alpha,
                i.residual,
            ];
            let numbers = numbers.map(|x| format!("{x:e}")).join(",");
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{},{numbers}", i.iteration);
        }
        text
    }
}

// Reports of maps deformed by handles.

/// Report on a map that handles pulled.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct PullReport {
    /// Outcome and cost of pulling it.
    #[serde(flatten)]
    pub summary: PullSummary,
    /// Pairs of boundary edges that cross or touch, exactly, before the map is rounded for a file.
    pub crossings: u64,
    /// `true` if every triangle is positive and no two overlap: the certificate's conclusion.
    pub bijective: bool,
    /// Facts about the result, proven by exact predicates.
    #[serde(flatten)]
    pub certificate: PlanarCertificate,
}

impl PullReport {
    pub(crate) fn new(
        summary: PullSummary,
        crossings: u64,
        certificate: PlanarCertificate,
    ) -> Self {
        Self {
            summary,
            crossings,
            bijective: certificate.is_bijective(),
            certificate,
        }
    }
}

// Warnings about handles that missed their targets.

/// Maximum number of handles named in a warning.
const NAMED: usize = 8;

/// Degree to which a request was completed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Completion {
    /// Every handle is at its target, and the energy is minimal.
    #[default]
    Complete,
    /// The work ended before that: at the limit of time or of iterations, or on request.
    EndedEarly,
    /// Handles cannot be brought to their targets.
    TargetsMissed,
}

impl Completion {
    /// Returns the completion for the final status of the solver.
    pub(crate) fn of(status: Status) -> Self {
        match status {
            Status::Converged | Status::Stalled => Self::Complete,
            Status::IterationLimit | Status::Stopped => Self::EndedEarly,
            Status::TargetsUnreachable => Self::TargetsMissed,
        }
    }

    /// Returns a warning about what is missing; `unreached` are the handles that are not at their targets.
    pub(crate) fn warning(self, status: Status, unreached: &[Unreached]) -> Option<Warning> {
        let (code, what) = match self {
            Self::Complete => return None,
            Self::TargetsMissed => (
                "targets_unreachable",
                "no way was found to the targets of these handles, counted from 0",
            ),
            Self::EndedEarly if status == Status::IterationLimit => (
                "iteration_limit",
                "the energy is not minimal: the limit of iterations was reached",
            ),
            // The tracker says why it was stopped.
            Self::EndedEarly if unreached.is_empty() => return None,
            Self::EndedEarly => (
                "targets_missed",
                "the work ended before these handles, counted from 0, came to their targets",
            ),
        };
        let message = if unreached.is_empty() {
            what.to_owned()
        } else if code == "iteration_limit" {
            format!(
                "{what}; handles, counted from 0, that are not at their targets: {}",
                named(unreached)
            )
        } else {
            format!("{what}: {}", named(unreached))
        };
        Some(Warning::new(code, message))
    }
}

/// Lists the first handles with their distances from their targets.
fn named(unreached: &[Unreached]) -> String {
    let first = unreached.iter().take(NAMED);
    let names = first.map(|one| format!("{} (by {:.3e})", one.handle, one.distance));
    let names = names.collect::<Vec<_>>().join(", ");
    match unreached.len().saturating_sub(NAMED) {
        0 => names,
        more => format!("{names} and {more} more"),
    }
}

// Report of deforming in a cage.

/// A cage, and the effect of deforming it on the surfaces in it.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct CageReport {
    /// Cubes the cage consists of.
    pub voxels: usize,
    /// Tetrahedra, six for each.
    pub tets: usize,
    /// Connected parts of the cage that have no handle and stay at rest.
    pub idle_parts: usize,
    /// Vertices of all surfaces, those of cuts included.
    pub surface_vertices: usize,
    /// Triangles of all surfaces, pieces counted.
    pub surface_triangles: usize,
    /// Where the surfaces pass through themselves and each other at rest.
    pub crossings_before: Crossings,
    /// Where they do in the file written.
    pub crossings_after: Crossings,
    /// Warnings about the files; reports list them among their own.
    #[serde(skip)]
    pub warnings: Vec<Warning>,
}

// Iterates as files.

/// Function that writes a map in the format of the result.
pub type WriteMap<'a> = dyn Fn(&[f64]) -> Vec<u8> + 'a;

/// Passes every iterate as a file to the observer.
pub struct FrameObserver<'a> {
    pub tracker: &'a Tracker<'a>,
    pub file: &'a WriteMap<'a>,
}

impl Watch for FrameObserver<'_> {
    fn iterate(&self, _: &Iterate) -> Control {
        Control::Continue
    }

    fn positions(&self, iterate: &Iterate, x: &[f64]) {
        let file = || (self.file)(x);
        self.tracker.frame(iterate.iteration, &file);
    }
}

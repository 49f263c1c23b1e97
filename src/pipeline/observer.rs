//! What a caller sees while a mesh is being unwrapped, and how it ends the work early.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::options::Budget;
use crate::solver::{Control, Iterate, Watch};

/// The stages of a job, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Stage {
    /// The file is being read.
    Read,
    /// Seams are being chosen.
    Cut,
    /// Charts are being mapped to the plane.
    Map,
    /// Handles are being pulled to their targets.
    Deform,
    /// Charts are being packed.
    Pack,
    /// Textures are being resampled.
    Bake,
    /// The document is being written.
    Write,
    /// The written bytes are being read again and judged.
    Judge,
}

/// Where a job stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct Progress {
    /// The stage under way.
    pub stage: Stage,
    /// Share of the whole work done, 0 to 1; never falls.
    pub fraction: f64,
    /// Charts finished so far.
    pub chart: usize,
    /// Charts in all; 0 before they are known, with `cut` `auto` until all are mapped.
    pub charts: usize,
    /// Iteration of the chart that reported last, or of the body that is pulled.
    pub iteration: usize,
    /// Its energy, barrier included.
    pub energy: f64,
    /// Its smallest element over the rest size.
    pub smallest: f64,
}

/// Receives progress, answers whether to go on, and tells the time.
///
/// Called from several threads at once. The library has no clock of its own: a caller that does not care uses [`Unobserved`].
pub trait Observer: Sync {
    /// Takes a progress report. [`Control::Finish`] ends the optimization with the current valid map.
    fn progress(&self, progress: &Progress) -> Control;
    /// Time since the work began.
    fn elapsed(&self) -> Duration;
    /// Shows the map of an iteration while handles are pulled, that of the start as number 0. `file` writes it as the result will be.
    fn frame(&self, _number: usize, _file: &dyn Fn() -> Vec<u8>) {}
}

/// Neither listens nor interferes; its clock stands still.
pub struct Unobserved;

impl Observer for Unobserved {
    fn progress(&self, _: &Progress) -> Control {
        Control::Continue
    }
    fn elapsed(&self) -> Duration {
        Duration::ZERO
    }
}

/// Turns the work that is done into a fraction that never falls, and applies the time budget.
pub(super) struct Tracker<'a> {
    observer: &'a dyn Observer,
    time_budget: Option<Duration>,
    state: Mutex<State>,
}

struct State {
    progress: Progress,
    /// Where the stage under way ends, and the packing begins.
    ends: f64,
    pack_begins: f64,
    /// Work of the stage that is not done yet, in a unit of its own.
    left: f64,
}

/// Shares of the work done when the mapping begins and the packing ends. What the two take of that depends on the mesh.
const MAPPED: f64 = 0.04;
const PACKED: f64 = 0.92;
/// Mapping a face takes about as long as reading so many words while packing. Measured on meshes of 6,000 and of 100,000 faces.
const WORDS_PER_FACE: f64 = 10_000.0;

impl State {
    /// Shares of the work done when a stage begins and ends.
    fn span(&self, stage: Stage) -> [f64; 2] {
        match stage {
            Stage::Read => [0.0, 0.02],
            Stage::Cut => [0.02, MAPPED],
            Stage::Map => [MAPPED, self.pack_begins],
            Stage::Pack => [self.pack_begins, PACKED],
            Stage::Deform => [MAPPED, 0.94],
            Stage::Bake => [PACKED, 0.94],
            Stage::Write => [0.94, 0.95],
            Stage::Judge => [0.95, 1.0],
        }
    }

    fn enter(&mut self, stage: Stage, work: f64) {
        let [begins, ends] = self.span(stage);
        self.progress.stage = stage;
        self.progress.fraction = self.progress.fraction.max(begins);
        self.ends = ends;
        self.left = work;
    }

    /// So much of the work of the stage is done.
    fn advance(&mut self, work: f64) {
        let room = (self.ends - self.progress.fraction).max(0.0);
        let share = work / self.left.max(f64::MIN_POSITIVE);
        self.left -= work;
        self.progress.fraction += room * share.clamp(0.0, 1.0);
    }
}

impl<'a> Tracker<'a> {
    pub(super) fn new(observer: &'a dyn Observer, budget: Budget) -> Self {
        let progress = Progress {
            stage: Stage::Read,
            fraction: 0.0,
            chart: 0,
            charts: 0,
            iteration: 0,
            energy: 0.0,
            smallest: 0.0,
        };
        Self {
            observer,
            time_budget: (budget.time_budget).and_then(|s| Duration::try_from_secs_f64(s).ok()),
            state: Mutex::new(State {
                progress,
                ends: 0.0,
                pack_begins: 0.8,
                left: 0.0,
            }),
        }
    }

    pub(super) fn elapsed(&self) -> Duration {
        self.observer.elapsed()
    }

    /// Says what mapping and packing will take: faces to be mapped, words to be read.
    pub(super) fn expect(&self, faces: usize, words: u64) {
        let mapping = WORDS_PER_FACE * faces as f64;
        let share = mapping / (mapping + words as f64).max(1.0);
        self.state().pack_begins = MAPPED + (PACKED - MAPPED) * share;
    }

    pub(super) fn stage(&self, stage: Stage) {
        self.begin(stage, 0.0);
    }

    /// Begins a stage of so much work, in a unit of its own; [`Portion`](super::portion::Portion)s say how much of it is done.
    pub(super) fn begin(&self, stage: Stage, work: f64) {
        self.update(|state| state.enter(stage, work));
    }

    /// Announces charts about to be mapped: their number, 0 where it is not known, and their faces, each as often as it is worked on.
    pub(super) fn charts(&self, charts: usize, faces: usize) {
        self.update(|state| {
            state.enter(Stage::Map, faces as f64);
            state.progress.charts = charts;
        });
    }

    /// So many charts are mapped.
    pub(super) fn charts_done(&self, charts: usize) {
        self.update(|state| state.progress.chart += charts);
    }

    /// All charts are mapped, whether they were announced or not.
    pub(super) fn all_mapped(&self) {
        self.update(|state| state.progress.charts = state.progress.chart);
    }

    /// So much of the work of the stage is done.
    pub(super) fn advance(&self, work: f64) {
        self.update(|state| state.advance(work));
    }

    /// An iterate of a chart, with which so much work is done.
    pub(super) fn iterated(&self, work: f64, iterate: &Iterate) -> Control {
        self.update(|state| {
            state.see(iterate);
            state.advance(work);
        })
    }

    /// Whether to go on.
    pub(super) fn control(&self) -> Control {
        self.update(|_| ())
    }

    /// Shows the map of an iteration.
    #[cfg(feature = "files")]
    pub(super) fn frame(&self, number: usize, file: &dyn Fn() -> Vec<u8>) {
        self.observer.frame(number, file);
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn update(&self, change: impl FnOnce(&mut State)) -> Control {
        let progress = {
            let mut state = self.state();
            change(&mut state);
            state.progress.clone()
        };
        let overdue = self
            .time_budget
            .is_some_and(|budget| self.observer.elapsed() >= budget);
        match self.observer.progress(&progress) {
            Control::Continue if overdue => Control::Finish,
            control => control,
        }
    }
}

/// What an iteration of a body that is pulled takes of what is left to do: long ways take some hundred iterations, and 0.98^100 is
/// an eighth.
const OF_AN_ITERATION: f64 = 0.02;

/// Watches handles being pulled.
impl Watch for Tracker<'_> {
    fn iterate(&self, iterate: &Iterate) -> Control {
        self.update(|state| {
            if state.progress.stage != Stage::Deform {
                state.enter(Stage::Deform, 0.0);
            }
            state.see(iterate);
            state.left = 1.0;
            state.advance(OF_AN_ITERATION);
        })
    }
}

impl State {
    fn see(&mut self, iterate: &Iterate) {
        self.progress.iteration = iterate.iteration;
        self.progress.energy = iterate.energy;
        self.progress.smallest = iterate.smallest;
    }
}

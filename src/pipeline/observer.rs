//! What a caller sees while a mesh is being unwrapped, and how it ends the work early.

use std::sync::Mutex;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::charts;
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

/// Turns the reports of stages and charts into a fraction that never falls, and applies the time budget.
pub(super) struct Tracker<'a> {
    observer: &'a dyn Observer,
    time_budget: Option<Duration>,
    state: Mutex<State>,
}

struct State {
    progress: Progress,
    /// Faces of finished charts and of all charts.
    faces_done: usize,
    faces: usize,
}

/// Share of the work done when a stage begins; measured on meshes of 10,000 to 100,000 faces.
const fn begins_at(stage: Stage) -> f64 {
    match stage {
        Stage::Read => 0.0,
        Stage::Cut => 0.02,
        Stage::Map | Stage::Deform => 0.1,
        Stage::Pack => 0.8,
        Stage::Bake => 0.86,
        Stage::Write => 0.9,
        Stage::Judge => 0.92,
    }
}

impl<'a> Tracker<'a> {
    pub(super) fn new(observer: &'a dyn Observer, time_budget: Option<f64>) -> Self {
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
            time_budget: time_budget.and_then(|s| Duration::try_from_secs_f64(s).ok()),
            state: Mutex::new(State {
                progress,
                faces_done: 0,
                faces: 0,
            }),
        }
    }

    #[cfg(feature = "files")]
    pub(super) fn elapsed(&self) -> Duration {
        self.observer.elapsed()
    }

    pub(super) fn stage(&self, stage: Stage) {
        self.update(|state| {
            state.progress.stage = stage;
            begins_at(stage)
        });
    }

    /// Announces the charts about to be mapped: their number and their faces.
    pub(super) fn charts(&self, charts: usize, faces: usize) {
        self.update(|state| {
            state.progress.stage = Stage::Map;
            state.progress.charts = charts;
            state.faces = faces;
            begins_at(Stage::Map)
        });
    }

    /// A chart of `faces` faces is mapped.
    pub(super) fn chart_done(&self, faces: usize) {
        self.update(|state| {
            state.faces_done += faces;
            state.progress.chart += 1;
            state.mapped(0.0)
        });
    }

    /// A surface of `faces` faces is mapped, in so many charts. That was not known before: none were announced.
    pub(super) fn surface_done(&self, faces: usize, charts: usize) {
        self.update(|state| {
            state.faces_done += faces;
            state.progress.chart += charts;
            state.mapped(0.0)
        });
    }

    /// All charts are mapped, whether they were announced or not.
    pub(super) fn all_mapped(&self) {
        self.update(|state| {
            state.progress.charts = state.progress.chart;
            begins_at(Stage::Pack)
        });
    }

    /// Shows the map of an iteration.
    #[cfg(feature = "files")]
    pub(super) fn frame(&self, number: usize, file: &dyn Fn() -> Vec<u8>) {
        self.observer.frame(number, file);
    }

    fn update(&self, change: impl FnOnce(&mut State) -> f64) -> Control {
        let progress = {
            let mut state = self
                .state
                .lock()
                .unwrap_or_else(std::sync::PoisonError::into_inner);
            let fraction = change(&mut state);
            state.progress.fraction = state.progress.fraction.max(fraction.min(1.0));
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

/// Watches handles being pulled.
impl Watch for Tracker<'_> {
    fn iterate(&self, iterate: &Iterate) -> Control {
        self.update(|state| {
            state.progress.stage = Stage::Deform;
            state.progress.iteration = iterate.iteration;
            state.progress.energy = iterate.energy;
            state.progress.smallest = iterate.smallest;
            // Long ways take some hundred iterations: 0.98^100 leaves an eighth.
            let share = 1.0 - 0.98_f64.powi(iterate.iteration.min(1000) as i32);
            let (begin, end) = (begins_at(Stage::Deform), begins_at(Stage::Write));
            begin + (end - begin) * share
        })
    }
}

impl charts::Observer for Tracker<'_> {
    /// One iteration of a chart of `faces` faces.
    fn iterate(&self, faces: usize, iterate: &Iterate) -> Control {
        self.update(|state| {
            state.progress.iteration = iterate.iteration;
            state.progress.energy = iterate.energy;
            state.progress.smallest = iterate.smallest;
            // Most charts end within 15 iterations: 0.85^15 leaves a tenth.
            let share = 1.0 - 0.85_f64.powi(iterate.iteration.min(1000) as i32);
            state.mapped(faces as f64 * share)
        })
    }

    fn control(&self) -> Control {
        self.update(|state| state.progress.fraction)
    }

    fn elapsed(&self) -> Duration {
        self.observer.elapsed()
    }
}

impl State {
    fn mapped(&self, current: f64) -> f64 {
        let share = (self.faces_done as f64 + current) / self.faces.max(1) as f64;
        let (begin, end) = (begins_at(Stage::Map), begins_at(Stage::Pack));
        begin + (end - begin) * share.min(1.0)
    }
}

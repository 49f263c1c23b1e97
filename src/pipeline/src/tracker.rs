//! Progress of the whole work, and early ending.

use super::observer::{Observer, Progress};
use super::options::Budget;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use unwrapd_api::Stage;
use unwrapd_files::document::Warning;
use unwrapd_layout::charts::MapUnderway;
use unwrapd_method::solver::{Control, Iterate, Watch};

/// Converts completed work to a fraction that never falls, and applies the time budget.
pub(super) struct Tracker<'a> {
    observer: &'a dyn Observer,
    time_budget: Option<Duration>,
    state: Mutex<TrackerState>,
}

struct TrackerState {
    progress: Progress,
    /// Fractions at which the current stage ends, and at which packing begins.
    ends: f64,
    pack_begins: f64,
    /// Remaining work of the stage, in a unit of its own.
    left: f64,
    /// Reason for an early end.
    ended: Option<EarlyEnd>,
    /// Number of islands that keep borders bent that were to become straight.
    n_bent: usize,
}

/// Reason for an early end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum EarlyEnd {
    /// The observer requested it.
    Requested,
    /// The time limit is reached.
    OutOfTime,
}

/// Fractions of the work at which mapping begins and packing ends. Their shares in between depend on the mesh. Only the
/// progress shown depends on these fractions.
const MAPPED: f64 = 0.04;
const PACKED: f64 = 0.92;
/// Words read while packing in the time that mapping one face takes. Measured on meshes of 6,000 and of 100,000
/// faces.
const WORDS_PER_FACE: f64 = 10_000.0;

impl TrackerState {
    /// Returns the fractions of the work at which a stage begins and ends.
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

    /// Completes some work of the stage.
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
            state: Mutex::new(TrackerState {
                progress,
                ends: 0.0,
                pack_begins: 0.8,
                left: 0.0,
                ended: None,
                n_bent: 0,
            }),
        }
    }

    /// Passes warnings on before the work begins.
    pub(super) fn warn(&self, warnings: &[Warning]) {
        for warning in warnings {
            self.observer.warning(warning);
        }
    }

    pub(super) fn elapsed(&self) -> Duration {
        self.observer.elapsed()
    }

    /// Sets the expected work of mapping and packing: faces to map, words to read.
    pub(super) fn expect(&self, faces: usize, words: u64) {
        let mapping = WORDS_PER_FACE * faces as f64;
        let share = mapping / (mapping + words as f64).max(1.0);
        self.state().pack_begins = MAPPED + (PACKED - MAPPED) * share;
    }

    pub(super) fn stage(&self, stage: Stage) {
        self.begin(stage, 0.0);
    }

    /// Begins a stage of this much work, in a unit of its own; [`Portion`](super::portion::Portion)s report its
    /// progress.
    pub(super) fn begin(&self, stage: Stage, work: f64) {
        self.update(|state| state.enter(stage, work));
    }

    /// Announces charts about to be mapped: their number, 0 if unknown, and their faces, counted once per mapping.
    pub(super) fn charts(&self, charts: usize, faces: usize) {
        self.update(|state| {
            state.enter(Stage::Map, faces as f64);
            state.progress.charts = charts;
        });
    }

    /// Records that `charts` more charts are mapped.
    pub(super) fn charts_done(&self, charts: usize) {
        self.update(|state| state.progress.chart += charts);
    }

    /// Adds to the numbers of mapped and known charts; both may be negative.
    pub(super) fn charted(&self, mapped: isize, known: isize) {
        self.update(|state| {
            let progress = &mut state.progress;
            progress.chart = progress.chart.saturating_add_signed(mapped);
            progress.charts = progress.charts.saturating_add_signed(known);
        });
    }

    /// Records that `islands` more islands keep borders bent that were to become straight.
    pub(super) fn bent(&self, islands: usize) {
        self.state().n_bent += islands;
    }

    /// Completes some work of the stage. Returns whether to continue.
    pub(super) fn advance(&self, work: f64) -> Control {
        self.update(|state| state.advance(work))
    }

    /// Records an iterate of a chart, which completes some work. Returns whether to continue.
    pub(super) fn iterated(&self, work: f64, iterate: &Iterate) -> Control {
        self.update(|state| {
            state.see(iterate);
            state.advance(work);
        })
    }

    /// Returns whether to continue.
    pub(super) fn control(&self) -> Control {
        self.update(|_| ())
    }

    /// Passes the map of a chart of a surface to the observer.
    pub(super) fn map(&self, surface: usize, map: &MapUnderway) {
        self.observer.map(surface, map);
    }

    /// Passes the map of an iteration to the observer.
    pub(super) fn frame(&self, number: usize, file: &dyn Fn() -> Vec<u8>) {
        self.observer.frame(number, file);
    }

    fn state(&self) -> MutexGuard<'_, TrackerState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn update(&self, change: impl FnOnce(&mut TrackerState)) -> Control {
        let progress = {
            let mut state = self.state();
            change(&mut state);
            state.progress.clone()
        };
        let is_out_of_time = (self.time_budget).is_some_and(|budget| budget <= self.elapsed());
        let end = match self.observer.progress(&progress) {
            Control::Finish => EarlyEnd::Requested,
            Control::Continue if is_out_of_time => EarlyEnd::OutOfTime,
            Control::Continue => return Control::Continue,
        };
        if progress.stage.can_end_early() {
            self.state().ended.get_or_insert(end);
        }
        Control::Finish
    }

    /// Returns a warning if the work ended early.
    pub(super) fn warning(&self) -> Option<Warning> {
        let cause = match (self.state().ended?, self.time_budget) {
            (EarlyEnd::OutOfTime, Some(limit)) => {
                format!("at the time limit of {} s", limit.as_secs_f64())
            }
            _ => "on request".to_owned(),
        };
        let message = format!(
            "the work ended early, {cause}: the result is valid, but more time may improve it"
        );
        Some(Warning::new("ended_early", message))
    }

    /// Returns a warning if islands that were to become straight keep bent borders, although the work did not end early.
    pub(super) fn bent_borders(&self) -> Option<Warning> {
        let state = self.state();
        let islands = match state.n_bent {
            0 => return None,
            _ if state.ended.is_some() => return None,
            1 => "an island that `straighten` names keeps a bent border".to_owned(),
            n => format!("{n} islands that `straighten` names keep bent borders"),
        };
        let message = format!(
            "{islands}: straight ones would exceed the bound on the distortion or overlap (equal parts count once)"
        );
        Some(Warning::new("bent_borders", message))
    }
}

/// Share of the remaining work that one iteration of a deformation completes: long paths take some hundred
/// iterations, and 0.98^100 is an eighth.
const OF_AN_ITERATION: f64 = 0.02;

/// Watches the deformation of a body.
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

impl TrackerState {
    fn see(&mut self, iterate: &Iterate) {
        self.progress.iteration = iterate.iteration;
        self.progress.energy = iterate.energy;
        self.progress.smallest = iterate.smallest;
    }
}

// Timing of the stages.

/// Stopwatch on the observer's clock. Laps are in seconds.
pub(super) struct StopWatch<'a> {
    tracker: &'a Tracker<'a>,
    last: f64,
}

impl<'a> StopWatch<'a> {
    pub(super) fn start(tracker: &'a Tracker<'a>) -> Self {
        Self {
            tracker,
            last: tracker.elapsed().as_secs_f64(),
        }
    }

    pub(super) fn lap(&mut self) -> f64 {
        let now = self.tracker.elapsed().as_secs_f64();
        now - std::mem::replace(&mut self.last, now)
    }
}

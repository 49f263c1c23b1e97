//! The caller's view of the work in progress, and early ending.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use unwrapd_api::Stage;
use unwrapd_files::document::Warning;
use unwrapd_layout::charts::MapUnderway;
use unwrapd_method::solver::Control;

/// Where a job stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Progress {
    /// The stage under way.
    pub stage: Stage,
    /// Share of the whole work done, 0 to 1; never falls.
    pub fraction: f64,
    /// Charts mapped so far. Those that are cut again count again once they are mapped.
    pub chart: usize,
    /// Charts known so far. With `cut` `auto` cuts add some, and some are joined.
    pub charts: usize,
    /// Iteration of the chart that reported last, or of the body that is pulled.
    pub iteration: usize,
    /// Its energy, barrier included.
    pub energy: f64,
    /// Its smallest element over the rest size.
    pub smallest: f64,
}

/// Receives progress, decides whether to continue, and provides the time.
///
/// Called from several threads at once. The library has no clock of its own; callers without interest in progress use
/// [`Unobserved`].
pub trait Observer: Sync {
    /// Receives a progress report. Returning [`Control::Finish`] ends the optimization with the current valid map.
    fn progress(&self, progress: &Progress) -> Control;
    /// Receives a warning about the input before the work begins. The report repeats it.
    fn warning(&self, _warning: &Warning) {}
    /// Returns the time since the work began.
    fn elapsed(&self) -> Duration;
    /// Receives the map of a chart at an iterate, first at the start, before progress is reported for it. The chart
    /// is part of the surface with this number.
    fn map(&self, _surface: usize, _map: &MapUnderway) {}
    /// Receives the map of an iteration of a deformation; the start has number 0. `file` writes it in the format of
    /// the result.
    fn frame(&self, _number: usize, _file: &dyn Fn() -> Vec<u8>) {}
}

/// An observer that ignores everything; its clock stands still.
pub struct Unobserved;

impl Observer for Unobserved {
    fn progress(&self, _: &Progress) -> Control {
        Control::Continue
    }
    fn elapsed(&self) -> Duration {
        Duration::ZERO
    }
}

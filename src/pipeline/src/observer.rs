//! What a caller sees while a mesh is being unwrapped, and how it ends the work early.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use unwrapd_api::Stage;
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

/// Receives progress, answers whether to go on, and tells the time.
///
/// Called from several threads at once. The library has no clock of its own: a caller that does not care uses [`Unobserved`].
pub trait Observer: Sync {
    /// Takes a progress report. [`Control::Finish`] ends the optimization with the current valid map.
    fn progress(&self, progress: &Progress) -> Control;
    /// Time since the work began.
    fn elapsed(&self) -> Duration;
    /// Shows the map of a chart at an iterate, that of the start first, before progress tells of it. The chart is a part of the
    /// surface of this number.
    fn map(&self, _surface: usize, _map: &MapUnderway) {}
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

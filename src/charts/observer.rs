//! What a caller sees while charts are mapped, and how it ends the work early.

use crate::solver::{Control, Iterate};
use std::time::Duration;

/// Sees charts being mapped, tells the time, and may end the work early.
pub trait Observer: Sync {
    /// An iterate of a chart of so many faces.
    fn iterate(&self, faces: usize, iterate: &Iterate) -> Control;
    /// Work that no iterate shows, as long as one iteration of so many faces takes.
    fn worked(&self, _faces: usize) {}
    /// So many more charts are mapped, of so many more that are known; fewer where negative.
    fn charted(&self, _mapped: isize, _known: isize) {}
    /// Whether to go on, asked between maps.
    fn control(&self) -> Control;
    /// Time since the work began.
    fn elapsed(&self) -> Duration;
}

/// Neither listens nor interferes; its clock stands still.
pub struct Unobserved;

impl Observer for Unobserved {
    fn iterate(&self, _: usize, _: &Iterate) -> Control {
        Control::Continue
    }
    fn control(&self) -> Control {
        Control::Continue
    }
    fn elapsed(&self) -> Duration {
        Duration::ZERO
    }
}

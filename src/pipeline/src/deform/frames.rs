//! Iterates as files.

use crate::tracker::Tracker;
use unwrapd_method::solver::{Control, Iterate, Watch};

/// Function that writes a map in the format of the result.
pub type WriteMap<'a> = dyn Fn(&[f64]) -> Vec<u8> + 'a;

/// Passes every iterate as a file to the observer.
pub struct Frames<'a> {
    pub tracker: &'a Tracker<'a>,
    pub file: &'a WriteMap<'a>,
}

impl Watch for Frames<'_> {
    fn iterate(&self, _: &Iterate) -> Control {
        Control::Continue
    }

    fn positions(&self, iterate: &Iterate, x: &[f64]) {
        let file = || (self.file)(x);
        self.tracker.frame(iterate.iteration, &file);
    }
}

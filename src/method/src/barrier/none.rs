//! No barrier.

use crate::energy::Guard;

/// Zero everywhere: the density alone decides what is in the domain.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoBarrier;

impl Guard for NoBarrier {
    fn floor(&self, _: f64) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, _: f64, _: f64) -> f64 {
        0.0
    }

    fn derivatives(&self, _: f64, _: f64) -> [f64; 2] {
        [0.0; 2]
    }
}

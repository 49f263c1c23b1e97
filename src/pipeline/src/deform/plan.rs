//! How a problem is solved.

use unwrapd_deform::Method;
use unwrapd_method::solver::Settings;

/// What is done beside minimizing once.
#[derive(Clone, Copy)]
pub struct Plan {
    pub method: Method,
    /// Lower the barrier's strength while the energy without it falls.
    pub barrier_continuation: bool,
    /// Also minimize without a barrier.
    pub bias: bool,
    /// What the projected method is told.
    pub settings: Settings,
}

//! Solution plans for problems.

use unwrapd_deform::Method;
use unwrapd_method::solver::Settings;

/// Method, settings and additional steps of a solution.
#[derive(Clone, Copy)]
pub struct Plan {
    pub method: Method,
    /// Lowers the barrier's strength while the energy without it falls.
    pub barrier_continuation: bool,
    /// Also minimizes the energy without a barrier.
    pub bias: bool,
    /// Settings of the projected method.
    pub settings: Settings,
}

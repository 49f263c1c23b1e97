//! Barriers that go to infinity as an element degenerates.
//!
//! A barrier makes a map locally injective. It is a function of an element's size that is zero for elements of ordinary
//! size, so that it does not disturb the energy there, and grows to infinity as the size falls to ε. With a line search
//! that never steps past a root of an element's area, no element ever inverts: every iterate is a valid map. (Schüller,
//! Kavan, Panozzo, Sorkine-Hornung 2013, Locally Injective Mappings.)
//!
//! As a function of det J a barrier is isotropic too: it joins a density as a [`Guard`](crate::energy::Guard), with one
//! projection for both. Users choose a barrier by name ([`BarrierKind`]).

mod bounded;
mod guard;
mod inverse_spline;
mod log;
mod neo_hookean;
mod none;

pub use bounded::Bounded;
pub use guard::{Barrier, BarrierKind};
pub use inverse_spline::InverseSpline;
pub use log::{AugmentedLog, Log};
pub use neo_hookean::NeoHookean;
pub use none::NoBarrier;

/// Returns the paper's ε = 1e-5·(smallest rest area), or a tenth of the start's smallest area if that is less, so that
/// the start is inside the domain.
pub fn epsilon(smallest_rest_area: f64, smallest_start_area: f64) -> f64 {
    (1e-5 * smallest_rest_area).min(0.1 * smallest_start_area)
}

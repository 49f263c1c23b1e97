//! Barriers that go to infinity as an element degenerates.
//!
//! A barrier is what makes a map locally injective: a function of an element's size that is zero for elements of
//! ordinary size, so that it does not disturb the energy where nothing is wrong, and grows to infinity as the size
//! falls to ε. With a line search that never steps past a root of an element's area, no element ever inverts: every
//! iterate is a valid map. (Schüller, Kavan, Panozzo, Sorkine-Hornung 2013, Locally Injective Mappings.)
//!
//! Being a function of det J a barrier is isotropic too: it joins a density as a [`Guard`](crate::energy::Guard), one projection for both.
//! [`map_energy`] puts them together from the words of the options.

mod inverse_spline;
mod none;

pub use inverse_spline::InverseSpline;
pub use none::NoBarrier;

use crate::energy::{
    Arap, Density, EnergyKind, Lscm, RestShape, SymmetricDirichlet, Term, Triangles,
};

/// Which barrier is added to the energy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum BarrierKind {
    /// [`InverseSpline`]: no element inverts.
    #[default]
    InverseSpline,
    /// None, for comparison: [`Arap`] and [`Lscm`] may flip triangles.
    None,
}

/// An energy and a barrier, in words and numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapEnergy {
    /// The density.
    pub energy: EnergyKind,
    /// The barrier.
    pub barrier: BarrierKind,
    /// β, the barrier's factor.
    pub beta: f64,
    /// s, the share of its rest area below which an element feels the barrier.
    pub s: f64,
    /// ε, the area at which the barrier is infinite; see [`epsilon`].
    pub epsilon: f64,
}

/// The energy of maps of `triangles` with these rest shapes, ready for the solver.
///
/// β and ε are absolute, as in the paper: scale the rest shapes to a mean area of 1 first.
///
/// # Panics
/// If there are fewer or more rest shapes than triangles.
pub fn map_energy(
    triangles: &[[u32; 3]],
    rest: &[RestShape],
    parameters: &MapEnergy,
) -> Box<dyn Term> {
    match parameters.energy {
        EnergyKind::Arap => with_barrier(triangles, rest, Arap, parameters),
        EnergyKind::Lscm => with_barrier(triangles, rest, Lscm, parameters),
        EnergyKind::SymmetricDirichlet => {
            with_barrier(triangles, rest, SymmetricDirichlet, parameters)
        }
    }
}

fn with_barrier(
    triangles: &[[u32; 3]],
    rest: &[RestShape],
    density: impl Density + 'static,
    &MapEnergy {
        barrier,
        beta,
        s,
        epsilon,
        ..
    }: &MapEnergy,
) -> Box<dyn Term> {
    match barrier {
        BarrierKind::InverseSpline => {
            let guard = InverseSpline { beta, s, epsilon };
            Box::new(Triangles::new(triangles, rest, density, guard))
        }
        BarrierKind::None => Box::new(Triangles::new(triangles, rest, density, NoBarrier)),
    }
}

/// The paper's ε = 1e-5·(smallest rest area), or a tenth of the start's smallest area where that is less, so that the
/// start is inside the domain.
pub fn epsilon(smallest_rest_area: f64, smallest_start_area: f64) -> f64 {
    (1e-5 * smallest_rest_area).min(0.1 * smallest_start_area)
}

//! What a density and a barrier have to say of themselves.

use super::{Derivatives, Jacobian};

/// An energy per rest area, ψ(J), that depends on the singular values of J only.
pub trait Density: Send + Sync {
    /// ψ is finite where det J is greater than this; −∞ if everywhere.
    fn floor(&self) -> f64;

    /// ψ(J), +∞ outside the domain.
    fn value(&self, j: &Jacobian) -> f64;

    /// The derivatives of ψ at a J of the domain.
    fn derivatives(&self, j: &Jacobian) -> Derivatives;
}

/// A function φ of an element's size, det J, added to the density's share before the projection.
pub trait Guard: Send + Sync {
    /// φ is finite where det J is greater than this; −∞ if everywhere.
    fn floor(&self, rest_area: f64) -> f64;

    /// φ(det J) of an element, not weighted by its area; +∞ at and below the floor.
    fn value(&self, det: f64, rest_area: f64) -> f64;

    /// φ′ and φ″ at a det J above the floor.
    fn derivatives(&self, det: f64, rest_area: f64) -> [f64; 2];
}

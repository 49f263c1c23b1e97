//! Deformation energies as functions of singular values.
//!
//! An isotropic energy does not know directions: what a triangle contributes is a function ψ of the singular values of
//! its Jacobian J, weighted by its rest area. Of a 2×2 matrix everything can be had without a singular value
//! decomposition: J is the sum of a similarity and of a reflected similarity, of Frobenius norms p and m, and
//!
//! ```text
//! σ₁, σ₂ = (p ± m)/√2     det J = (p² − m²)/2     ‖J‖² = p² + m²
//! ```
//!
//! A density ([`Density`]) gives ψ and its derivatives in (p, m) and nothing else. A function of det J alone, such as a
//! barrier, joins as a [`Guard`]; both are summed before the one projection of the Hessian to positive semidefinite
//! ([`Derivatives::project`]), which is in closed form because in the basis of p and m the Hessian is two numbers and
//! one 2×2 block (Smith, de Goes, Kim 2019, Analytic Eigensystems for Isotropic Distortion Energies).
//!
//! [`Triangles`] sums over a mesh; the solver sees it as a [`Term`] and knows no energy by name. Nothing here knows
//! where a map comes from or how it is improved.

mod arap;
mod density;
mod derivatives;
mod element;
mod jacobian;
mod lscm;
mod rest;
mod symmetric_dirichlet;
mod term;
mod triangles;

pub use arap::Arap;
pub use density::{Density, Guard};
pub use derivatives::Derivatives;
pub use jacobian::Jacobian;
pub use lscm::Lscm;
pub use rest::RestShape;
pub use symmetric_dirichlet::SymmetricDirichlet;
pub use term::{Local, Term};
pub use triangles::Triangles;

/// Which density is minimized.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum EnergyKind {
    /// [`Arap`]: as rigid as possible.
    #[default]
    Arap,
    /// [`Lscm`]: least-squares conformal.
    Lscm,
    /// [`SymmetricDirichlet`]: as isometric as possible, stretching and shrinking punished alike.
    SymmetricDirichlet,
}

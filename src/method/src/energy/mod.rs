//! Deformation energies as functions of singular values.
//!
//! An isotropic energy does not know directions: what an element contributes is a function ψ of the signed singular values
//! of its Jacobian J, weighted by its rest size. A density ([`Density`]) gives ψ, ∂ψ and ∂²ψ in σ and nothing else, once
//! for triangles in the plane and tetrahedra in space. One's own is typed as text or written as a closure ([`Formula`]).
//!
//! A function of det J alone, such as a barrier, joins as a [`Guard`]; both are summed before the one projection of the Hessian to positive semidefinite, which is in closed form
//! because in the frame of the singular vectors the Hessian is one number for each twist and flip and one D×D block
//! ([`Modes`]).
//!
//! [`Triangles`] and [`Tetrahedra`] sum over a mesh. Energies of the displacement that are quadratic forms stand beside
//! them ([`Quadratic`]), and anything else that gives value, gradient and Hessian block of a stencil can: the solver sees
//! a [`Term`] and knows no energy by name. Nothing here knows where a map comes from or how it is improved.

mod arap;
mod density;
mod foldover_free;
mod formula;
mod green;
mod laplacian;
mod lscm;
mod mips;
mod modes;
mod neo_hookean;
mod positional;
mod quadratic;
mod rest;
mod simplex;
mod simplices;
mod symmetric_dirichlet;
mod term;
mod zero;

pub use arap::{Arap, FrozenArap};
pub use density::{Density, Guard};
pub use foldover_free::FoldoverFree;
pub use formula::{Formula, FormulaError, Jet, OwnEnergy};
pub use green::{Green, StVenantKirchhoff};
pub use laplacian::{biharmonic, dirichlet, uniform_biharmonic, voronoi_areas};
pub use lscm::Lscm;
pub use mips::{Amips, Mips};
pub use modes::Modes;
pub use neo_hookean::NeoHookean;
pub use positional::{Positional, Row};
pub use quadratic::Quadratic;
pub use rest::RestShape;
pub use simplices::{Simplices, Tetrahedra, Triangles};
pub use symmetric_dirichlet::SymmetricDirichlet;
pub use term::{Assembly, Term};
pub use zero::Zero;

/// Which density is minimized.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum EnergyKind {
    /// As rigid as possible (ARAP).
    #[default]
    Arap,
    /// Least-squares conformal (LSCM).
    Lscm,
    /// Symmetric Dirichlet: penalizes stretching and shrinking alike.
    SymmetricDirichlet,
}

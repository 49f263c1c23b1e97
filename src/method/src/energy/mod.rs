//! Deformation energies as functions of singular values.
//!
//! An isotropic energy is independent of directions: an element contributes a function ψ of the signed singular values
//! of its Jacobian J, weighted by its rest size. A density ([`Density`]) gives only ψ, ∂ψ and ∂²ψ in σ, once for
//! triangles in the plane and tetrahedra in space. Custom densities are typed as text, written as closures
//! ([`Formula`]), or functions that take all elements in one call ([`Batched`]).
//!
//! A function of det J alone, such as a barrier, joins as a [`Guard`]. Both are summed before the one projection of the
//! Hessian to positive semidefinite. The projection has a closed form because in the frame of the singular vectors the
//! Hessian is one number for each twist and flip and one D×D block ([`Modes`]).
//!
//! Users choose an energy by name or formula ([`EnergyKind`]). [`Triangles`] and [`Tetrahedra`] sum over a mesh.
//! Quadratic forms of the displacement ([`Quadratic`]) complement them, as can anything else that gives value, gradient
//! and Hessian block of a stencil: the solver sees a [`Term`] and knows no energy by name. This module does not know
//! where a map comes from or how it is improved.

mod alignment;
mod conformal;
mod density;
mod formula;
mod isometric;
mod kind;
mod quadratic;
mod rest;
mod simplices;
mod term;

pub use alignment::{AlignedEdge, Alignment};
pub use conformal::{Amips, FoldoverFree, Lscm, Mips};
pub use density::{Density, DensityBatch, Guard, Zero, prefers_a_size};
pub use formula::{Batched, Formula, FormulaError, Jet, OwnEnergy};
pub use isometric::{Arap, FrozenArap, Green, NeoHookean, StVenantKirchhoff, SymmetricDirichlet};
pub use kind::{DensityKind, DimensionError, DisplacementKind, EnergyKind};
pub use quadratic::{Quadratic, biharmonic, dirichlet, uniform_biharmonic, voronoi_areas};
pub use rest::RestShape;
pub use simplices::{Modes, Simplices, Tetrahedra, Triangles};
pub use term::{Assembly, Positional, Row, Term};

//! Locally injective mappings: a deformation energy, a barrier that goes to infinity as an element collapses, and a Newton
//! method that minimizes their sum.
//!
//! | module | contents |
//! |---|---|
//! | [`numerics`] | sparse Cholesky factorization, exact predicates, small vectors and matrices, boxes, convex hulls |
//! | [`energy`] | densities as functions of singular values, for triangles and tetrahedra; quadratic terms |
//! | [`barrier`] | functions of the determinant that keep elements from inverting |
//! | [`solver`] | projected Newton, exact largest step, line search; handles that are moved to targets or dragged |
//!
//! The crate knows arrays of `f64` and indices: no mesh files, no JSON, no clock, no logging, no global state. Its modules
//! import each other in the order of the table only.
//!
//! Reference: Schüller, Kavan, Panozzo, Sorkine-Hornung 2013, *Locally Injective Mappings*.
#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod barrier;
pub mod energy;
pub mod numerics;
pub mod solver;

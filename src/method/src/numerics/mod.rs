//! Small linear algebra, sparse Cholesky, exact predicates.
//!
//! The numerical basis of all other modules, without meshes: vectors and matrices of plane and space, a sparse
//! factorization whose symbolic part is done once per pattern, conjugate gradients where it does not fit into memory,
//! and the exact sign of an orientation. Everything is plain `f64` arrays; after the analysis of its pattern, solving a
//! system allocates nothing.
pub mod block;
pub mod bounds;
pub mod cholesky;
pub mod conjugate_gradients;
pub mod csr;
pub mod hull;
pub mod linear_solver;
pub mod point_tree;
pub mod predicates;
pub mod principal_axes;
pub mod random;
pub mod roots;
pub mod rotation;
pub mod square;
pub mod stencils;
pub mod support;
pub mod svd;
pub mod symmetric;
pub mod ties;
pub mod vec2;
pub mod vec3;

//! Small linear algebra, sparse Cholesky, exact predicates.
pub mod vec3;

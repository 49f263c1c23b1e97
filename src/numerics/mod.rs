//! Small linear algebra, sparse Cholesky, exact predicates.

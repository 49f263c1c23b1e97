//! Tests of the method.
mod barrier;
mod cholesky;
mod energy;
mod formula;
mod numerics;
mod point_tree;
mod solver;
#[path = "../support/taylor.rs"]
#[allow(dead_code)]
mod taylor;
#[path = "../support/terms.rs"]
#[allow(dead_code)]
mod terms;

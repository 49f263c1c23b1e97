//! Bodies pulled by handles, no element inverted.

mod body;
mod model;
mod problem;
mod problem_error;
mod solve;

pub use body::{Body, BodyElements};
pub use model::DeformationEnergy;
pub use problem::{Problem, ProblemFile, Rest};
pub use problem_error::ProblemError;
pub use solve::{Method, Solution, Worth};

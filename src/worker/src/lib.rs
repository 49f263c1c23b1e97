//! The compute process: the child's side of jobs, pictures and live sessions.
//!
//! A server starts the program as a child with a word and a folder: `compute` for an attempt at a job ([`compute`]),
//! `draw` for a picture of a result ([`draw`]), `session` for live handles ([`session::run`]). The child limits its
//! own memory, reads the folder, reports progress, and leaves its results there. A mesh that exhausts memory,
//! overflows a stack or finds a bug ends only its own attempt. The child exits when its standard input closes, so a
//! killed server leaves no orphans.

mod attempt;
mod maps;
mod reporter;
pub mod session;
mod work;

pub use attempt::{draw, run as compute};
pub use reporter::Estimator;
pub use work::{Computations, Work, quality_of};

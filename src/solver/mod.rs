//! Projected Newton with an exact largest step.
//!
//! Minimizes a [`Term`](crate::energy::Term) from a feasible start over maps that all stay feasible. Each iteration
//! solves one sparse linear system; its matrix is the Hessian with the negative curvature of each element removed, so
//! the direction descends, and as the iterates settle the removed curvature is given back little by little
//! ([`Settings::projection`]), which is what ends the slow tail. The step is never longer than 0.95 of the way to the
//! first element that would leave the domain, found exactly, then halved until the energy falls enough.
//!
//! [`follow()`] pulls handles to targets in the same way, the other vertices following each advance. [`levenberg()`] is the
//! iteration of the paper itself, kept for comparison: it shifts the Hessian until it factors instead of projecting it,
//! and holds handles by soft constraints.
//!
//! Invariant: with an energy that forbids flips every iterate, and so every result however the solver ended, has
//! det J > 0 in every element, and while nothing travels the energy falls from iterate to iterate. The solver knows no
//! energy by name, has no clock and no randomness; who watches may end it early ([`Watch`]).

mod follow;
mod held;
mod levenberg;
mod line_search;
mod newton;
mod objective;
mod path;
mod points;
mod quadratic_model;
mod relaxation;
mod scale;
mod settings;
mod travel;
mod watch;

pub use follow::follow;
pub use levenberg::{LevenbergSettings, levenberg};
pub use newton::minimize;
pub use objective::Objective;
pub use path::{Handles, Path, Rotation};
pub use scale::best_scale;
pub use settings::{Projection, Settings, Status, Summary};
pub use watch::{Continued, Control, Iterate, Watch};

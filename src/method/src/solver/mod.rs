//! Projected Newton with an exact largest step.
//!
//! Minimizes a [`Term`](crate::energy::Term) from a feasible start over maps that all stay feasible. Far from a minimum
//! each iteration solves one sparse linear system; its matrix is the Hessian without the negative curvature of each
//! element, so the direction descends. Near a minimum that matrix is too stiff: there it only preconditions, and the
//! directions come from the true Hessian within a trust region, several from one factorization (`trust_region`,
//! [`Settings::projection`]). The step is never longer than 0.95 of the exact distance to the first element that would
//! leave the domain, then halved until the energy falls enough.
//!
//! [`follow()`] pulls handles to targets by Newton's method while the other vertices follow each advance. It restores
//! the removed curvature gradually, as there are few steps between advances. A [`Continuation`] is a `follow` that may
//! pause, [`InteractiveContinuation`] one that runs an iteration at a time while the handles are being moved.
//! [`follow_softly()`] lets each point go as fast as the others allow. [`levenberg()`] is the iteration of the paper
//! itself, kept for comparison: it shifts the Hessian until it factors instead of projecting it, and holds handles by
//! soft constraints.
//!
//! Invariant: with an energy that forbids flips every iterate, and so every result however the solver ended, has
//! det J > 0 in every element, and while no handle moves the energy falls from iterate to iterate. The solver knows no energy
//! by name, has no clock and no randomness; a [`Watch`] may end it early.
mod continuation;
mod handles;
mod interactive;
mod levenberg;
mod load_steps;
mod newton;
mod objective;
mod quadratic_model;
mod relaxation;
mod scale;
mod settings;
mod soft_targets;

pub use continuation::{Continuation, follow};
pub use handles::{Handles, HandlesError, Path, Rotation};
pub use interactive::{InteractiveContinuation, Stage};
pub use levenberg::{LevenbergSettings, levenberg};
pub use newton::minimize;
pub use objective::Objective;
pub use quadratic_model::RigidMotions;
pub use scale::best_scale;
pub use settings::{
    Continued, Control, Iterate, LeastProgress, Projection, Settings, Status, Summary, Watch,
};
pub use soft_targets::{SoftTargets, follow_softly};

//! Progress out, "finish early" in.

/// Where the solver stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iterate {
    /// 0 for the start, then 1, 2, …
    pub iteration: usize,
    /// The energy with the barrier, without soft constraints: lower each time while nothing travels.
    pub energy: f64,
    /// The share of it that is there only to keep elements from inverting.
    pub barrier: f64,
    /// What soft constraints add, α‖Cx − t‖².
    pub constraint: f64,
    /// The smallest size of an element over its rest size.
    pub smallest: f64,
    /// What was added to the Hessian's diagonal for the step that led here.
    pub mu: f64,
    /// The length of that step as a share of the direction.
    pub sigma: f64,
    /// The strength of the soft constraints in that step.
    pub alpha: f64,
    /// The squared distance of the soft constraints from their targets, ‖Cx − d‖².
    pub residual: f64,
}

/// The step that leads to an iterate; none leads to the start.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Taken {
    /// See [`Iterate::mu`].
    pub mu: f64,
    /// See [`Iterate::sigma`].
    pub sigma: f64,
}

/// What to do next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Go on.
    Continue,
    /// End with the present map.
    Finish,
}

/// Sees every iterate and may end the minimization.
pub trait Watch {
    /// Called with the start and after every step.
    fn iterate(&self, iterate: &Iterate) -> Control;

    /// Called before it with the positions of the same iterate, coordinates one after another.
    fn positions(&self, _iterate: &Iterate, _x: &[f64]) {}
}

impl<F: Fn(&Iterate) -> Control> Watch for F {
    fn iterate(&self, iterate: &Iterate) -> Control {
        self(iterate)
    }
}

/// A watch that has seen iterations before.
pub struct Continued<'a> {
    /// Who watches.
    pub watch: &'a dyn Watch,
    /// How many.
    pub before: usize,
}

impl Continued<'_> {
    fn continued(&self, iterate: &Iterate) -> Iterate {
        Iterate {
            iteration: self.before + iterate.iteration,
            ..*iterate
        }
    }
}

impl Watch for Continued<'_> {
    fn iterate(&self, iterate: &Iterate) -> Control {
        self.watch.iterate(&self.continued(iterate))
    }

    fn positions(&self, iterate: &Iterate, x: &[f64]) {
        self.watch.positions(&self.continued(iterate), x);
    }
}

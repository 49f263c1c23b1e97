//! Reports of progress to a watcher, which may end the minimization early.

/// State of the solver after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iterate {
    /// 0 for the start, then 1, 2, …
    pub iteration: usize,
    /// Energy with the barrier, without soft constraints; falls each time while no handle moves.
    pub energy: f64,
    /// Share of the energy whose only purpose is to keep elements from inverting.
    pub barrier: f64,
    /// Energy of the soft constraints, α‖Cx − d‖².
    pub constraint: f64,
    /// Smallest ratio of an element's size to its rest size.
    pub smallest: f64,
    /// Shift of the Hessian's diagonal in the step that led here.
    pub mu: f64,
    /// Length of that step as a share of the direction.
    pub sigma: f64,
    /// Strength of the soft constraints in that step.
    pub alpha: f64,
    /// Squared distance of the soft constraints from their targets, ‖Cx − d‖².
    pub residual: f64,
}

/// The step that leads to an iterate; zeros for the start.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Taken {
    /// See [`Iterate::mu`].
    pub mu: f64,
    /// See [`Iterate::sigma`].
    pub sigma: f64,
}

/// Decision of a watcher.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Continue.
    Continue,
    /// End with the present map.
    Finish,
}

/// Observer of iterates, which may end the minimization.
pub trait Watch {
    /// Called with the start and after every step.
    fn iterate(&self, iterate: &Iterate) -> Control;

    /// Called before [`iterate`](Self::iterate) with the positions of that iterate, coordinates one after another.
    fn positions(&self, _iterate: &Iterate, _x: &[f64]) {}
}

impl<F: Fn(&Iterate) -> Control> Watch for F {
    fn iterate(&self, iterate: &Iterate) -> Control {
        self(iterate)
    }
}

/// A watch for a continued minimization, whose iterations are counted from `before`.
pub struct Continued<'a> {
    /// The watcher.
    pub watch: &'a dyn Watch,
    /// Number of iterations before.
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

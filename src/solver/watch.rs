//! Progress out, "finish early" in.

/// Where the solver stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iterate {
    /// 0 for the start, then 1, 2, …
    pub iteration: usize,
    /// The energy, lower each time.
    pub energy: f64,
    /// The smallest size of an element over its rest size.
    pub smallest: f64,
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
}

impl<F: Fn(&Iterate) -> Control> Watch for F {
    fn iterate(&self, iterate: &Iterate) -> Control {
        self(iterate)
    }
}

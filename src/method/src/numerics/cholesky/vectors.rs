//! What solving with a branch keeps.

/// A right-hand side on its way through the fronts of a branch, and back as the solution.
pub(super) struct Vectors {
    /// Of front after front, the values at its pivots.
    pub pivots: Vec<f64>,
    /// Of front after front, what it adds below its pivots; on the way back the solution there.
    pub below: Vec<f64>,
    /// A front's unknowns as its panel has them: as long as the highest panel.
    pub local: Vec<f64>,
}

impl Vectors {
    pub fn new(pivots: usize, below: usize, highest: usize) -> Self {
        Self {
            pivots: vec![0.0; pivots],
            below: vec![0.0; below],
            local: vec![0.0; highest],
        }
    }
}

//! Workspace of a solve in a branch.

/// A right-hand side on its way through the fronts of a branch, which becomes the solution on the way back.
pub(super) struct Vectors {
    /// Values at the pivots, front after front.
    pub pivots: Vec<f64>,
    /// Contributions below the pivots, front after front; on the way back the solution there.
    pub below: Vec<f64>,
    /// Unknowns of a front in the order of its panel: as long as the highest panel.
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

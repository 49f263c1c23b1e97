//! Memory of a branch, known from the plan.

/// Sizes of the arrays of a branch, in numbers.
#[derive(Default)]
pub(super) struct Extent {
    pub fronts: Vec<u32>,
    pub panels: usize,
    pub updates: [usize; 2],
    /// Pivots of all its fronts.
    pub pivots: usize,
    pub below: usize,
    /// Rows of the highest panel.
    pub highest: usize,
}

impl Extent {
    pub fn bytes(&self) -> usize {
        let [even, odd] = self.updates;
        let vectors = self.pivots + self.below + self.highest;
        size_of::<f64>() * (self.panels + even + odd + vectors)
    }
}

//! Whether handles get on.

/// What handles on their way must bring of it, or else they pause.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Looked at after so many iterations;
    pub window: usize,
    /// the share of the way that they must have brought since.
    pub gain: f64,
}

impl Pace {
    /// Any pace will do.
    pub const ANY: Self = Self {
        window: usize::MAX,
        gain: 0.0,
    };

    /// Handles that no others stand in the way of are never slower.
    pub const BRISK: Self = Self {
        window: 50,
        gain: 0.05,
    };

    /// A way that would take more than 4000 iterations leads through elements that are crushed more and more, and hardly ever to
    /// its end.
    pub const PATIENT: Self = Self {
        window: 100,
        gain: 0.025,
    };

    /// Do handles creep that went so far in so many iterations?
    pub fn is_missed(&self, gain: f64, iterations: usize) -> bool {
        iterations >= self.window && gain < self.gain
    }
}

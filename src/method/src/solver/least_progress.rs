//! Pace: the least progress of handles.

/// Least progress of handles along their path; slower ones pause.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeastProgress {
    /// Iterations between two checks.
    pub window: usize,
    /// Least progress between two checks, as a share of the path.
    pub gain: f64,
}

impl LeastProgress {
    /// No least progress.
    pub const ANY: Self = Self {
        window: usize::MAX,
        gain: 0.0,
    };

    /// A pace that handles without obstacles always keep.
    pub const BRISK: Self = Self {
        window: 50,
        gain: 0.05,
    };

    /// A pace of 4000 iterations for the whole path: slower handles crush elements more and more, and hardly ever
    /// arrive.
    pub const PATIENT: Self = Self {
        window: 100,
        gain: 0.025,
    };

    /// Returns whether progress of `gain` in this number of iterations is too slow.
    pub fn is_missed(&self, gain: f64, iterations: usize) -> bool {
        iterations >= self.window && gain < self.gain
    }
}

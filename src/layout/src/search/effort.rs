//! Work of a search, and its limit.

/// Work that a search has done, and the most that it may do.
///
/// It is counted, not timed, so equal input gives equal charts on any machine.
#[derive(Clone, Copy, Debug)]
pub struct SearchEffort {
    /// Faces of all maps.
    pub mapped_faces: usize,
    /// Faces of all predictions.
    pub predicted_faces: usize,
    /// Faces that may be mapped. Predicted faces count by the time that they take.
    pub most: f64,
}

/// Time that the prediction of a face takes, over that of its map: 0.5 to 0.8 of 10 to 35 microseconds (`cargo bench -p
/// unwrapd-layout --bench search` prints both numbers of faces and the seconds).
const PREDICTION: f64 = 0.04;
/// Faces that are mapped for all surfaces of a run together, about a second. On 16 machine parts and game assets, seams and charts cost
/// 2.6 % more with half of it and 2.5 % less with twice as much (`cargo bench -p unwrapd-layout --bench search`).
const FOR_ALL: f64 = 60_000.0;
/// Maps of each face beyond that, about 0.1 milliseconds: as long as all other work on a machine part of 9,000 faces takes.
const PER_FACE: f64 = 5.0;

impl SearchEffort {
    /// Effort without a limit.
    pub const UNBOUNDED: Self = Self::new(f64::INFINITY);

    const fn new(most: f64) -> Self {
        Self {
            mapped_faces: 0,
            predicted_faces: 0,
            most,
        }
    }

    /// Returns the effort for a surface of `faces` faces, in a run that unwraps `of_all` faces.
    pub fn for_surface(faces: usize, of_all: usize) -> Self {
        let faces = faces as f64;
        Self::new(FOR_ALL * faces / (of_all as f64).max(1.0) + PER_FACE * faces)
    }

    /// Returns a share of the effort.
    #[must_use]
    pub fn share(self, share: f64) -> Self {
        let most = if share > 0.0 { share * self.most } else { 0.0 };
        Self { most, ..self }
    }

    /// Returns the effort that is left.
    #[must_use]
    pub fn left(&self) -> Self {
        Self::new((self.most - self.spent()).max(0.0))
    }

    /// Returns the faces that were mapped, and those that were predicted by the time that they took.
    pub fn spent(&self) -> f64 {
        self.mapped_faces as f64 + PREDICTION * self.predicted_faces as f64
    }

    /// Returns whether no work is left.
    pub fn is_spent(&self) -> bool {
        self.spent() >= self.most
    }
}

use unwrapd_maps::mesh::ElementError;

/// Why surfaces get no cage.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CageError {
    /// A surface is broken.
    #[error("surface {surface}: {error}")]
    Surface {
        /// Which, from 0.
        surface: usize,
        /// What is wrong with it.
        error: ElementError,
    },
    /// There is no surface, or it has no extent.
    #[error("there is no surface to put a cage around")]
    Empty,
    /// The number of voxels is zero or too large.
    #[error("the cage would need more than {0}")]
    TooFine(&'static str),
    /// A position to embed is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NonFinitePosition {
        /// The first such vertex, from 0.
        vertex: usize,
    },
}

impl CageError {
    /// Stable name of the cause, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Surface { error, .. } => error.code(),
            Self::Empty => "no_elements",
            Self::TooFine(_) => "limit_exceeded",
            Self::NonFinitePosition { .. } => "non_finite_position",
        }
    }
}

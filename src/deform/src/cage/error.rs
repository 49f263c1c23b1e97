use unwrapd_maps::mesh::ElementError;

/// Reason why surfaces get no cage.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CageError {
    /// A surface is broken.
    #[error("surface {surface}: {error}")]
    Surface {
        /// Index of the surface, from 0.
        surface: usize,
        /// Defect of the surface.
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
        /// First such vertex, from 0.
        vertex: usize,
    },
}

impl CageError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Surface { error, .. } => error.code(),
            Self::Empty => "no_elements",
            Self::TooFine(_) => "limit_exceeded",
            Self::NonFinitePosition { .. } => "non_finite_position",
        }
    }
}

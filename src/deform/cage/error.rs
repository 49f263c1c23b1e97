use crate::mesh::ElementError;

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
    #[error("there is nothing to put a cage around")]
    Empty,
    /// The number of voxels is zero or too large.
    #[error("the cage would need more than {0}")]
    TooFine(&'static str),
    /// A vertex to embed lies outside of all voxels.
    #[error("vertex {vertex} lies outside of the cage")]
    Outside {
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
            Self::Outside { .. } => "outside_cage",
        }
    }
}

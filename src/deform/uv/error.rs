//! Why UVs cannot be edited.

use crate::deform::problem_error::ProblemError;
use crate::mesh::ElementError;

/// Anchors at most: each is compared with every face.
pub(super) const MOST_ANCHORS: usize = 1000;

/// Why UVs cannot be edited.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EditError {
    /// The file is not a list of anchors.
    #[error("the anchors: {0}")]
    Malformed(String),
    /// There is nothing to pull, or more than is possible.
    #[error("{0} anchors; 1 to {MOST_ANCHORS} are possible")]
    HandleCount(usize),
    /// A number of an anchor is not finite or beyond 1e6.
    #[error("anchor {0} has a number that is not finite or beyond 1e6")]
    BadTarget(usize),
    /// An anchor's vertex has no UV.
    #[error("anchor {0} names no vertex of a face with UVs")]
    UnknownHandle(usize),
    /// An anchor's vertex has several UVs.
    #[error("anchor {0} names a vertex on a seam; name it by its UV")]
    AmbiguousVertex(usize),
    /// Two anchors pull one vertex or point to two places.
    #[error("anchors {0} and {1} pull one place of the map to different places")]
    Contradictory(usize, usize),
    /// An anchor pulls at a boundary that stays.
    #[error("anchor {0} pulls at a vertex of a boundary, which is fixed")]
    OnBoundary(usize),
    /// The present map has a flip where it should be pulled, and cannot be untangled.
    #[error(
        "face {face} is flipped or empty in the present UVs of its chart, and no map without flips was found near them"
    )]
    Flipped {
        /// The face.
        face: usize,
    },
    /// The winding of a chart contradicts itself, so no map of it is without flips.
    #[error("the chart of face {face} is not orientable")]
    Nonorientable {
        /// A face of it.
        face: usize,
    },
    /// A chart folds over an edge.
    #[error(transparent)]
    Element(#[from] ElementError),
    /// A number is out of range.
    #[error(transparent)]
    Problem(#[from] ProblemError),
}

impl EditError {
    /// Stable name of the cause, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Malformed(_) => "malformed_handles",
            Self::HandleCount(_) => "handle_count",
            Self::BadTarget(_) => "bad_target",
            Self::UnknownHandle(_) => "unknown_handle",
            Self::AmbiguousVertex(_) => "ambiguous_vertex",
            Self::Contradictory(..) => "contradictory_handles",
            Self::OnBoundary(_) => "anchor_on_boundary",
            Self::Flipped { .. } => "flipped_uvs",
            Self::Nonorientable { .. } => "nonorientable_chart",
            Self::Element(error) => error.code(),
            Self::Problem(error) => error.code(),
        }
    }
}

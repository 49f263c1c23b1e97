//! Errors of UV edits.

use crate::problem_error::ProblemError;
use unwrapd_maps::mesh::ElementError;

/// Most anchors: each is compared with every face.
pub(super) const MOST_ANCHORS: usize = 1000;

/// Reason why UVs cannot be edited.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EditError {
    /// The file is not a list of anchors.
    #[error("the anchors cannot be parsed: {0}")]
    Malformed(String),
    /// There are no anchors, or too many.
    #[error("there are {0} anchors; 1 to {MOST_ANCHORS} are allowed")]
    HandleCount(usize),
    /// A number of an anchor is not finite or beyond 1e6.
    #[error("anchor {0} has a coordinate that is not finite or exceeds 1e6")]
    BadTarget(usize),
    /// An anchor's vertex has no UV.
    #[error("anchor {0} names a vertex without UVs")]
    UnknownHandle(usize),
    /// An anchor's UV lies outside every chart.
    #[error("anchor {0} lies outside every chart")]
    Outside(usize),
    /// An anchor's vertex has several UVs.
    #[error("anchor {0} names a vertex on a seam; name it by its UV")]
    AmbiguousVertex(usize),
    /// Two anchors pull one vertex or point to different places.
    #[error("anchors {0} and {1} pull the same point to different targets")]
    Contradictory(usize, usize),
    /// An anchor pulls a fixed boundary.
    #[error("anchor {0} moves a vertex of a fixed boundary")]
    OnBoundary(usize),
    /// The present map has a flip in a chart with anchors, and cannot be untangled.
    #[error("face {face} is flipped or degenerate in its chart, and untangling failed")]
    Flipped {
        /// Index of the face.
        face: usize,
    },
    /// The winding of a chart contradicts itself, so no map of it is free of flips.
    #[error("the chart of face {face} is not orientable")]
    Nonorientable {
        /// A face of the chart.
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
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Malformed(_) => "malformed_handles",
            Self::HandleCount(_) => "handle_count",
            Self::BadTarget(_) => "bad_target",
            Self::UnknownHandle(_) => "unknown_handle",
            Self::Outside(_) => "handle_outside",
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

//! What the work on a document may use, whatever its options ask for.

use serde::{Deserialize, Serialize};

use super::PipelineError;
use crate::document::Document;

/// Limits set by who runs the work, beside the options of who wants it. What is absent is not limited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(default)]
pub struct Limits {
    /// Triangles or tetrahedra of the document; one with more is refused.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub triangles: Option<u64>,
    /// Threads.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threads: Option<usize>,
    /// Seconds after which the current valid map is taken as it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
}

impl Limits {
    /// Refuses a document with too many triangles.
    pub(super) fn check(&self, document: &Document) -> Result<(), PipelineError> {
        let faces = document.primitives().iter().map(|p| p.triangles.len());
        self.check_count(faces.sum())
    }

    /// Refuses too many triangles or tetrahedra.
    pub(super) fn check_count(&self, elements: usize) -> Result<(), PipelineError> {
        let triangles = elements as u64;
        match self.triangles {
            Some(limit) if limit < triangles => {
                Err(PipelineError::TooManyTriangles { triangles, limit })
            }
            _ => Ok(()),
        }
    }
}

//! Limits of the work on a document, whatever its options request.

use serde::{Deserialize, Serialize};

use super::PipelineError;
use unwrapd_files::document::Document;

/// Limits set by the operator, beside the options of the user. Absent limits do not apply.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(default)]
pub struct Limits {
    /// Maximum number of triangles or tetrahedra; larger documents are refused.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub triangles: Option<u64>,
    /// Maximum number of threads.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threads: Option<usize>,
    /// Time limit in seconds. When it is reached, the current valid map becomes the result.
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

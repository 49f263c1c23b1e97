//! Limits on documents, whatever the options request.

use crate::PipelineError;
use unwrapd_api::Limits;
use unwrapd_files::document::Document;

/// Rejects a document with too many triangles.
pub(super) fn check(limits: &Limits, document: &Document) -> Result<(), PipelineError> {
    let faces = document.primitives().iter().map(|p| p.triangles.len());
    check_count(limits, faces.sum())
}

/// Rejects too many triangles or tetrahedra.
pub(super) fn check_count(limits: &Limits, elements: usize) -> Result<(), PipelineError> {
    let triangles = elements as u64;
    match limits.triangles {
        Some(limit) if limit < triangles => {
            Err(PipelineError::TooManyTriangles { triangles, limit })
        }
        _ => Ok(()),
    }
}

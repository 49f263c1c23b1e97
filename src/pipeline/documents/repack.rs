//! UVs packed anew, as they are.

use super::unwrap::{Outcome, unwrap_document};
use crate::document::Upload;
use crate::pipeline::PipelineError;
use crate::pipeline::observer::Observer;
use crate::pipeline::options::RepackOptions;

/// Packs the islands of all primitives of a group into one atlas. Each stays as it is but for quarter turns, shifts and one scale for
/// all; faces that are flipped or overlap within an island stay so, and the certificate counts them.
pub fn repack_document(
    upload: &Upload,
    options: &RepackOptions,
    observer: &dyn Observer,
) -> Result<Outcome, PipelineError> {
    unwrap_document(upload, &options.to_unwrap(), observer)
}

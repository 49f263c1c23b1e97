//! Packing of existing UVs.

use super::unwrap::{Outcome, unwrap_around};
use crate::PipelineError;
use crate::observer::Observer;
use crate::options::{CommandOptions, RepackOptions};
use unwrapd_files::document::Upload;

/// Packs the islands of all primitives of a group into one atlas. Islands only undergo quarter turns, shifts and a
/// common scale. Those with a placement in the options stay there, and the others are packed around them. Faces that
/// are flipped or overlap within an island remain so, and the certificate counts them.
pub fn repack_document(
    upload: &Upload,
    options: &RepackOptions,
    observer: &dyn Observer,
) -> Result<Outcome, PipelineError> {
    options.check()?;
    unwrap_around(upload, &options.to_unwrap(), &options.islands, observer)
}

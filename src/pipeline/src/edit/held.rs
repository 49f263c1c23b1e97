//! UVs of documents in the hand.

use super::uvs::Whole;
use crate::PipelineError;
use crate::limits;
use crate::options::{CommandOptions, EditOptions, Editing};
use unwrapd_deform::uv::UvSession;
use unwrapd_files::document::{Document, Upload};

/// Takes the UVs that [`edit_document`](crate::edit_document) would edit into the hand. Its anchors are for the caller to add.
pub fn hold_uvs(
    upload: &Upload,
    editing: Editing,
    options: &EditOptions,
) -> Result<UvSession, PipelineError> {
    options.check()?;
    let document = Document::read(upload)?;
    limits::check(&options.caller.limits, &document)?;
    let whole = Whole::gather(&document, options.texcoord)?;
    Ok(UvSession::new(&whole.mesh(), options.of_map(editing)))
}

//! UVs of documents for live sessions.

use super::uvs::Whole;
use crate::PipelineError;
use crate::limits;
use crate::options::{CommandOptions, EditOptions, Editing};
use unwrapd_deform::uv::UvSession;
use unwrapd_files::document::{Document, Upload};

/// Opens a session on the UVs that [`edit_document`](crate::edit_document) would edit. The caller adds the anchors.
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

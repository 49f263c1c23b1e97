//! What a document with edited UVs promises.

use crate::certificate::Overlap;
use crate::document::{Document, DocumentError, GroupBy, Marked, OutputFormat, Sets, Terms};
use crate::pipeline::PipelineError;
use crate::pipeline::judge::groups::WrittenUvs;
use crate::pipeline::options::{EditOptions, MeasureOptions};

/// What is promised of a document with edited UVs: what shares a UV space stays as it was, distances are not kept.
pub fn edited_terms(document: &Document, options: &EditOptions) -> Result<Terms, PipelineError> {
    let present = match document.marked()? {
        Marked::Fits(mark) if mark.sets == Sets::One(options.texcoord) => Some(mark.terms),
        _ => None,
    };
    let default = MeasureOptions::default();
    let group_by = present
        .as_ref()
        .map_or(GroupBy::Mesh, |terms| terms.group_by);
    Ok(Terms {
        group_by: match options.format {
            OutputFormat::Obj => GroupBy::Scene,
            OutputFormat::Glb | OutputFormat::Gltf => group_by,
        },
        separate_nodes: present.as_ref().is_some_and(|terms| terms.separate_nodes),
        padding: None,
        resolution: present.map_or(default.resolution(), |terms| terms.resolution),
        pages: None,
        mips: 0,
        aligned: false,
        bits: None,
        overlaps: !options.model.bijective,
        charts: None,
    })
}

/// Whether the promise holds of all charts of the written document, those without anchors too.
pub fn holds(written: &Document, terms: &Terms, texcoord: u32) -> Result<bool, PipelineError> {
    let options = MeasureOptions {
        texcoord: Some(texcoord),
        ..MeasureOptions::default().with_terms(terms)
    };
    let overlap = if terms.overlaps {
        Overlap::Skip
    } else {
        Overlap::Test
    };
    let has_uvs = |primitive: usize| Ok(written.corner_uvs(primitive, texcoord)?.is_some());
    let with_uvs = (0..written.primitives().len()).map(has_uvs);
    let with_uvs: Vec<bool> = with_uvs.collect::<Result<_, DocumentError>>()?;
    let set = |primitive: usize| with_uvs[primitive].then_some(texcoord);
    let uvs = WrittenUvs::gather(written, options.spaces(), set)?;
    let certificates = uvs.certify(&options.claims(overlap));
    Ok((certificates.iter()).all(|c| c.is_valid() && (terms.overlaps || c.is_bijective())))
}

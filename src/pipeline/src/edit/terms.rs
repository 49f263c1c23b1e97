//! Promises in the record of a document with edited UVs.

use crate::PipelineError;
use crate::judge::groups::WrittenUvs;
use crate::judge::proven::{Mirrored, Proven};
use crate::judge::shortfalls::unproven;
use crate::options::{EditOptions, MeasureOptions};
use unwrapd_files::document::{Document, GroupBy, Marked, OutputFormat, Sets, Terms, Warning};
use unwrapd_maps::certificate::Overlap;

/// Returns the record of a document with edited UVs in which no two faces overlap. It promises nothing about
/// distances between charts, which the edit does not check.
pub fn edited_terms(document: &Document, options: &EditOptions) -> Result<Terms, PipelineError> {
    let present = match document.marked()? {
        Marked::Fits(mark) if mark.sets == Sets::One(options.texcoord) => Some(mark.terms),
        _ => None,
    };
    let present = present.as_ref();
    let resolution = present.map(|terms| terms.resolution);
    Ok(Terms {
        group_by: match options.format {
            OutputFormat::Obj => GroupBy::Scene,
            OutputFormat::Glb | OutputFormat::Gltf => {
                present.map_or(document.grouping(), |terms| terms.group_by)
            }
        },
        separate_nodes: present.is_some_and(|terms| terms.separate_nodes),
        padding: None,
        resolution: resolution.unwrap_or(MeasureOptions::default().resolution()),
        pages: None,
        mips: 0,
        aligned: false,
        bits: None,
        overlaps: false,
    })
}

/// Judgment of a whole UV set, including charts without anchors.
pub struct WholeJudgment {
    pub proven: Proven,
    /// Missing properties, in words.
    pub lacking: Vec<&'static str>,
    /// Warnings with place and extent of what is missing.
    pub warnings: Vec<Warning>,
}

impl WholeJudgment {
    /// Judges all primitives that have the set, as [`verify_document`](crate::verify_document) does with
    /// `bijective`. Mirrored charts are left to the author of the UVs.
    pub fn new(document: &Document, texcoord: u32) -> Result<Self, PipelineError> {
        let uvs = WrittenUvs::of_set(document, texcoord)?;
        let certificates = uvs.certify(&Overlap::Test.into());
        let proven = Proven::of(certificates.iter());
        Ok(Self {
            lacking: proven.lacks(Overlap::Test, Mirrored::Allowed),
            warnings: unproven(&uvs.groups, &certificates, Mirrored::Allowed),
            proven,
        })
    }

    pub fn is_certified(&self) -> bool {
        self.lacking.is_empty()
    }

    /// Returns a warning if the UVs were faulty before the edit.
    pub fn as_before(&self) -> Option<Warning> {
        let lacking = self.lacking.join(", ");
        (!self.is_certified()).then(|| {
            Warning::new(
                "uncertified_before",
                format!("before the edit, the UVs already had: {lacking}"),
            )
        })
    }
}

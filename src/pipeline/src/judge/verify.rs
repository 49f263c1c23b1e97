//! Measurement and verification of a document's UVs.

use super::groups::{Question, WrittenUvs};
use super::proven::{Mirrored, Proven, ProvenStacks};
use super::report::Report;
use crate::arrays::unwrap::in_pool;
use crate::options::{CommandOptions, MeasureOptions, VerifyOptions};
use crate::{PipelineError, limits};
use serde::Serialize;
use std::fmt;
use unwrapd_files::document::{Document, GroupBy, Mark, Sets, Upload, Warning};
use unwrapd_maps::certificate::{Certificate, Claims, Overlap, Stacks};

/// The exact judgment of a document's UVs.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Verified {
    /// `true` if everything requested holds.
    pub certified: bool,
    /// Requested properties that do not hold, in words.
    pub lacking: Vec<&'static str>,
    /// Proven properties of all groups.
    pub proven: Proven,
    /// The UVs that were judged.
    pub judged: Judged,
    /// A certificate per group.
    pub groups: Vec<VerifiedGroup>,
    /// The record in the document, if it fits the UVs: what it requires was judged, too.
    #[cfg_attr(feature = "schema", schema(value_type = Option<Object>))]
    pub mark: Option<Mark>,
    /// Warnings about the file that was read.
    pub warnings: Vec<Warning>,
}

/// The UVs of a document that were judged.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Judged {
    /// The UV set, or one for each triangle primitive in file order.
    #[cfg_attr(feature = "schema", schema(value_type = Object))]
    pub texcoord: Sets,
    /// Parts of the document that share a UV space.
    pub group_by: GroupBy,
    /// Faces that name a position twice, which need no UV area.
    pub exempt_faces: usize,
    /// Primitives without the UV set, left out on request or because they had none when the file was recorded.
    pub skipped_primitives: usize,
    /// Faces of an OBJ without UVs, left out on request.
    pub skipped_faces: usize,
    /// Stacks of charts that coincide, accepted on request.
    pub stacks: Option<ProvenStacks>,
}

/// Describes the judged UVs in words.
impl fmt::Display for Judged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shared = match self.group_by {
            GroupBy::Mesh => "mesh",
            GroupBy::Scene => "file",
            GroupBy::Material => "material",
            GroupBy::Primitive => "primitive",
        };
        write!(f, "{}, one atlas per {shared}", self.texcoord)?;
        if self.exempt_faces > 0 {
            let n = self.exempt_faces;
            write!(f, "; exempt: {n} triangles that name a position twice")?;
        }
        if self.skipped_primitives > 0 {
            let n = self.skipped_primitives;
            write!(f, "; left out: {n} primitives without UVs")?;
        }
        if self.skipped_faces > 0 {
            let n = self.skipped_faces;
            write!(f, "; left out: {n} triangles without UVs")?;
        }
        if let Some(stacks) = self.stacks.as_ref().filter(|stacks| stacks.stacks > 0) {
            write!(f, "; accepted: {stacks}")?;
        }
        Ok(())
    }
}

/// The exact judgment of a group's UVs.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct VerifiedGroup {
    /// `mesh0`, `mesh0/prim0`, `material0` or `scene`.
    pub name: String,
    /// Name for display: the name of the mesh or material, otherwise `mesh 0`, `material 0` or `Whole scene`.
    pub label: String,
    /// Certificate of its UVs.
    pub certificate: Certificate,
}

/// Measures the existing UVs of a document.
pub fn measure_document(
    upload: &Upload,
    options: &MeasureOptions,
) -> Result<Report, PipelineError> {
    with_uvs(upload, options, |document, question| {
        let options = &question.options;
        let uvs = WrittenUvs::asked(document, question)?;
        let groups = uvs.judge(&options.claims(Overlap::Test), options.resolution());
        Ok(Report::new(
            groups,
            warnings(document, question),
            Mirrored::InStacks,
        ))
    })
}

/// Judges the existing UVs of a document. Shares no code with the writer.
pub fn verify_document(
    upload: &Upload,
    options: &VerifyOptions,
) -> Result<Verified, PipelineError> {
    let promise = Promise::of(options);
    with_uvs(upload, &options.judged, |document, question| {
        let uvs = WrittenUvs::asked(document, question)?;
        let mut verified = Verified::new(uvs, question, promise);
        verified.judged.group_by = question.options.spaces(document).0;
        verified.judged.skipped_faces = document.n_left_out();
        verified.mark.clone_from(&question.mark);
        verified.warnings = warnings(document, question);
        Ok(verified)
    })
}

/// Properties to prove beside the orientation of every face.
#[derive(Clone, Copy)]
pub struct Promise {
    overlap: Overlap,
    stacks: Stacks,
    mirrored: Mirrored,
}

impl Promise {
    pub fn of(options: &VerifyOptions) -> Self {
        Self {
            overlap: if options.bijective || options.stacks {
                Overlap::Test
            } else {
                Overlap::Skip
            },
            stacks: if options.stacks {
                Stacks::Accepted
            } else {
                Stacks::Refused
            },
            mirrored: if options.unmirrored {
                Mirrored::Refused
            } else {
                Mirrored::Allowed
            },
        }
    }
}

impl Verified {
    /// Judges UVs, without the facts that only their file contains.
    pub(crate) fn new(uvs: WrittenUvs, question: &Question, promise: Promise) -> Self {
        let overlap = question.overlap(promise.overlap);
        let certificates = uvs.certify(&Claims {
            stacks: promise.stacks,
            ..question.options.claims(overlap)
        });
        let exempt_faces = certificates.iter().map(|c| c.exempt_faces).sum();
        let judged = Judged {
            texcoord: question.sets(),
            group_by: question.options.group_by.unwrap_or(GroupBy::Scene),
            exempt_faces,
            skipped_primitives: uvs.n_skipped,
            skipped_faces: 0,
            stacks: Proven::of(certificates.iter()).stacks,
        };
        let groups: Vec<VerifiedGroup> = (uvs.groups.into_iter().zip(certificates))
            .map(|(group, certificate)| VerifiedGroup {
                name: group.name,
                label: group.label,
                certificate,
            })
            .collect();
        let proven = Proven::of(groups.iter().map(|group| &group.certificate));
        let lacking = proven.lacks(question.promised(promise.overlap), promise.mirrored);
        Self {
            certified: lacking.is_empty(),
            lacking,
            proven,
            judged,
            groups,
            mark: None,
            warnings: Vec::new(),
        }
    }
}

/// Returns the warnings about a document and its record.
fn warnings(document: &Document, question: &Question) -> Vec<Warning> {
    let warnings = document.warnings().iter().chain(&question.warning);
    warnings.cloned().collect()
}

/// Answers a question about a document within the limits.
fn with_uvs<T: Send>(
    upload: &Upload,
    options: &MeasureOptions,
    answer: impl FnOnce(&Document, &Question) -> Result<T, PipelineError> + Send,
) -> Result<T, PipelineError> {
    options.check()?;
    in_pool(options.caller.workers(options.workers), || {
        let mut document = Document::read(upload)?;
        limits::check(&options.caller.limits, &document)?;
        if options.skip_missing {
            document = document.with_mapped_faces();
        }
        let question = Question::new(options, &document)?;
        let (_, nodes) = question.options.spaces(&document);
        let document = nodes.prepared(document)?;
        limits::check(&options.caller.limits, &document)?;
        answer(&document, &question)
    })?
}

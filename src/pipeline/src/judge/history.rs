//! Facts about a judged atlas that only unwrapping knows.

use super::bound_report::BoundReport;
use super::groups::WrittenUvs;
use super::report::{AtlasReport, GroupReport};
use crate::PipelineError;
use crate::arrays::plan::Plan;
use crate::arrays::unwrap::Unwrapped;
use crate::options::Options;
use unwrapd_files::document::Warning;

/// Adds the facts that only unwrapping knows to each group.
pub fn add_history(
    groups: &mut [GroupReport],
    atlases: &[Unwrapped],
    uvs: &WrittenUvs,
    plan: &Plan,
    options: &Options,
) {
    let aspect = options.layout.resolution.aspect();
    let names: Vec<String> = groups.iter().map(|group| group.name.clone()).collect();
    for ((group, atlas), uvs) in groups.iter_mut().zip(atlases).zip(&uvs.groups) {
        group.defects = Some(atlas.defects);
        group.atlas = Some(AtlasReport {
            bound: (plan.reported_bound).map(|bound| {
                BoundReport::new(
                    &bound,
                    plan.most_charts,
                    &group.measures.distortion,
                    uvs,
                    aspect,
                )
            }),
            same_as: atlas.same_as.map(|group| names[group].clone()),
            ..AtlasReport::new(atlas)
        });
    }
}

/// Rejects UVs with flips if none are allowed; `missing` describes them.
pub fn promise_kept(
    plan: &Plan,
    groups: &[GroupReport],
    missing: &[Warning],
) -> Result<(), PipelineError> {
    if !plan.is_promised || groups.iter().all(|group| group.certificate.is_valid()) {
        return Ok(());
    }
    let messages: Vec<&str> = missing.iter().map(|w| w.message.as_str()).collect();
    Err(PipelineError::NotValid(messages.join("; ")))
}

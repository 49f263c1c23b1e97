//! Measurement and verification of the UVs of meshes given as arrays.

use super::arrays::{MeshArrays, with_uvs};
use crate::PipelineError;
use crate::arrays::unwrap::in_pool;
use crate::judge::groups::WrittenUvs;
use crate::judge::question::Question;
use crate::judge::report::Report;
use crate::judge::verify::{Promise, Verified};
use crate::limits;
use crate::options::{CommandOptions, MeasureOptions, VerifyOptions};
use unwrapd_maps::certificate::Overlap;
use unwrapd_maps::mesh::VAxis;

/// Measures the UVs of meshes that share a UV space.
pub fn measure_meshes(
    meshes: &[MeshArrays],
    options: &MeasureOptions,
) -> Result<Report, PipelineError> {
    with_question(meshes, options, |uvs, question| {
        let options = &question.options;
        let groups = uvs.judge(&options.claims(Overlap::Test), options.resolution());
        Report::new(groups, Vec::new())
    })
}

/// Judges the UVs of meshes that share a UV space.
pub fn verify_meshes(
    meshes: &[MeshArrays],
    options: &VerifyOptions,
) -> Result<Verified, PipelineError> {
    with_question(meshes, &options.judged, |uvs, question| {
        Verified::new(uvs, question, Promise::of(options))
    })
}

/// Answers a question about meshes within the limits.
fn with_question<T: Send>(
    meshes: &[MeshArrays],
    options: &MeasureOptions,
    answer: impl FnOnce(WrittenUvs, &Question) -> T + Send,
) -> Result<T, PipelineError> {
    options.check()?;
    in_pool(options.caller.workers(options.workers), || {
        let group = with_uvs(meshes)?;
        if group.triangles.is_empty() {
            return Err(PipelineError::NoTriangles);
        }
        limits::check_count(&options.caller.limits, group.triangles.len())?;
        let uvs = WrittenUvs {
            groups: vec![group],
            n_skipped: 0,
            v_axis: VAxis::Up,
        };
        Ok(answer(uvs, &Question::of_options(options)))
    })?
}

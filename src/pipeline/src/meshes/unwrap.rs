//! Unwrapping of meshes given as arrays into one atlas.

use super::arrays::{MeshArrays, judged, merged, placements};
use crate::PipelineError;
use crate::arrays::plan::Plan;
use crate::arrays::unwrap::{Unwrapped, in_pool, unwrap_all};
use crate::judge::groups::WrittenUvs;
use crate::judge::history::{add_history, promise_kept};
use crate::judge::report::{Report, Seconds};
use crate::judge::shortfalls::shortfalls;
use crate::limits;
use crate::observer::Observer;
use crate::options::{CommandOptions, Island, Options, RepackOptions};
use crate::stop_watch::StopWatch;
use crate::tracker::Tracker;
use unwrapd_api::Stage;
use unwrapd_maps::certificate::chart_ids;
use unwrapd_maps::mesh::{CornerUvs, VAxis};

/// Meshes that share an atlas.
#[derive(Clone, Debug)]
pub struct UnwrappedMeshes {
    /// UVs of every corner of every triangle, for each mesh; v up, exact in f32.
    pub uvs: Vec<Vec<CornerUvs>>,
    /// Chart of every triangle, for each mesh, numbered over all meshes.
    pub charts: Vec<Vec<u32>>,
    /// Report on the UVs.
    pub report: Report,
}

/// Unwraps meshes into one atlas and judges the resulting numbers. Options about files have no effect.
pub fn unwrap_meshes(
    meshes: &[MeshArrays],
    options: &Options,
    observer: &dyn Observer,
) -> Result<UnwrappedMeshes, PipelineError> {
    unwrap_around(meshes, options, &[], observer)
}

/// Packs the UV islands of meshes into one atlas. Islands only undergo quarter turns, shifts and a common scale.
pub fn repack_meshes(
    meshes: &[MeshArrays],
    options: &RepackOptions,
    observer: &dyn Observer,
) -> Result<UnwrappedMeshes, PipelineError> {
    options.check()?;
    unwrap_around(meshes, &options.to_unwrap(), &options.islands, observer)
}

fn unwrap_around(
    meshes: &[MeshArrays],
    options: &Options,
    islands: &[Island],
    observer: &dyn Observer,
) -> Result<UnwrappedMeshes, PipelineError> {
    let options = &Options {
        mips: Some(options.mips()),
        ..options.clone()
    };
    options.check()?;
    let settings = options.settings();
    let tracker = Tracker::new(observer, settings.budget);
    in_pool(settings.workers, || {
        unwrap_in_pool(meshes, options, islands, &tracker)
    })?
}

fn unwrap_in_pool(
    meshes: &[MeshArrays],
    options: &Options,
    islands: &[Island],
    tracker: &Tracker,
) -> Result<UnwrappedMeshes, PipelineError> {
    let mut seconds = Seconds::default();
    let mut watch = StopWatch::start(tracker);
    // Merge the meshes.
    tracker.stage(Stage::Read);
    let plan = Plan::new(&options.settings())?;
    let mut mesh = merged(meshes, options, &plan)?;
    limits::check_count(&options.caller.limits, mesh.triangles.len())?;
    mesh.seams.placed = placements(meshes, islands)?;
    seconds.read = watch.lap();

    // Unwrap.
    let atlases = unwrap_all(&[mesh.soup()], &options.settings(), tracker)?;
    let uvs = corner_uvs(&atlases, mesh.seams.uvs.as_deref());
    seconds.unwrap = watch.lap();

    // Judge the UVs as returned.
    tracker.stage(Stage::Judge);
    let group = judged(meshes.len(), mesh.positions, mesh.triangles, uvs);
    let charts = chart_ids(&group.positions, &group.triangles, &group.uvs);
    let uvs = WrittenUvs {
        groups: vec![group],
        n_skipped: 0,
        v_axis: VAxis::Up,
    };
    let mut groups = uvs.judge(&options.claims(), options.layout.resolution);
    add_history(&mut groups, &atlases, &uvs, &plan, options);
    seconds.judge = watch.lap();

    // Report.
    let pairs: Vec<_> = uvs.groups.iter().zip(&groups).collect();
    let missing = shortfalls(&pairs);
    promise_kept(&plan, &groups, &missing)?;
    let warnings = missing.into_iter().chain(tracker.warning());
    let mut report = Report::new(groups, warnings.collect());
    report.options = Some(options.clone());
    report.limits = Some(options.caller.limits);
    report.seconds = Some(seconds);
    Ok(UnwrappedMeshes {
        uvs: divided(meshes, &uvs.groups[0].uvs),
        charts: divided(meshes, &charts),
        report,
    })
}

/// Returns the UVs of an atlas, with the given UVs for islands that stay in place.
fn corner_uvs(atlases: &[Unwrapped], given: Option<&[CornerUvs]>) -> Vec<CornerUvs> {
    let Some(atlas) = atlases.first() else {
        return Vec::new();
    };
    let mut uvs = atlas.corner_uvs();
    if let Some(given) = given {
        for face in atlas.still.iter().map(|&face| face as usize) {
            // A UV less than a step below a page belongs on its border.
            uvs[face] = given[face].map(|uv| uv.map(|x| f64::from((x as f32).max(0.0))));
        }
    }
    uvs
}

/// Splits a list over all triangles by mesh.
fn divided<T: Copy>(meshes: &[MeshArrays], all: &[T]) -> Vec<Vec<T>> {
    let mut rest = all;
    let own = meshes.iter().map(|mesh| {
        let (own, others) = rest.split_at(mesh.triangles.len());
        rest = others;
        own.to_vec()
    });
    own.collect()
}

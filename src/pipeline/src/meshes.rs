//! Meshes given as arrays: unwrapped into one atlas, repacked, measured and verified like those of files.
//!
//! UVs have v up. Vertices at equal positions are identified, also across meshes, as in a document whose meshes share
//! an atlas.

use crate::arrays::placed_faces::on_border;
use crate::arrays::placement::Placement;
use crate::arrays::plan::Plan;
use crate::arrays::seams::Seams;
use crate::arrays::soup::Part;
use crate::arrays::unwrap::{Unwrapped, in_pool, unwrap_all};
use crate::documents::input::Merged;
use crate::documents::selection::{
    FaceAttributes, add_control, check_faces, check_selections, face_control, rule_materials,
};
use crate::island_error::IslandError;
use crate::judge::group_uvs::GroupUvs;
use crate::judge::groups::{Question, WrittenUvs};
use crate::judge::proven::Mirrored;
use crate::judge::report::{Report, Seconds};
use crate::judge::rules::{intended_weights, rule_reports};
use crate::judge::shortfalls::{add_history, nothing_stacked, promise_kept, shortfalls};
use crate::judge::verify::{Promise, Verified};
use crate::observer::Observer;
use crate::options::{
    CommandOptions, GivenSeams, Island, MeasureOptions, NamedSeams, Options, RepackOptions,
    VerifyOptions,
};
use crate::tracker::{StopWatch, Tracker};
use crate::{PipelineError, limits};
use std::collections::HashMap;
use unwrapd_api::Stage;
use unwrapd_maps::certificate::{Overlap, chart_ids};
use unwrapd_maps::mesh::{CornerUvs, MeshError, VAxis};

// Meshes given as arrays, and their merging.

/// A mesh given as arrays. Each list of corners is absent or has one entry per triangle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshArrays {
    /// Positions of the vertices.
    pub positions: Vec<[f64; 3]>,
    /// Vertices of the triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Existing UVs, v up.
    pub uvs: Option<Vec<CornerUvs>>,
    /// Normals of corners, for seams along hard edges.
    pub normals: Option<Vec<[[f64; 3]; 3]>>,
}

impl MeshArrays {
    /// Rejects triangles whose vertices do not exist: in a merged mesh they might refer to another mesh's.
    pub(super) fn check(&self) -> Result<(), MeshError> {
        let n_vertices = self.positions.len();
        let found = self
            .triangles
            .as_flattened()
            .iter()
            .position(|v: &u32| *v as usize >= n_vertices);
        found.map_or(Ok(()), |corner| {
            Err(MeshError::IndexOutOfRange {
                face: corner / 3,
                vertex: self.triangles.as_flattened()[corner],
                n_vertices,
            })
        })
    }
}

/// Returns the name and the label of meshes that share an atlas.
fn label(n_meshes: usize) -> (String, String) {
    if n_meshes == 1 {
        ("mesh0".to_owned(), "mesh 0".to_owned())
    } else {
        ("scene".to_owned(), "Whole scene".to_owned())
    }
}

/// Merges meshes and adds the seams that the options request.
pub(super) fn merged(
    meshes: &[MeshArrays],
    options: &Options,
    plan: &Plan,
) -> Result<Merged, PipelineError> {
    let mut merged = joined(meshes)?;
    if plan.reads_uvs() {
        merged.seams.uvs = Some(all_uvs(meshes)?);
    }
    match &options.seams {
        Some(GivenSeams::Named(NamedSeams::Normals)) => {
            let normals = meshes.iter().enumerate().map(|(index, mesh)| {
                mesh.normals
                    .as_deref()
                    .ok_or_else(|| PipelineError::Seams(format!("mesh {index} has no normals")))
            });
            merged.seams.normals = Some(normals.collect::<Result<Vec<_>, _>>()?.concat());
        }
        Some(GivenSeams::Edges(edges)) => merged.seams.edges = Some(edges.clone()),
        None => {}
    }
    merged.seams.cones.clone_from(&options.cone_vertices);
    Ok(merged)
}

/// Gathers the UVs of meshes, to be judged together.
pub(super) fn with_uvs(meshes: &[MeshArrays]) -> Result<GroupUvs, PipelineError> {
    let Merged {
        positions,
        triangles,
        ..
    } = joined(meshes)?;
    let uvs = all_uvs(meshes)?;
    if uvs.len() != triangles.len() {
        return Err(PipelineError::Seams("not one entry per face".to_owned()));
    }
    Ok(judged(meshes.len(), positions, triangles, uvs))
}

/// Returns the UVs of `n_meshes` meshes as a group to be judged.
pub(super) fn judged(
    n_meshes: usize,
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    uvs: Vec<CornerUvs>,
) -> GroupUvs {
    let (name, label) = label(n_meshes);
    GroupUvs {
        name,
        label,
        positions,
        triangles,
        uvs,
        weights: None,
    }
}

/// Returns the placements of the meshes' islands, whose primitives are meshes.
pub(super) fn placements(
    meshes: &[MeshArrays],
    islands: &[Island],
) -> Result<Vec<Placement>, IslandError> {
    let placed = islands.iter().enumerate().map(|(number, island)| {
        let index = island.primitive as usize;
        let mesh = meshes.get(index);
        let mesh = mesh.filter(|mesh| (island.face as usize) < mesh.triangles.len());
        mesh.ok_or(IslandError::UnknownFace(number))?;
        let before: usize = meshes[..index].iter().map(|m| m.triangles.len()).sum();
        let face = before as u32 + island.face;
        Ok(island.placement(number, face, VAxis::Up))
    });
    placed.collect()
}

fn joined(meshes: &[MeshArrays]) -> Result<Merged, PipelineError> {
    let mut joined = Merged {
        positions: Vec::new(),
        triangles: Vec::new(),
        seams: Seams::default(),
        parts: Vec::new(),
    };
    for mesh in meshes {
        mesh.check()?;
        let [first, first_face] = [joined.positions.len(), joined.triangles.len()];
        let ends = [
            first + mesh.positions.len(),
            first_face + mesh.triangles.len(),
        ];
        let [Ok(end), Ok(end_face)] = ends.map(u32::try_from) else {
            return Err(MeshError::TooLarge.into());
        };
        let (first, first_face) = (first as u32, first_face as u32);
        joined.positions.extend(&mesh.positions);
        let triangles = mesh.triangles.iter().map(|t| t.map(|v| v + first));
        joined.triangles.extend(triangles);
        joined.parts.push(Part {
            vertices: first..end,
            faces: first_face..end_face,
        });
    }
    Ok(joined)
}

fn all_uvs(meshes: &[MeshArrays]) -> Result<Vec<CornerUvs>, PipelineError> {
    let uvs = meshes.iter().enumerate().map(|(index, mesh)| {
        mesh.uvs.as_deref().ok_or_else(|| PipelineError::NoUvs {
            group: format!("mesh {index}"),
            texcoord: 0,
        })
    });
    Ok(uvs.collect::<Result<Vec<_>, _>>()?.concat())
}

// Unwrapping of meshes given as arrays into one atlas.

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

/// Packs the UV islands of meshes into one atlas. Islands are rotated, shifted and scaled by one common factor.
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
    add_rules(&mut mesh, meshes, options, &plan)?;
    mesh.seams.placed = placements(meshes, islands)?;
    seconds.read = watch.lap();

    // Unwrap.
    let atlases = unwrap_all(&[mesh.soup()], &options.settings(), tracker)?;
    let uvs = corner_uvs(&atlases, mesh.seams.uvs.as_deref());
    seconds.unwrap = watch.lap();

    // Judge the UVs as returned.
    tracker.stage(Stage::Judge);
    let returned = divided(meshes, &uvs);
    let group = judged(meshes.len(), mesh.positions, mesh.triangles, uvs);
    let charts = chart_ids(&group.positions, &group.triangles, &group.uvs);
    let mut uvs = WrittenUvs {
        groups: vec![group],
        n_skipped: 0,
        v_axis: VAxis::Up,
    };
    if options.layout.stack_offset {
        uvs.fold();
    }
    for group in &mut uvs.groups {
        group.weights = intended_weights(&mesh.seams, group, &plan);
    }
    let mut groups = uvs.judge(&options.claims(), options.layout.resolution);
    add_history(&mut groups, &atlases, &uvs, &plan, options);
    for (group, uvs) in groups.iter_mut().zip(&uvs.groups) {
        group.rules = rule_reports(&mesh.seams, uvs, options.layout.resolution);
    }
    seconds.judge = watch.lap();

    // Report.
    let pairs: Vec<_> = uvs.groups.iter().zip(&groups).collect();
    let missing = shortfalls(&pairs, Mirrored::of(&plan));
    promise_kept(&plan, &groups, &missing)?;
    let unstacked = nothing_stacked(&groups, options);
    let warnings = missing.into_iter().chain(unstacked);
    let warnings = warnings
        .chain(tracker.bent_borders())
        .chain(tracker.warning());
    let mut report = Report::new(groups, warnings.collect(), Mirrored::of(&plan));
    report.options = Some(options.clone());
    report.limits = Some(options.caller.limits);
    report.seconds = Some(seconds);
    Ok(UnwrappedMeshes {
        uvs: returned,
        charts: divided(meshes, &charts),
        report,
    })
}

/// Adds rules for islands. Meshes given as arrays have no materials and colors; their primitives are the meshes.
fn add_rules(
    merged: &mut Merged,
    meshes: &[MeshArrays],
    options: &Options,
    plan: &Plan,
) -> Result<(), PipelineError> {
    let rules = options.control.rules();
    let n_faces: Vec<usize> = meshes.iter().map(|mesh| mesh.triangles.len()).collect();
    check_faces(&rules, &n_faces)?;
    let faces = n_faces.iter().enumerate();
    let faces = faces.flat_map(|(mesh, &n)| (0..n as u32).map(move |face| [mesh as u32, face]));
    let n_all = merged.triangles.len();
    let attributes = FaceAttributes {
        faces: faces.collect(),
        materials: vec![None; n_all],
        colors: vec![None; n_all],
    };
    let materials = rule_materials(&rules, |_| None)?;
    let control = &options.control;
    if let Some(control) = face_control(
        control,
        &attributes,
        &materials,
        &merged.soup(),
        plan,
        VAxis::Up,
    )? {
        add_control(&mut merged.seams, control);
    }
    Ok(check_selections(&rules, &[&merged.seams])?)
}

/// Returns the UVs of an atlas, with the given UVs for islands that stay in place.
fn corner_uvs(atlases: &[Unwrapped], given: Option<&[CornerUvs]>) -> Vec<CornerUvs> {
    let Some(atlas) = atlases.first() else {
        return Vec::new();
    };
    let mut uvs = atlas.corner_uvs();
    if let Some(given) = given {
        for face in atlas.still.iter().map(|&face| face as usize) {
            uvs[face] = given[face].map(|uv| uv.map(|x| f64::from(on_border(x) as f32)));
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

// Measurement and verification of the UVs of meshes given as arrays.

/// Measures the UVs of meshes that share a UV space.
pub fn measure_meshes(
    meshes: &[MeshArrays],
    options: &MeasureOptions,
) -> Result<Report, PipelineError> {
    with_question(meshes, options, |uvs, question| {
        let options = &question.options;
        let groups = uvs.judge(&options.claims(Overlap::Test), options.resolution());
        Report::new(groups, Vec::new(), Mirrored::InStacks)
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

// Conversion of corner UVs to vertex UVs.

/// A mesh in which every vertex has one UV: each given vertex appears once per distinct UV of its corners, in the
/// order of first use. Vertices without triangles are left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WeldedUvs {
    /// Index of each vertex in the given mesh.
    pub origins: Vec<u32>,
    /// Vertices of the triangles, in the same number, order and rotation as the given ones.
    pub triangles: Vec<[u32; 3]>,
    /// UVs of the vertices.
    pub uvs: Vec<[f64; 2]>,
}

impl WeldedUvs {
    /// Welds triangles with UVs of their corners.
    pub fn new(triangles: &[[u32; 3]], uvs: &[CornerUvs]) -> Self {
        let mut welded = Self::default();
        let mut known: HashMap<(u32, [u64; 2]), u32> = HashMap::with_capacity(triangles.len());
        for (triangle, corners) in triangles.iter().zip(uvs) {
            let face = [0, 1, 2].map(|c| {
                let (vertex, uv) = (triangle[c], corners[c]);
                *known
                    .entry((vertex, uv.map(f64::to_bits)))
                    .or_insert_with(|| {
                        welded.origins.push(vertex);
                        welded.uvs.push(uv);
                        welded.uvs.len() as u32 - 1
                    })
            });
            welded.triangles.push(face);
        }
        welded
    }
}

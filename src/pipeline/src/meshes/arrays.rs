//! Meshes given as arrays, and their merging.

use crate::PipelineError;
use crate::arrays::placement::Placement;
use crate::arrays::plan::Plan;
use crate::arrays::seams::Seams;
use crate::arrays::soup::Part;
use crate::documents::merged::Merged;
use crate::island_error::IslandError;
use crate::judge::group_uvs::GroupUvs;
use crate::options::{GivenSeams, Island, NamedSeams, Options};
use unwrapd_maps::mesh::{CornerUvs, MeshError, VAxis};

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
        let outside = |v: &u32| *v as usize >= n_vertices;
        let found = self.triangles.as_flattened().iter().position(outside);
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
                let none = || PipelineError::Seams(format!("mesh {index} has no normals"));
                mesh.normals.as_deref().ok_or_else(none)
            });
            merged.seams.normals = Some(normals.collect::<Result<Vec<_>, _>>()?.concat());
        }
        Some(GivenSeams::Edges(edges)) => merged.seams.edges = Some(edges.clone()),
        None => {}
    }
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

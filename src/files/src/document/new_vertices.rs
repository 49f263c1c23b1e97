//! Vertices with attributes, made from corners that have attributes each.
use std::collections::HashMap;

/// Attributes of a corner of a triangle.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    /// Vertex of the file.
    pub vertex: u32,
    pub normal: Option<[f32; 3]>,
    pub uv: Option<[f32; 2]>,
}

/// Attributes in which corners must agree to be one vertex.
type Key = (Option<[u32; 3]>, Option<[u32; 2]>);

/// Vertices and triangles of a primitive.
pub(super) struct Vertices {
    /// For each vertex that of the file.
    pub origins: Vec<u32>,
    pub triangles: Vec<[u32; 3]>,
    pub normals: Option<Vec<[f32; 3]>>,
    pub uvs: Option<Vec<[f32; 2]>>,
}

impl Vertices {
    /// Splits the vertices `of_file`, increasing, whose corners differ. The first corner found stays with the vertex,
    /// copies for the others follow after all vertices.
    pub fn new(
        of_file: &[u32],
        corners: impl Iterator<Item = [Corner; 3]>,
        has_normals: bool,
        has_uvs: bool,
    ) -> Self {
        let is_identity = of_file
            .last()
            .is_none_or(|last| *last as usize + 1 == of_file.len());
        let mut given: Vec<Option<Corner>> = vec![None; of_file.len()];
        let mut copies: HashMap<(u32, Key), u32> = HashMap::new();
        let mut origins = of_file.to_vec();
        let mut place = |corner: Corner| {
            let own = if is_identity {
                corner.vertex
            } else {
                // Every corner's vertex is among those of its file.
                of_file.binary_search(&corner.vertex).unwrap_or_default() as u32
            };
            let first = given[own as usize].get_or_insert(corner);
            if key(first) == key(&corner) {
                return own;
            }
            *copies.entry((own, key(&corner))).or_insert_with(|| {
                given.push(Some(corner));
                origins.push(corner.vertex);
                origins.len() as u32 - 1
            })
        };
        let triangles = corners.map(|face| face.map(&mut place)).collect();
        // A vertex of no face has neither; any unit vector will do.
        let normal =
            |corner: &Option<Corner>| corner.and_then(|c| c.normal).unwrap_or([0.0, 0.0, 1.0]);
        let uv = |corner: &Option<Corner>| corner.and_then(|c| c.uv).unwrap_or_default();
        Self {
            normals: has_normals.then(|| given.iter().map(normal).collect()),
            uvs: has_uvs.then(|| given.iter().map(uv).collect()),
            origins,
            triangles,
        }
    }
}

fn key(corner: &Corner) -> Key {
    (
        corner.normal.map(|normal| normal.map(f32::to_bits)),
        corner.uv.map(|uv| uv.map(f32::to_bits)),
    )
}

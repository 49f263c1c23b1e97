//! What gives way where a fold is pushed apart.

use crate::charts::Chart;
use unwrapd_maps::mesh::{UsedVertices, VertexFaces};

/// Faces that give way: so many times those that overlap, and at least so many.
const AROUND: usize = 30;
const LEAST_AROUND: usize = 3_000;

/// Faces of a chart that give way, those beyond them held.
pub struct Surroundings {
    pub faces: Vec<u32>,
    pub vertices: UsedVertices,
    /// In the numbering of `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// Vertices that have faces beyond.
    pub held: Vec<u32>,
}

impl Surroundings {
    /// The faces around some vertices.
    pub fn new(
        chart: &Chart,
        of_vertex: &VertexFaces,
        vertices: impl Iterator<Item = u32>,
    ) -> Self {
        let disk = &chart.disk;
        let near = vertices.flat_map(|v| of_vertex.of(v));
        let mut faces: Vec<u32> = near.copied().collect();
        faces.sort_unstable();
        faces.dedup();
        let wanted = (AROUND * faces.len()).max(LEAST_AROUND);
        let mut is_in = vec![false; disk.triangles.len()];
        for &f in &faces {
            is_in[f as usize] = true;
        }
        let mut done = 0;
        while done < faces.len() && faces.len() < wanted {
            for v in disk.triangles[faces[done] as usize] {
                for &f in of_vertex.of(v) {
                    if !std::mem::replace(&mut is_in[f as usize], true) {
                        faces.push(f);
                    }
                }
            }
            done += 1;
        }
        let triangles = faces.iter().map(|&f| disk.triangles[f as usize]);
        let mut triangles: Vec<[u32; 3]> = triangles.collect();
        let vertices = UsedVertices::new(triangles.iter().flatten().copied());
        vertices.renumber(triangles.as_flattened_mut());
        let has_beyond = |v: u32| of_vertex.of(v).iter().any(|&f| !is_in[f as usize]);
        let numbered = (0..).zip(vertices.as_slice());
        let held = numbered.filter(|&(_, &v)| has_beyond(v));
        Self {
            held: held.map(|(number, _)| number).collect(),
            triangles,
            faces,
            vertices,
        }
    }

    /// The part of a map.
    pub fn gathered(&self, uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let all = self.vertices.as_slice().iter();
        all.map(|&v| uv[v as usize]).collect()
    }
}

//! What gives way where a fold is pushed apart.

use crate::charts::Chart;
use crate::mesh::VertexFaces;

/// Faces that give way: so many times those that overlap, and at least so many.
const AROUND: usize = 30;
const LEAST_AROUND: usize = 3_000;

/// Faces of a chart that give way, those beyond them held.
pub struct Surroundings {
    pub faces: Vec<u32>,
    pub vertices: Vec<u32>,
    /// In the numbering of `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// Vertices that have faces beyond.
    pub held: Vec<u32>,
    /// For each vertex of the chart its number in `vertices`, or [`NONE`].
    pub local: Vec<u32>,
}

/// No vertex.
pub const NONE: u32 = u32::MAX;

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
        let triangle = |&f: &u32| disk.triangles[f as usize];
        let mut vertices: Vec<u32> = faces.iter().flat_map(triangle).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut local = vec![NONE; disk.n_vertices];
        for (i, &v) in (0..).zip(&vertices) {
            local[v as usize] = i;
        }
        let has_beyond = |v: u32| of_vertex.of(v).iter().any(|&f| !is_in[f as usize]);
        let held = vertices.iter().filter(|&&v| has_beyond(v));
        Self {
            triangles: (faces.iter())
                .map(|f| triangle(f).map(|v| local[v as usize]))
                .collect(),
            held: held.map(|&v| local[v as usize]).collect(),
            faces,
            vertices,
            local,
        }
    }

    /// The part of a map.
    pub fn gathered(&self, uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
        self.vertices.iter().map(|&v| uv[v as usize]).collect()
    }
}

//! Parts of a body that no handle moves.

use super::body::Body;
use super::problem::Problem;
use unwrapd_maps::mesh::UnionFind;

impl Problem {
    /// Holds at rest the parts of the body, connected by elements, that have no handle; returns their number.
    ///
    /// Nothing else would keep them in place: energies do not change when a part moves as a rigid body.
    pub fn hold_idle_parts(&mut self) -> usize {
        let (part, n_parts) = parts(&self.body);
        let mut is_idle = vec![true; n_parts];
        for handles in &self.stations {
            let points = handles.points.iter().flatten().map(|&(v, _)| v);
            for v in handles.vertices.iter().copied().chain(points) {
                is_idle[part[v as usize] as usize] = false;
            }
        }
        let vertices = 0..self.body.n_vertices() as u32;
        let held: Vec<u32> = vertices
            .filter(|&v| is_idle[part[v as usize] as usize])
            .collect();
        let dim = self.body.dim();
        for handles in &mut self.stations {
            // One group is enough: it does not move.
            let group = handles.groups.iter().max().map_or(0, |g| g + 1);
            for &v in &held {
                let v_first = dim * v as usize;
                handles.vertices.push(v);
                handles
                    .targets
                    .extend(&self.body.rest[v_first..v_first + dim]);
                handles.groups.push(group);
            }
        }
        is_idle.into_iter().filter(|&idle| idle).count()
    }
}

/// Returns the part number of each vertex, and the number of parts.
fn parts(body: &Body) -> (Vec<u32>, usize) {
    let mut sets = UnionFind::new(body.n_vertices());
    for element in body.corners() {
        for &v in &element[1..] {
            sets.unite(element[0], v);
        }
    }
    sets.labels()
}

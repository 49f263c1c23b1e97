//! A disk whose holes are closed by virtual faces.

use crate::mesh::Disk;
use unwrapd_method::numerics::vec3;

/// A triangulation with one boundary loop: the disk's triangles first, then a fan around a new vertex in each hole.
///
/// Tutte's theorem and the hierarchy require this form. The virtual faces carry (nearly) no distortion energy.
pub(super) struct ClosedDisk {
    /// Vertices of the disk, then one apex per hole, in the middle of its loop.
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// Number of real triangles; those after them are virtual.
    pub n_real: usize,
    /// Outer loop, counter-clockwise.
    pub boundary: Vec<u32>,
}

impl ClosedDisk {
    pub fn new(disk: &Disk, positions: &[[f64; 3]]) -> Self {
        let outer = outer_loop(disk, positions);
        let mut closed = Self {
            positions: positions[..disk.n_vertices].to_vec(),
            triangles: disk.triangles.clone(),
            n_real: disk.triangles.len(),
            boundary: disk.loops[outer].clone(),
        };
        for (_, hole) in disk.loops.iter().enumerate().filter(|(i, _)| *i != outer) {
            let apex = closed.positions.len() as u32;
            let middle = hole.iter().fold([0.0; 3], |sum, &v| {
                vec3::add_scaled(sum, 1.0 / hole.len() as f64, positions[v as usize])
            });
            closed.positions.push(middle);
            // The hole lies to the right of its loop.
            closed.triangles.extend((0..hole.len()).map(|i| {
                let next = hole[(i + 1) % hole.len()];
                [next, hole[i], apex]
            }));
        }
        closed
    }
}

/// Chooses the loop that is longest in space as the outer one, which must contain everything else.
pub(super) fn outer_loop(disk: &Disk, positions: &[[f64; 3]]) -> usize {
    let lengths = disk
        .loops
        .iter()
        .map(|boundary| edge_lengths(boundary, positions).iter().sum::<f64>());
    let longest =
        lengths.enumerate().fold(
            (0, 0.0),
            |best, (i, length)| {
                if length > best.1 { (i, length) } else { best }
            },
        );
    longest.0
}

/// Returns the length in space of the edge from each vertex of a loop to the next.
pub(super) fn edge_lengths(boundary: &[u32], positions: &[[f64; 3]]) -> Vec<f64> {
    let at = |i: usize| positions[boundary[i % boundary.len()] as usize];
    (0..boundary.len())
        .map(|i| vec3::distance(at(i), at(i + 1)))
        .collect()
}

//! Gauss–Seidel sweeps: moves one vertex at a time to the minimum of its triangles' energy.
//!
//! They remove in linear time the short-wave error that reinsertion leaves, for which Newton's method would need a
//! factorization of the whole system.

use super::star::{Corners, Star};
use crate::mesh::VertexFaces;

/// Visits every vertex `n_sweeps` times; the energy falls, and stays finite.
pub(super) fn sweep(
    triangles: &[[u32; 3]],
    corners: &[Corners],
    n_sweeps: usize,
    uv: &mut [[f64; 2]],
) {
    let faces = VertexFaces::new(uv.len(), triangles);
    let mut star = Star::default();
    for _ in 0..n_sweeps {
        for v in 0..uv.len() as u32 {
            star.clear();
            for &face in faces.of(v) {
                let triangle = triangles[face as usize];
                let corner = if triangle[0] == v {
                    0
                } else {
                    1 + usize::from(triangle[2] == v)
                };
                let ends = [1, 2].map(|i| uv[triangle[(corner + i) % 3] as usize]);
                star.push(&corners[face as usize], corner, ends);
            }
            uv[v as usize] = star.settle(uv[v as usize], |_| true);
        }
    }
}

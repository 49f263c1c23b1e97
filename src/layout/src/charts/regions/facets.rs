//! Nearly flat facets: the pieces that merge into charts.

use unwrapd_maps::mesh::{CUT, Surface, spread};
use unwrapd_method::numerics::vec3::{area_vector, dot, unit};

/// A facet's normals lie within about 8° of its first triangle's.
const FACET_CONE_COS: f64 = 0.99;

/// Normals of a surface's triangles, as long as the triangle's area, wound consistently within each piece.
pub fn consistent_normals(surface: &Surface) -> Vec<[f64; 3]> {
    surface
        .adjacency()
        .turned
        .iter()
        .enumerate()
        .map(|(t, &turned)| {
            let [a, b, c] = surface.corners(t);
            area_vector(a, b, c).map(|x| if turned { -x / 2.0 } else { x / 2.0 })
        })
        .collect()
}

/// For each halfedge the one across, where a chart may extend over the edge: glued, and not where a piece that is not
/// orientable changes sides.
pub fn crossings(surface: &Surface) -> Vec<u32> {
    let adjacency = surface.adjacency();
    let crossing = |(h, &t): (u32, &u32)| {
        if t == CUT || adjacency.is_twisted(&surface.triangles, h) {
            CUT
        } else {
            t
        }
    };
    (0u32..).zip(&adjacency.twin).map(crossing).collect()
}

/// Labels connected facets, each grown from its first triangle over neighbors whose normals are close to that triangle's.
/// Triangles without area belong to whichever facet comes first. O(n).
pub fn facets(normals: &[[f64; 3]], across: &[u32]) -> (Vec<u32>, usize) {
    let directions: Vec<[f64; 3]> = normals.iter().map(|&n| unit(n)).collect();
    let mut label = vec![CUT; normals.len()];
    let mut n_facets = 0;
    let mut queue = Vec::new();
    for first in 0..normals.len() {
        if label[first] != CUT {
            continue;
        }
        label[first] = n_facets;
        let mut axis = directions[first];
        queue.clear();
        queue.push(first as u32);
        spread(across, &mut queue, |_, t| {
            let face = t as usize / 3;
            if label[face] != CUT {
                return false;
            }
            if axis == [0.0; 3] {
                axis = directions[face];
            }
            let is_like =
                directions[face] == [0.0; 3] || dot(directions[face], axis) > FACET_CONE_COS;
            if is_like {
                label[face] = n_facets;
            }
            is_like
        });
        n_facets += 1;
    }
    (label, n_facets as usize)
}

//! Overlapping triangles.

use super::box_index::{BoxIndex, Visit, search_budget};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of};
use unwrapd_method::numerics::predicates::orient2d_sign;

type PlaneTriangle = [[f64; 2]; 3];

/// Visits every pair of counter-clockwise triangles with `is_asked` whose interiors have a common point, the smaller
/// number first; the search is truncated after [`search_budget`] comparisons.
pub fn overlapping_pairs(
    triangles: &[PlaneTriangle],
    is_asked: impl Fn([u32; 2]) -> bool,
    mut visit: impl FnMut([u32; 2]),
) -> Visit {
    let boxes: Vec<Bounds> = triangles.iter().map(|t| bounds_of(t)).collect();
    BoxIndex::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
        let pair = [i.min(j), i.max(j)];
        if is_asked(pair) && interiors_intersect(&triangles[i as usize], &triangles[j as usize]) {
            visit(pair);
        }
    })
}

/// Returns whether all triangles are counter-clockwise and no two have an interior point in common, exactly; `false`
/// also if the search was truncated.
pub fn are_disjoint(vertices: &[[f64; 2]], triangles: &[[u32; 3]]) -> bool {
    let corners = |t: &[u32; 3]| t.map(|v| vertices[v as usize]);
    let triangles: Vec<PlaneTriangle> = triangles.iter().map(corners).collect();
    let is_positive = |&[a, b, c]: &PlaneTriangle| orient2d_sign(a, b, c) > 0;
    if !triangles.iter().all(is_positive) {
        return false;
    }
    let mut is_any = false;
    let visit = overlapping_pairs(&triangles, |_| true, |_| is_any = true);
    !is_any && visit == Visit::Complete
}

/// Returns whether two counter-clockwise triangles have interior points in common, exactly: this fails if and only
/// if the line of an edge of one has the other on its right or on itself.
pub fn interiors_intersect(a: &PlaneTriangle, b: &PlaneTriangle) -> bool {
    let is_beyond = |[p, q]: [[f64; 2]; 2], t: &PlaneTriangle| {
        t.iter().all(|&corner| orient2d_sign(p, q, corner) <= 0)
    };
    let is_apart = |[a, b, c]: PlaneTriangle, t: &PlaneTriangle| {
        [[a, b], [b, c], [c, a]]
            .into_iter()
            .any(|edge| is_beyond(edge, t))
    };
    !is_apart(*a, b) && !is_apart(*b, a)
}

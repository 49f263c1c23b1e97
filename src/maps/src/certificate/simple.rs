//! Exact intersection tests for polygons.

use super::{Bounds, BoxTree, Visit, bounds_of, enlarged, search_budget};
use crate::mesh::boundary_edges;
use unwrapd_method::numerics::predicates::orient2d_sign;

type LoopSegment = [[f64; 2]; 2];

/// Returns a vertex near which closed polygons cross or touch themselves or each other; `None` if they do not.
pub(super) fn meeting_point(loops: &[Vec<[f64; 2]>]) -> Option<[f64; 2]> {
    let (mut segments, mut next) = (Vec::new(), Vec::new());
    for vertices in loops {
        let (first, n) = (segments.len() as u32, vertices.len());
        segments.extend((0..n).map(|k| [vertices[k], vertices[(k + 1) % n]]));
        next.extend((0..n as u32).map(|k| first + (k + 1) % n as u32));
    }
    let boxes: Vec<Bounds> = segments.iter().map(|s| enlarged(bounds_of(s))).collect();
    let mut found = None;
    let visit = BoxTree::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
        let [a, b] = [segments[i as usize], segments[j as usize]];
        let meet = if next[i as usize] == j {
            turns_back(a, b)
        } else if next[j as usize] == i {
            turns_back(b, a)
        } else {
            intersect(a, b)
        };
        if meet && found.is_none() {
            found = Some(a[0]);
        }
    });
    // Only segments that lie in heaps exhaust the search; they would have to meet.
    found.or_else(|| (visit == Visit::Truncated).then(|| segments[0][0]))
}

/// Counts the pairs of a planar mesh's boundary edges that have a common point other than a shared vertex, exactly; a
/// lower bound if the search was truncated.
///
/// A mesh without inverted triangles whose boundary crossed nothing as it moved has none, and is bijective.
pub fn boundary_crossings(vertices: &[[f64; 2]], triangles: &[[u32; 3]]) -> u64 {
    let edges = boundary_edges(vertices.len(), triangles);
    let segment = |edge: [u32; 2]| edge.map(|v| vertices[v as usize]);
    let boxes: Vec<Bounds> = (edges.iter())
        .map(|&edge| enlarged(bounds_of(&segment(edge))))
        .collect();
    let mut n_crossings = 0;
    BoxTree::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
        let [e, f] = [edges[i as usize], edges[j as usize]];
        let meet = match e.iter().find(|v| f.contains(v)) {
            None => intersect(segment(e), segment(f)),
            Some(&shared) => {
                let other = |edge: [u32; 2]| edge[usize::from(edge[0] == shared)];
                turns_back(segment([other(e), shared]), segment([shared, other(f)]))
            }
        };
        n_crossings += u64::from(meet);
    });
    n_crossings
}

/// Returns whether a segment runs back over the one that ends where it begins.
fn turns_back(a: LoopSegment, b: LoopSegment) -> bool {
    let along = |k: usize| (a[1][k] - a[0][k]) * (b[1][k] - b[0][k]);
    orient2d_sign(a[0], a[1], b[1]) == 0 && along(0) + along(1) < 0.0
}

/// Returns whether two segments have a common point.
fn intersect(a: LoopSegment, b: LoopSegment) -> bool {
    let sides = |s: LoopSegment, t: LoopSegment| t.map(|p| orient2d_sign(s[0], s[1], p));
    let (of_b, of_a) = (sides(a, b), sides(b, a));
    if of_b == [0; 2] {
        // On one line: they meet if their boxes do.
        return (0..2).all(|k| {
            let range = |s: LoopSegment| [s[0][k].min(s[1][k]), s[0][k].max(s[1][k])];
            let (p, q) = (range(a), range(b));
            p[0] <= q[1] && q[0] <= p[1]
        });
    }
    of_b[0] * of_b[1] <= 0 && of_a[0] * of_a[1] <= 0
}

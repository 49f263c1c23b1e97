//! Pairs of edges that stay apart however their ends move.

use super::boundary::{BoundaryEdge, ChartBoundary};
use super::box_tree::Visit;
use super::fixed::{Fixed, dot, fixed, taxicab};
use super::rounding::{allowance, largest_move};

/// Visits the pairs of boundary edges that may meet when each coordinate moves by up to the move of `bits`.
///
/// As long as all faces stay positive, faces of an injective map can come to overlap only after boundary edges of
/// charts touch. So a map without such a pair stays injective. Ends that are one vertex with one UV move together.
pub(super) fn doubtful_pairs(
    boundary: &ChartBoundary,
    bits: u32,
    mut visit: impl FnMut([u32; 2]),
) -> Visit {
    let delta = allowance(bits);
    // The boxes that can be reached, and a little more.
    boundary.near_pairs(1.001 * largest_move(bits), |a, b| {
        if !stay_apart(a, b, delta) {
            visit([a.face, b.face]);
        }
    })
}

fn stay_apart(a: &BoundaryEdge, b: &BoundaryEdge, delta: i128) -> bool {
    let shared = |i: usize, j: usize| a.vertices[i] == b.vertices[j] && a.uvs[i] == b.uvs[j];
    let ends = [[0, 0], [0, 1], [1, 0], [1, 1]];
    match ends.into_iter().find(|&[i, j]| shared(i, j)) {
        // They would have to point the same way: then the end of the shorter lies on the longer.
        Some([i, j]) => {
            let [a, b] = [(a, 1 - i), (b, 1 - j)].map(|(edge, end)| (edge.uvs[end], edge.uvs));
            let is_clear = |end, edge: [[f64; 2]; 2]| {
                keep_their_distance([fixed(end); 2], edge.map(fixed), delta)
            };
            is_clear(a.0, b.1) && is_clear(b.0, a.1)
        }
        None => keep_their_distance(a.uvs.map(fixed), b.uvs.map(fixed), delta),
    }
}

/// Returns whether two segments have no common point however each coordinate of their ends moves by up to `delta`.
///
/// They can have one if and only if one segment, moved as a whole by up to 2δ along each axis, can meet the other: then
/// a point of each can move to the middle, with all ends. The shifts at which they meet form a polygon whose sides run
/// along the segments and the axes; zero lies outside if and only if it does so beyond one of these sides.
fn keep_their_distance(a: [Fixed; 2], b: [Fixed; 2], delta: i128) -> bool {
    let normal = |[p, q]: [Fixed; 2]| [p[1] - q[1], q[0] - p[0]];
    [[1, 0], [0, 1], normal(a), normal(b)].into_iter().any(|n| {
        let range = |s: [Fixed; 2]| {
            let [p, q] = s.map(|p| dot(n, p));
            [p.min(q), p.max(q)]
        };
        let ([low_a, high_a], [low_b, high_b]) = (range(a), range(b));
        (low_a - high_b).max(low_b - high_a) > 2 * delta * taxicab(n)
    })
}

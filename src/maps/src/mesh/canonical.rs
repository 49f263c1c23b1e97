//! Canonical order of a surface's triangles, derived from its shape.

use super::{CUT, Surface, next, origin};
use std::collections::VecDeque;
use unwrapd_method::numerics::principal_axes::PrincipalAxes;
use unwrapd_method::numerics::vec3::{add_scaled, cross, dot, sub};

/// Direction in which an order begins, in coordinates along the principal axes: far out along the longest. The others
/// decide between mirror images.
const BEGINNING: [f64; 3] = [1.0, 0.37, 0.61];

/// Returns the triangles of a surface in canonical order: independent of the order of triangles and vertices in the
/// input and of translation, rotation and scale, up to rounding and symmetry.
///
/// The piece with the most triangles comes first. In each piece the triangles are traversed breadth first, from a
/// halfedge that its shape singles out.
pub fn canonical_order(surface: &Surface) -> Vec<u32> {
    let n = surface.triangles.len();
    let twin = &surface.adjacency().twin;
    let mut is_reached = vec![false; n];
    let mut order = Vec::with_capacity(n);
    let mut open = VecDeque::new();
    for first in beginnings(surface) {
        is_reached[first as usize / 3] = true;
        open.push_back(first);
        while let Some(h) = open.pop_front() {
            order.push(h / 3);
            for t in [h, next(h), next(next(h))].map(|h| twin[h as usize]) {
                if t != CUT && !std::mem::replace(&mut is_reached[t as usize / 3], true) {
                    open.push_back(t);
                }
            }
        }
    }
    order
}

/// Returns for each piece the halfedge to begin at: the one that starts farthest along [`BEGINNING`] and, among equals,
/// ends farthest.
fn beginnings(surface: &Surface) -> Vec<u32> {
    let height = heights(surface);
    let key = |h: u32| [h, next(h)].map(|h| height[origin(&surface.triangles, h) as usize]);
    let higher = |a: [f64; 2], b: [f64; 2]| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
    let adjacency = surface.adjacency();
    let mut first: Vec<Option<u32>> = vec![None; adjacency.n_pieces];
    let mut n_triangles = vec![0_u32; adjacency.n_pieces];
    for (triangle, &piece) in (0u32..).zip(&adjacency.piece) {
        n_triangles[piece as usize] += 1;
        for h in 3 * triangle..3 * triangle + 3 {
            let highest = &mut first[piece as usize];
            if highest.is_none_or(|known| higher(key(h), key(known)).is_gt()) {
                *highest = Some(h);
            }
        }
    }
    let mut pieces: Vec<(u32, u32)> = n_triangles
        .into_iter()
        .zip(first.into_iter().flatten())
        .collect();
    pieces.sort_by(|a, b| b.0.cmp(&a.0).then_with(|| higher(key(b.1), key(a.1))));
    pieces.into_iter().map(|(_, first)| first).collect()
}

/// Returns the coordinate of each vertex along [`BEGINNING`].
fn heights(surface: &Surface) -> Vec<f64> {
    let corners = surface.triangles.as_flattened();
    let position = |&v: &u32| surface.positions[v as usize];
    let PrincipalAxes {
        center,
        mut axes,
        skew,
    } = PrincipalAxes::of(corners.iter().map(position));
    // Where a surface is its own mirror image, one axis is known but for its sign.
    if dot(cross(axes[0], axes[1]), axes[2]) < 0.0
        && let Some(unsure) = (0..3).min_by(|&a, &b| skew[a].total_cmp(&skew[b]))
    {
        axes[unsure] = axes[unsure].map(|x| -x);
    }
    let beginning = (0..3).fold([0.0; 3], |sum, k| add_scaled(sum, BEGINNING[k], axes[k]));
    let positions = surface.positions.iter();
    positions.map(|&p| dot(sub(p, center), beginning)).collect()
}

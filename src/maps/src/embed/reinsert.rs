//! Reinsertion of collapsed vertices into a map without flipping a triangle.

use super::decimate::{Collapse, Collapses};
use super::rest::{Least, rest_shape};
use super::star::{Corners, Star};
use super::triangulation::pairs;
use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::numerics::vec2::{cross, dot, sub};
use unwrapd_method::numerics::vec3;

/// Steps of the walk toward the neighbor, each 0.6 times the one before: the last is 1e-33 of the first.
const WALK: usize = 150;

/// A ring left no room that floating point can represent.
#[derive(Clone, Copy, Debug)]
pub(super) struct NoRoom;

/// Surfaces in space: positions in the unit of the rest shapes, and the least size of shapes.
#[derive(Clone, Copy)]
pub(super) struct Shape<'a> {
    pub positions: &'a [[f64; 3]],
    pub least: Least,
}

/// Undoes the collapses, last first; `uv` must be positive on the coarse triangles and is then positive on the fine
/// ones, exactly.
pub(super) fn reinsert(
    collapses: &Collapses,
    shape: &Shape,
    uv: &mut [[f64; 2]],
) -> Result<(), NoRoom> {
    for collapse in collapses.list.iter().rev() {
        let ring = collapses.ring(collapse);
        let is_free = |p: &[f64; 2]| {
            pairs(ring, collapse.closed)
                .all(|[a, b]| orient2d_sign(*p, uv[a as usize], uv[b as usize]) > 0)
        };
        let place = Some(similar_place(collapse, ring, shape, uv))
            .filter(is_free)
            .or_else(|| walk(collapse, ring, uv).find(is_free))
            .ok_or(NoRoom)?;
        uv[collapse.vertex as usize] =
            improved_place(collapse, ring, shape, uv, place, |p| is_free(&p));
    }
    Ok(())
}

/// Returns the mean of the places at which the vertex would form, with each edge of its ring, a triangle similar to
/// that in space.
fn similar_place(collapse: &Collapse, ring: &[u32], shape: &Shape, uv: &[[f64; 2]]) -> [f64; 2] {
    let at = |v: u32| shape.positions[v as usize];
    let (mut sum, mut n) = ([0.0; 2], 0.0);
    for [a, b] in pairs(ring, collapse.closed) {
        let (edge, side) = (
            vec3::sub(at(b), at(a)),
            vec3::sub(at(collapse.vertex), at(a)),
        );
        let squared = vec3::dot(edge, edge).max(shape.least.size * shape.least.size);
        let along = vec3::dot(edge, side) / squared;
        let height = vec3::norm(vec3::cross(edge, side)) / squared;
        let (p, q) = (uv[a as usize], uv[b as usize]);
        let [x, y] = sub(q, p);
        sum[0] += p[0] + along * x - height * y;
        sum[1] += p[1] + along * y + height * x;
        n += 1.0;
    }
    sum.map(|x| x / n)
}

/// Iterates over points ever nearer to the neighbor onto which the vertex was collapsed.
///
/// That neighbor sees the whole ring, because its triangles are positive; so does every point close to it in a
/// direction inside its angle. For a boundary vertex the direction is perpendicular to the neighbor's boundary edge
/// that stays.
fn walk(
    collapse: &Collapse,
    ring: &[u32],
    uv: &[[f64; 2]],
) -> impl Iterator<Item = [f64; 2]> + use<> {
    let n = ring.len();
    let at = collapse.at as usize;
    let origin = uv[ring[at] as usize];
    let edge = |i: usize| sub(uv[ring[i % n] as usize], origin);
    let (direction, reach) = if collapse.closed {
        let (after, before) = (edge(at + 1), edge(at + n - 1));
        (bisector(after, before), length(after).min(length(before)))
    } else if at == 0 {
        let [x, y] = edge(1);
        ([-y, x], length([x, y]))
    } else {
        let [x, y] = edge(at - 1);
        ([y, -x], length([x, y]))
    };
    let unit = reach / length(direction).max(f64::MIN_POSITIVE);
    (0..WALK as i32).map(move |i| {
        let step = unit * 0.6_f64.powi(i);
        [
            origin[0] + step * direction[0],
            origin[1] + step * direction[1],
        ]
    })
}

fn length(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}

/// Returns the direction halfway from `a` counter-clockwise to `b`.
fn bisector(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let angle = cross(a, b).atan2(dot(a, b));
    let half = 0.5
        * if angle <= 0.0 {
            angle + std::f64::consts::TAU
        } else {
            angle
        };
    let (sin, cos) = half.sin_cos();
    [cos * a[0] - sin * a[1], sin * a[0] + cos * a[1]]
}

/// Improves the place by local Newton steps; every step is checked exactly.
fn improved_place(
    collapse: &Collapse,
    ring: &[u32],
    shape: &Shape,
    uv: &[[f64; 2]],
    place: [f64; 2],
    is_free: impl Fn([f64; 2]) -> bool,
) -> [f64; 2] {
    let at = |v: u32| shape.positions[v as usize];
    let mut star = Star::default();
    for [a, b] in pairs(ring, collapse.closed) {
        let rest = rest_shape([at(collapse.vertex), at(a), at(b)], shape.least);
        star.push(&Corners::new(&rest), 0, [uv[a as usize], uv[b as usize]]);
    }
    star.settle(place, is_free)
}

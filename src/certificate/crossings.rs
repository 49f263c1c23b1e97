//! Pairs of triangles in space that pass through each other.

use super::box_tree::{Bounds, BoxTree, Visit, bounds_of, enlarged, search_budget};
use super::overlap::interiors_intersect;
use crate::mesh::orient3d_sign;
use crate::numerics::predicates::orient2d_sign;
use serde::Serialize;

/// How many crossing pairs are named.
const NAMED: usize = 8;

type Triangle = [[f64; 3]; 3];

/// Where a surface crosses itself.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct Crossings {
    /// Pairs of triangles whose relative interiors have a common point.
    pub pairs: u64,
    /// The first few of them.
    pub named: Vec<[u32; 2]>,
    /// Whether the search stopped at its limit, so that there may be more.
    pub truncated: bool,
}

/// Counts the pairs of triangles whose relative interiors meet, by exact predicates.
///
/// Triangles that share a vertex or an edge, by index or by equal positions, therefore count only if they cross elsewhere, and
/// so do those that touch: a vertex on a face, an edge on an edge. Coplanar triangles count if they overlap. Triangles of zero
/// area cross nothing; neither do those with a coordinate that is not finite or an index out of range.
pub fn crossings(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Crossings {
    let corner = |v: u32| {
        let position = positions.get(v as usize)?;
        position.iter().all(|x| x.is_finite()).then_some(*position)
    };
    let corners = |t: &[u32; 3]| Some([corner(t[0])?, corner(t[1])?, corner(t[2])?]);
    let (faces, corners): (Vec<u32>, Vec<Triangle>) = (0..)
        .zip(triangles)
        .filter_map(|(face, triangle)| Some((face, corners(triangle)?)))
        .unzip();
    // Boxes of triangles parallel to an axis are flat, and only the interiors of boxes meet.
    let boxes: Vec<Bounds<3>> = corners.iter().map(|c| enlarged(bounds_of(c))).collect();
    let mut found = Crossings::default();
    let visit = BoxTree::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
        if cross(&corners[i as usize], &corners[j as usize]) {
            found.pairs += 1;
            if found.named.len() < NAMED {
                found.named.push([i, j].map(|k| faces[k as usize]));
            }
        }
    });
    found.truncated = visit == Visit::Truncated;
    found
}

/// Whether the relative interiors of two triangles have a common point.
fn cross(a: &Triangle, b: &Triangle) -> bool {
    let sides_of_a = a.map(|p| orient3d_sign(b[0], b[1], b[2], p));
    let sides_of_b = b.map(|p| orient3d_sign(a[0], a[1], a[2], p));
    if sides_of_a == [0; 3] && sides_of_b == [0; 3] {
        return coplanar_overlap(a, b);
    }
    let (Some(apex_a), Some(apex_b)) = (apex(sides_of_a), apex(sides_of_b)) else {
        return false;
    };
    let rotated = |t: &Triangle, k: usize| [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
    let (mut p, mut q) = (rotated(a, apex_a), rotated(b, apex_b));
    if sides_of_a[apex_a] < 0 {
        q.swap(1, 2);
    }
    if sides_of_b[apex_b] < 0 {
        p.swap(1, 2);
    }
    // Now each apex lies above the other's plane. The planes meet in a line, which runs through p from edge p₀p₂ to p₀p₁ and
    // through q from edge q₀q₁ to q₀q₂. Where two of these edges pass the line in order is the sign of the tetrahedron
    // they span; both intervals have interior points in common if each begins before the other ends.
    orient3d_sign(p[0], p[1], q[0], q[1]) < 0 && orient3d_sign(p[0], p[2], q[0], q[2]) > 0
}

/// The corner that is alone on its side of a plane which passes between the corners; a corner on the plane is on the other side.
fn apex(sides: [i8; 3]) -> Option<usize> {
    if !(sides.contains(&1) && sides.contains(&-1)) {
        return None;
    }
    (0..3).find(|&k| {
        sides[k] != 0 && sides[(k + 1) % 3] != sides[k] && sides[(k + 2) % 3] != sides[k]
    })
}

/// Whether two triangles of one plane overlap: they do in the first coordinate plane on which both have an area.
fn coplanar_overlap(a: &Triangle, b: &Triangle) -> bool {
    [[0, 1], [1, 2], [2, 0]]
        .into_iter()
        .find_map(|[x, y]| {
            let counter_clockwise = |t: &Triangle| {
                let [p, q, r] = t.map(|p| [p[x], p[y]]);
                match orient2d_sign(p, q, r) {
                    0 => None,
                    1 => Some([p, q, r]),
                    _ => Some([p, r, q]),
                }
            };
            Some(interiors_intersect(
                &counter_clockwise(a)?,
                &counter_clockwise(b)?,
            ))
        })
        .unwrap_or(false)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cross and dot products of integers.
    fn normal(t: &[[i64; 3]; 3]) -> [i64; 3] {
        let [u, v] = [1, 2].map(|k| [0, 1, 2].map(|x| t[k][x] - t[0][x]));
        [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ]
    }

    fn dot(a: [i64; 3], b: [i64; 3]) -> i64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    /// The interval of the line of two planes inside `t`, as fractions of a coordinate along `axis`.
    fn interval(t: &[[i64; 3]; 3], n: [i64; 3], origin: [i64; 3], axis: usize) -> Vec<(i64, i64)> {
        let height = t.map(|p| dot(n, [0, 1, 2].map(|x| p[x] - origin[x])));
        let mut ends = Vec::new();
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let (h, g) = (height[i], height[j]);
            if (h < 0) != (g < 0) || h == 0 || g == 0 {
                let denominator = h - g;
                if denominator != 0 {
                    let numerator = h * t[j][axis] - g * t[i][axis];
                    ends.push((numerator * denominator.signum(), denominator.abs()));
                }
            }
        }
        ends.sort_by(|a, b| (a.0 * b.1).cmp(&(b.0 * a.1)));
        ends
    }

    /// The same question answered in rational numbers, for triangles that are not coplanar.
    fn cross_rational(a: &[[i64; 3]; 3], b: &[[i64; 3]; 3]) -> Option<bool> {
        let (na, nb) = (normal(a), normal(b));
        let line = normal(&[[0; 3], na, nb]);
        let axis = (0..3).find(|&x| line[x] != 0)?;
        let straddles = |t: &[[i64; 3]; 3], n, o: [i64; 3]| {
            let h = t.map(|p| dot(n, [0, 1, 2].map(|x| p[x] - o[x])));
            h.iter().any(|&x| x > 0) && h.iter().any(|&x| x < 0)
        };
        if !straddles(a, nb, b[0]) || !straddles(b, na, a[0]) {
            return Some(false);
        }
        let (ia, ib) = (interval(a, nb, b[0], axis), interval(b, na, a[0], axis));
        let less = |x: &(i64, i64), y: &(i64, i64)| x.0 * y.1 < y.0 * x.1;
        let ends = |i: &[(i64, i64)]| Some((*i.first()?, *i.last()?));
        let ((a0, a1), (b0, b1)) = (ends(&ia)?, ends(&ib)?);
        Some(less(&a0, &b1) && less(&b0, &a1))
    }

    #[test]
    fn crossing_agrees_with_rational_numbers() {
        let mut state = 1_u64;
        let mut random = |n: i64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as i64 % n
        };
        let mut counts = [0; 2];
        for round in 0..200_000 {
            // Few coordinates, so that edges meet and corners are shared often.
            let n = if round % 2 == 0 { 4 } else { 50 };
            let mut triangle = || [(); 3].map(|()| [(); 3].map(|()| random(n)));
            let (a, b) = (triangle(), triangle());
            let Some(expected) = cross_rational(&a, &b) else {
                continue;
            };
            let [p, q] = [a, b].map(|t| t.map(|p| p.map(|x| x as f64)));
            assert_eq!(cross(&p, &q), expected, "{a:?} {b:?}");
            assert_eq!(cross(&q, &p), expected, "{b:?} {a:?}");
            counts[usize::from(expected)] += 1;
        }
        assert!(counts[0] > 10_000 && counts[1] > 10_000, "{counts:?}");
    }
}

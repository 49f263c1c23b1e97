//! Pairs of triangles in space that pass through each other.

use super::NAMED;
use super::overlap::interiors_intersect;
use super::{Bounds, BoxTree, Visit, bounds_of, enlarged, search_budget};
use serde::Serialize;
use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::numerics::predicates::orient3d_sign;

type CrossingTriangle = [[f64; 3]; 3];

/// Where a surface crosses itself.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Crossings {
    /// Pairs of triangles whose relative interiors have a common point.
    pub pairs: u64,
    /// The first few of them.
    pub named: Vec<[u32; 2]>,
    /// `true` if the search stopped at its limit, so that there may be more.
    pub truncated: bool,
}

/// Counts the pairs of triangles whose relative interiors meet, by exact predicates.
///
/// Triangles that share a vertex or an edge, by index or by equal positions, or that only touch (a vertex on a face, an
/// edge on an edge), therefore count only if they also cross elsewhere. Coplanar triangles count if they overlap.
/// Triangles of zero area cross nothing; neither do those with a coordinate that is not finite or an index out of
/// range.
pub fn crossings(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Crossings {
    let corner = |v: u32| {
        let position = positions.get(v as usize)?;
        position.iter().all(|x| x.is_finite()).then_some(*position)
    };
    let corners = |t: &[u32; 3]| Some([corner(t[0])?, corner(t[1])?, corner(t[2])?]);
    let (faces, corners): (Vec<u32>, Vec<CrossingTriangle>) = (0..)
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

/// Returns whether the relative interiors of two triangles have a common point.
fn cross(a: &CrossingTriangle, b: &CrossingTriangle) -> bool {
    let sides_of_a = a.map(|p| side(b, p));
    let sides_of_b = b.map(|p| side(a, p));
    if sides_of_a == [0; 3] && sides_of_b == [0; 3] {
        return coplanar_overlap(a, b);
    }
    let (Some(apex_a), Some(apex_b)) = (apex(sides_of_a), apex(sides_of_b)) else {
        return false;
    };
    let rotated = |t: &CrossingTriangle, k: usize| [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
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

/// Returns the side of a triangle's plane on which a point lies. A common corner, for which the exact predicate is
/// slow, is on it.
fn side(triangle: &CrossingTriangle, point: [f64; 3]) -> i8 {
    if triangle.contains(&point) {
        return 0;
    }
    orient3d_sign(triangle[0], triangle[1], triangle[2], point)
}

/// Returns the corner that is alone on its side of a plane which passes between the corners; a corner on the plane
/// counts for the other side.
fn apex(sides: [i8; 3]) -> Option<usize> {
    if !(sides.contains(&1) && sides.contains(&-1)) {
        return None;
    }
    (0..3).find(|&k| {
        sides[k] != 0 && sides[(k + 1) % 3] != sides[k] && sides[(k + 2) % 3] != sides[k]
    })
}

/// Returns whether two triangles of one plane overlap, tested in the first coordinate plane in which both have an area.
fn coplanar_overlap(a: &CrossingTriangle, b: &CrossingTriangle) -> bool {
    [[0, 1], [1, 2], [2, 0]]
        .into_iter()
        .find_map(|[x, y]| {
            let counter_clockwise = |t: &CrossingTriangle| {
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

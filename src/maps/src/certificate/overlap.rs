//! Pairs of faces whose interiors intersect in UV space.

use super::NAMED;
use super::box_tree::{Bounds, BoxTree, BoxVisit, bounds_of, enlarged, search_budget};
use super::topology::UvTopology;
use crate::mesh::{CornerUvs, boundary_edges};
use serde::Serialize;
use std::collections::HashMap;
use unwrapd_method::numerics::predicates::{orient2d_sign, orient3d_sign};

/// Faces of nonzero orientation, all made counter-clockwise.
pub(crate) struct OrientedFaces {
    faces: Vec<u32>,
    corners: Vec<CornerUvs>,
}

/// A pair of overlapping faces.
#[derive(Clone, Copy)]
pub(crate) struct OverlappingPair {
    pub faces: [u32; 2],
    pub corners: [CornerUvs; 2],
}

impl OrientedFaces {
    pub fn new(topology: &UvTopology) -> OrientedFaces {
        Self::of(&topology.uvs, &topology.orientation)
    }

    /// Collects those of some faces.
    pub fn among(topology: &UvTopology, faces: impl IntoIterator<Item = u32>) -> OrientedFaces {
        Self::of_faces(&topology.uvs, &topology.orientation, faces)
    }

    /// Collects the faces with these corners, whose exact orientations are given.
    pub fn of(corners: &[CornerUvs], orientation: &[i8]) -> OrientedFaces {
        Self::of_faces(corners, orientation, 0..corners.len() as u32)
    }

    fn of_faces(
        corners: &[CornerUvs],
        orientation: &[i8],
        faces: impl IntoIterator<Item = u32>,
    ) -> OrientedFaces {
        let faces: Vec<u32> = (faces.into_iter())
            .filter(|&f| orientation[f as usize] != 0)
            .collect();
        let counter_clockwise = |&f: &u32| {
            let [a, b, c] = corners[f as usize];
            if orientation[f as usize] > 0 {
                [a, b, c]
            } else {
                [a, c, b]
            }
        };
        OrientedFaces {
            corners: faces.iter().map(counter_clockwise).collect(),
            faces,
        }
    }

    /// Returns the edges that no edge in the opposite direction cancels, by the bits of their ends and in a fixed order.
    pub fn outline(&self) -> Vec<[u64; 4]> {
        let edges = uncancelled(&self.corners).into_iter();
        edges
            .map(|[p, q]| {
                let ([a, b], [c, d]) = (key(p), key(q));
                [a, b, c, d]
            })
            .collect()
    }

    /// Visits every pair of faces whose interiors intersect, decided exactly by separating axes; if there is none, that
    /// is usually decided from the boundary alone.
    pub fn overlaps(&self, mut visit: impl FnMut(OverlappingPair)) -> BoxVisit {
        let boxes: Vec<Bounds> = self.corners.iter().map(|c| bounds_of(c)).collect();
        let tree = BoxTree::new(&boxes);
        if covers_once(&self.corners, &tree) {
            return BoxVisit::Complete;
        }
        tree.pairs(search_budget(boxes.len()), |i, j| {
            let corners = [self.corners[i as usize], self.corners[j as usize]];
            if interiors_intersect(&corners[0], &corners[1]) {
                let faces = [self.faces[i as usize], self.faces[j as usize]];
                visit(OverlappingPair { faces, corners });
            }
        })
    }
}

/// Returns whether two counter-clockwise triangles share interior points: no edge line of either has the other on its
/// outer side.
pub(crate) fn interiors_intersect(a: &CornerUvs, b: &CornerUvs) -> bool {
    !separates(a, b) && !separates(b, a)
}

/// Returns whether an edge line of `a` has all of `b` on its outer side or on itself.
fn separates(a: &CornerUvs, b: &CornerUvs) -> bool {
    (0..3).any(|e| {
        let (p, q) = (a[e], a[(e + 1) % 3]);
        b.iter().all(|&corner| orient2d_sign(p, q, corner) <= 0)
    })
}

// A fast test that triangles cover every point at most once, from their boundary alone.

/// Number of triangles below which comparing them with each other is as fast.
const FEW: usize = 64;
/// Most triangles looked at per triangle before the question is left open.
const MOST_LOOKS: usize = 64;

type Point = [u64; 2];
type OverlapEdge = [[f64; 2]; 2];

/// Returns whether no two of these counter-clockwise triangles have interior points in common; `false` also if that is
/// not known. `tree` holds their boxes.
fn covers_once(triangles: &[CornerUvs], tree: &BoxTree) -> bool {
    if triangles.len() < FEW {
        return false;
    }
    let Some(loops) = closed_lines(&uncancelled(triangles)) else {
        return false;
    };
    let vertices: Vec<Vec<[f64; 2]>> = (loops.iter())
        .map(|line| line.iter().map(|edge| edge[0]).collect())
        .collect();
    meeting_point(&vertices).is_none() && {
        let mut looks = MOST_LOOKS * triangles.len();
        loops
            .iter()
            .all(|line| is_free_outside(line, triangles, tree, &mut looks))
    }
}

/// Returns a key that is equal for equal points, with −0 = 0.
fn key(point: [f64; 2]) -> Point {
    point.map(|x| (x + 0.0).to_bits())
}

/// Returns the edges that no edge in the opposite direction cancels, in a fixed order.
fn uncancelled(triangles: &[CornerUvs]) -> Vec<OverlapEdge> {
    // By their ends, the smaller first, and whether they run from it.
    let mut edges: Vec<([Point; 2], bool, OverlapEdge)> = (triangles.iter())
        .flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]])
        .map(|edge| {
            let [p, q] = edge.map(key);
            if p < q {
                ([p, q], true, edge)
            } else {
                ([q, p], false, edge)
            }
        })
        .collect();
    edges.sort_unstable_by_key(|edge| (edge.0, edge.1));
    let mut left = Vec::new();
    for same in edges.chunk_by(|x, y| x.0 == y.0) {
        let back = same.partition_point(|edge| !edge.1);
        let (back, forward) = same.split_at(back);
        let n = back.len().min(forward.len());
        left.extend(back[n..].iter().chain(&forward[n..]).map(|edge| edge.2));
    }
    left
}

/// Chains edges to closed lines; returns `None` if several edges begin at one point.
fn closed_lines(edges: &[OverlapEdge]) -> Option<Vec<Vec<OverlapEdge>>> {
    let mut from: HashMap<Point, usize> = HashMap::with_capacity(edges.len());
    for (index, edge) in edges.iter().enumerate() {
        if from.insert(key(edge[0]), index).is_some() {
            return None;
        }
    }
    let mut is_taken = vec![false; edges.len()];
    let mut lines = Vec::new();
    for first in 0..edges.len() {
        let (mut line, mut at) = (Vec::new(), first);
        while !is_taken[at] {
            is_taken[at] = true;
            line.push(edges[at]);
            at = *from.get(&key(edges[at][1]))?;
        }
        if !line.is_empty() {
            lines.push(line);
        }
    }
    Some(lines)
}

/// Returns whether the right side of a line is found uncovered: at a midpoint of an edge that floating point can
/// represent, only the edge's own triangle may be.
fn is_free_outside(
    line: &[OverlapEdge],
    triangles: &[CornerUvs],
    tree: &BoxTree,
    looks: &mut usize,
) -> bool {
    let Some((edge, middle)) = line.iter().find_map(|edge| Some((edge, middle(edge)?))) else {
        return false;
    };
    let mut is_free = true;
    tree.meeting(&enlarged(bounds_of(&[middle])), |index| {
        let triangle = &triangles[index as usize];
        *looks = looks.saturating_sub(1);
        is_free &= *looks > 0 && (has_edge(triangle, edge) || !contains(triangle, middle));
    });
    is_free
}

/// Returns the midpoint of an edge if it is exact in both coordinates.
fn middle([a, b]: &OverlapEdge) -> Option<[f64; 2]> {
    let is_exact = (0..2).all(|k| is_sum(a[k], b[k]));
    is_exact.then(|| [0, 1].map(|k| f64::midpoint(a[k], b[k])))
}

/// Returns whether the sum of two numbers is exact.
fn is_sum(a: f64, b: f64) -> bool {
    let sum = a + b;
    let b_there = sum - a;
    (a - (sum - b_there)) + (b - b_there) == 0.0
}

fn has_edge([a, b, c]: &CornerUvs, edge: &OverlapEdge) -> bool {
    [[*a, *b], [*b, *c], [*c, *a]].contains(edge)
}

fn contains([a, b, c]: &CornerUvs, point: [f64; 2]) -> bool {
    [[a, b], [b, c], [c, a]]
        .into_iter()
        .all(|[p, q]| orient2d_sign(*p, *q, point) >= 0)
}

// Judgment of a deformed mesh of the plane.

/// Certificate of triangles in the plane: facts proven by exact predicates on their coordinates.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct PlanarCertificate {
    /// Triangles judged, all those below included.
    pub faces: usize,
    /// Triangles of negative area.
    pub inverted: usize,
    /// Triangles of exactly zero area.
    pub degenerate: usize,
    /// Triangles that cannot be judged: a coordinate is not finite or an index out of range.
    pub nonfinite: usize,
    /// Pairs of triangles whose interiors intersect.
    pub overlapping_pairs: u64,
    /// `true` if the search for pairs stopped at its limit, so that there may be more.
    pub overlap_truncated: bool,
}

impl PlanarCertificate {
    /// Returns whether every triangle has positive area: the map from a rest shape of positive triangles is locally
    /// injective.
    pub fn is_valid(&self) -> bool {
        self.inverted == 0 && self.degenerate == 0 && self.nonfinite == 0
    }

    /// Returns whether the map is bijective: also no two triangles overlap, whether its boundary was fixed or free.
    pub fn is_bijective(&self) -> bool {
        self.is_valid() && self.overlapping_pairs == 0 && !self.overlap_truncated
    }
}

/// Judges triangles that should be counter-clockwise and disjoint except for their edges and corners.
///
/// Unlike in [`certify`](super::certify), a mirrored mesh is not valid. All triangles are tested against each other by
/// a tree of boxes, so that slits and boundaries that touch need no special case: touching is no overlap.
pub fn certify_planar(vertices: &[[f64; 2]], triangles: &[[u32; 3]]) -> PlanarCertificate {
    let corners_of = |triangle: &[u32; 3]| -> Option<CornerUvs> {
        let corner = |k: usize| {
            let vertex = vertices.get(triangle[k] as usize)?;
            vertex.iter().all(|x| x.is_finite()).then_some(*vertex)
        };
        Some([corner(0)?, corner(1)?, corner(2)?])
    };
    let corners: Vec<CornerUvs> = triangles.iter().filter_map(corners_of).collect();
    let orientation: Vec<i8> = corners
        .iter()
        .map(|&[a, b, c]| orient2d_sign(a, b, c))
        .collect();
    let count = |sign: i8| orientation.iter().filter(|&&s| s == sign).count();
    let mut overlapping_pairs = 0;
    let visit = OrientedFaces::of(&corners, &orientation).overlaps(|_| overlapping_pairs += 1);
    PlanarCertificate {
        faces: triangles.len(),
        inverted: count(-1),
        degenerate: count(0),
        nonfinite: triangles.len() - corners.len(),
        overlapping_pairs,
        overlap_truncated: visit == BoxVisit::Truncated,
    }
}

// Pairs of triangles in space that pass through each other.

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
    found.truncated = visit == BoxVisit::Truncated;
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

// Exact intersection tests for polygons.

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
    found.or_else(|| (visit == BoxVisit::Truncated).then(|| segments[0][0]))
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

//! Pairs of faces whose interiors intersect in UV space.

use super::box_tree::{Bounds, BoxTree, Visit, bounds_of, enlarged, search_budget};
use super::simple::meeting_point;
use super::topology::UvTopology;
use crate::mesh::CornerUvs;
use std::collections::HashMap;
use unwrapd_method::numerics::predicates::orient2d_sign;

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

    /// Collects the faces with these corners, whose exact orientations are given.
    pub fn of(corners: &[CornerUvs], orientation: &[i8]) -> OrientedFaces {
        let oriented = || (0..corners.len()).filter(|&f| orientation[f] != 0);
        let counter_clockwise = |f: usize| {
            let [a, b, c] = corners[f];
            if orientation[f] > 0 {
                [a, b, c]
            } else {
                [a, c, b]
            }
        };
        OrientedFaces {
            faces: oriented().map(|f| f as u32).collect(),
            corners: oriented().map(counter_clockwise).collect(),
        }
    }

    /// Visits every pair of faces whose interiors intersect, decided exactly by separating axes; if there is none, that
    /// is usually decided from the boundary alone.
    pub fn overlaps(&self, mut visit: impl FnMut(OverlappingPair)) -> Visit {
        let boxes: Vec<Bounds> = self.corners.iter().map(|c| bounds_of(c)).collect();
        let tree = BoxTree::new(&boxes);
        if covers_once(&self.corners, &tree) {
            return Visit::Complete;
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

//! Pairs of faces whose interiors intersect in UV space.

use super::box_tree::{Bounds, BoxTree, Visit, bounds_of, search_budget};
use super::once::covers_once;
use super::topology::UvTopology;
use crate::mesh::CornerUvs;
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

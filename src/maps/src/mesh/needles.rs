//! Needles taken out of a surface.
//!
//! A needle looks like its longest edge, yet its normal and its angles mean nothing. Most are made by a vertex that lies on the edge
//! of a face. If only three faces meet there, they are replaced by the one that they divide:
//!
//! ```text
//! a ───c─── b       a ─────── b
//!   \  │  /     →     \     /
//!      d                 d
//! ```
//!
//! Otherwise the edge is flipped, which gives two faces in the plane of the neighbor:
//!
//! ```text
//!      c                 c
//! a ───┴─── b       a ───┬─── b
//!   \     /     →     \  │  /
//!      d                 d
//! ```
//!
//! The surface that is left has the shape without the needle, and is cut by that. The steps are undone in reverse order.

use super::edges::{CUT, next, origin, same_direction};
use super::surface::Surface;
use std::collections::HashSet;
use unwrapd_method::numerics::vec3::{area_vector, distance, norm};

/// Largest height of a needle over its longest side: such a face looks like an edge. Rounding moves its vertices by more than its
/// height on a texture of 8192 texels.
pub const NEEDLE: f64 = 1e-4;

/// A step that took a needle a, b, c out, c being the vertex across from its longest side. Halfedges are those of the needle's face and
/// of its neighbors before the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NeedleStep {
    /// The edge a b was flipped: from their first corners on, the faces were c, a, d and d, b, c afterward.
    Flip {
        /// Halfedge from a to b of the needle.
        needle: u32,
        /// Halfedge from b to a of the face b, a, d.
        other: u32,
    },
    /// The vertex c was removed: the needle's face was a, b, d from its first corner on afterward.
    Removal {
        /// Halfedge from a to b of the needle.
        needle: u32,
        /// Halfedge from c to b of the face c, b, d, and that from a to c of the face a, c, d. Both faces are gone.
        others: [u32; 2],
        /// Vertex c of the surface.
        vertex: u32,
    },
}

/// Returns whether a triangle is a needle.
pub fn looks_like_edge(p: [[f64; 3]; 3]) -> bool {
    let (_, longest) = longest_side(p);
    norm(area_vector(p[0], p[1], p[2])) < NEEDLE * longest * longest
}

/// Returns the corner at which the longest side begins, and its length.
pub fn longest_side(p: [[f64; 3]; 3]) -> (usize, f64) {
    let sides = [0, 1, 2].map(|k| (k, distance(p[k], p[(k + 1) % 3])));
    (sides.into_iter()).fold(
        (0, 0.0),
        |most, side| if side.1 > most.1 { side } else { most },
    )
}

impl Surface {
    /// Takes needles out. Returns the surface without them, for each of its triangles the one here that it stands for, and the steps
    /// in the order in which they were taken; `None` if there are none to take.
    ///
    /// Needles stay if two of their vertices nearly coincide, at seams, beside faces wound the other way, and where an edge that
    /// a flip would make exists already. Triangles keep their corners, but for those that a step made; defects are those of the
    /// surface with its needles. Linear without needles.
    pub fn without_needles(&self) -> Option<(Self, Vec<u32>, Vec<NeedleStep>)> {
        let mut left: Vec<u32> = (0..self.triangles.len() as u32)
            .filter(|&t| looks_like_edge(self.corners(t as usize)))
            .collect();
        if left.is_empty() {
            return None;
        }
        let edges = (0..3 * self.triangles.len() as u32).map(|h| ends(self, h));
        let mut work = Work {
            edges: edges.collect(),
            surface: self.clone(),
            is_gone: vec![false; self.triangles.len()],
            steps: Vec::new(),
        };
        // Only a removal restores the shape exactly, so edges are flipped where no vertex can be removed. Needles may lie on needles:
        // each step may make others possible.
        loop {
            while work.take_out(&mut left, Work::removal) {}
            if !work.take_out(&mut left, Work::flip) {
                break;
            }
        }
        if work.steps.is_empty() {
            return None;
        }
        let stay: Vec<u32> = (0..self.triangles.len() as u32)
            .filter(|&t| !work.is_gone[t as usize])
            .collect();
        let first: Vec<u32> = stay.iter().map(|t| 3 * t).collect();
        Some((work.surface.reordered(&first), stay, work.steps))
    }
}

/// A surface while needles are taken out.
struct Work {
    surface: Surface,
    /// Ends of all edges, in ascending order.
    edges: HashSet<[u32; 2]>,
    /// For each triangle whether it was replaced by another.
    is_gone: Vec<bool>,
    steps: Vec<NeedleStep>,
}

/// Returns the vertices of a halfedge's edge in ascending order.
fn ends(surface: &Surface, h: u32) -> [u32; 2] {
    let mut ends = [h, next(h)].map(|h| origin(&surface.triangles, h));
    ends.sort_unstable();
    ends
}

impl Work {
    /// Takes the steps that are found for needles, each at its longest halfedge, and leaves the needles that remain. Returns whether
    /// there was any.
    fn take_out(
        &mut self,
        needles: &mut Vec<u32>,
        find: fn(&Self, u32) -> Option<NeedleStep>,
    ) -> bool {
        let before = self.steps.len();
        needles.retain(|&needle| {
            if self.is_gone[needle as usize] {
                return false;
            }
            let (longest, _) = longest_side(self.surface.corners(needle as usize));
            let Some(step) = find(self, 3 * needle + longest as u32) else {
                return true;
            };
            self.take(step);
            self.steps.push(step);
            looks_like_edge(self.surface.corners(needle as usize))
        });
        self.steps.len() > before
    }

    fn origin(&self, h: u32) -> u32 {
        origin(&self.surface.triangles, h)
    }

    fn twin(&self, h: u32) -> u32 {
        self.surface.adjacency.twin[h as usize]
    }

    /// Returns whether a halfedge is glued to one that runs the other way.
    fn is_sound(&self, h: u32) -> bool {
        let t = self.twin(h);
        let triangles = &self.surface.triangles;
        t != CUT
            && !same_direction(triangles, h, t)
            && !self.surface.adjacency.is_twisted(triangles, h)
    }

    /// Returns the removal of the vertex across from the longest side, if only three faces meet there.
    fn removal(&self, h: u32) -> Option<NeedleStep> {
        let [bc, ca] = [next(h), next(next(h))];
        if !self.is_sound(bc) || !self.is_sound(ca) {
            return None;
        }
        let others = [bc, ca].map(|h| self.twin(h));
        let [of_b, of_a] = others;
        let dc = next(next(of_b));
        let is_fan = self.is_sound(dc) && self.twin(dc) == next(of_a);
        let is_triangle = self.origin(dc) != self.origin(h);
        (is_fan && is_triangle).then_some(NeedleStep::Removal {
            needle: h,
            others,
            vertex: self.origin(ca),
        })
    }

    /// Returns the flip of the longest side if both faces after it have a shape.
    fn flip(&self, h: u32) -> Option<NeedleStep> {
        if !self.is_sound(h) {
            return None;
        }
        let t = self.twin(h);
        let [a, b, c, d] = [h, t, next(next(h)), next(next(t))].map(|h| self.origin(h));
        if c == d || self.edges.contains(&[c.min(d), c.max(d)]) {
            return None;
        }
        let corners = |face: [u32; 3]| face.map(|v| self.surface.positions[v as usize]);
        let mut faces = [[c, a, d], [d, b, c]].into_iter();
        (faces.all(|face| !looks_like_edge(corners(face)))).then_some(NeedleStep::Flip {
            needle: h,
            other: t,
        })
    }

    fn take(&mut self, step: NeedleStep) {
        match step {
            NeedleStep::Flip {
                needle: h,
                other: t,
            } => {
                let [a, b, c, d] = [h, t, next(next(h)), next(next(t))].map(|h| self.origin(h));
                self.edges.remove(&ends(&self.surface, h));
                let sides = [next(next(h)), next(t), next(next(t)), next(h)];
                let [f, g] = [h / 3, t / 3];
                self.surface.triangles[f as usize] = [c, a, d];
                self.surface.triangles[g as usize] = [d, b, c];
                self.reglue(sides, [3 * f, 3 * f + 1, 3 * g, 3 * g + 1]);
                self.glue(3 * f + 2, 3 * g + 2);
                self.edges.insert(ends(&self.surface, 3 * f + 2));
            }
            NeedleStep::Removal {
                needle: h,
                others: [of_b, of_a],
                ..
            } => {
                let [a, b, d] = [h, next(h), next(next(of_b))].map(|h| self.origin(h));
                for side in [next(h), next(next(h)), next(of_a)] {
                    self.edges.remove(&ends(&self.surface, side));
                }
                let f = h / 3;
                let sides = [h, next(of_b), next(next(of_a))];
                for gone in [of_b, of_a] {
                    self.is_gone[gone as usize / 3] = true;
                }
                self.surface.triangles[f as usize] = [a, b, d];
                self.reglue(sides, [3 * f, 3 * f + 1, 3 * f + 2]);
            }
        }
    }

    /// Gives what is glued to some halfedges to others. Two of them may be glued to each other.
    fn reglue<const N: usize>(&mut self, from: [u32; N], to: [u32; N]) {
        let glued = from.map(|h| match self.twin(h) {
            CUT => CUT,
            t => (from.iter().position(|&old| old == t)).map_or(t, |k| to[k]),
        });
        for (h, t) in to.into_iter().zip(glued) {
            self.glue(h, t);
        }
    }

    fn glue(&mut self, h: u32, t: u32) {
        let twin = &mut self.surface.adjacency.twin;
        twin[h as usize] = t;
        if t != CUT {
            twin[t as usize] = h;
        }
    }
}

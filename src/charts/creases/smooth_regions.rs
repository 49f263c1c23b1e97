//! The creases of a surface, and the regions between them.

use crate::charts::regions::facets::{consistent_normals, crossings};
use crate::mesh::{CUT, Surface, UnionFind, next, origin};
use crate::numerics::vec3::{distance, dot, norm};

/// The cosine of the angle between the normals of two faces from which on their edge is a crease:
/// 30°. The side of a cylinder with 16 corners is smooth.
const CREASE_COS: f64 = 0.866;

/// A face has a normal if each of its heights is at least this part of the farthest coordinate:
/// rounding to `f32` tilts a lower one by half a degree or more.
const LEAST_HEIGHT: f64 = 1e-5;

/// The cosine of the angle within which two faces lie in one plane: 1°.
const PLANE_COS: f64 = 0.999_85;

/// The faces of a surface and how they meet.
pub struct Creases<'a> {
    surface: &'a Surface,
    across: Vec<u32>,
    /// Area vectors, and their lengths where the face has a normal.
    normals: Vec<[f64; 3]>,
    lengths: Vec<Option<f64>>,
}

impl<'a> Creases<'a> {
    /// Of all faces. O(n).
    pub fn new(surface: &'a Surface) -> Self {
        let coordinates = surface.positions.as_flattened().iter();
        let least = LEAST_HEIGHT * coordinates.fold(0.0, |most: f64, x| most.max(x.abs()));
        let normals = consistent_normals(surface);
        let length = |(face, normal): (usize, &[f64; 3])| {
            let [a, b, c] = surface.corners(face);
            let longest = distance(a, b).max(distance(b, c)).max(distance(c, a));
            let area = norm(*normal);
            (2.0 * area > least * longest).then_some(area)
        };
        Self {
            across: crossings(surface),
            lengths: normals.iter().enumerate().map(length).collect(),
            normals,
            surface,
        }
    }

    /// Labels the connected regions that creases part, and says how many there are.
    ///
    /// A face too thin for a normal belongs to the region across its longest edge, so that it
    /// bridges no crease. O(n α(n)).
    pub fn smooth_regions(&self) -> (Vec<u32>, usize) {
        let n_faces = self.lengths.len();
        let mut regions = UnionFind::new(n_faces);
        for (h, &t) in (0u32..).zip(&self.across) {
            if t != CUT && h < t && self.are_within(CREASE_COS, h / 3, t / 3) {
                regions.unite(h / 3, t / 3);
            }
        }
        for face in (0..n_faces as u32).filter(|&f| !self.has_normal(f)) {
            if let Some(other) = self.across_longest(face) {
                regions.unite(face, other);
            }
        }
        self.attach_thin_regions(&mut regions);
        regions.labels()
    }

    /// For each face whether one of its neighbors lies in its plane, as in any polygon of a
    /// modeler but a triangle.
    pub fn in_planes(&self) -> Vec<bool> {
        let is_beside = |h: u32| {
            let t = self.across[h as usize];
            t != CUT && self.are_within(PLANE_COS, h / 3, t / 3)
        };
        let n_faces = self.lengths.len() as u32;
        (0..n_faces)
            .map(|f| (3 * f..3 * f + 3).any(is_beside))
            .collect()
    }

    fn has_normal(&self, face: u32) -> bool {
        self.lengths[face as usize].is_some()
    }

    fn are_within(&self, cos: f64, a: u32, b: u32) -> bool {
        let [a, b] = [a, b].map(|face| face as usize);
        match (self.lengths[a], self.lengths[b]) {
            (Some(of_a), Some(of_b)) => dot(self.normals[a], self.normals[b]) > cos * of_a * of_b,
            _ => false,
        }
    }

    /// The face beyond the longest edge of a face that is not a border.
    fn across_longest(&self, face: u32) -> Option<u32> {
        let beyond = (3 * face..3 * face + 3).filter_map(|h| {
            let t = self.across[h as usize];
            (t != CUT).then(|| (self.length(h), t / 3))
        });
        let longest = beyond.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        longest.map(|(_, other)| other)
    }

    fn length(&self, h: u32) -> f64 {
        let [a, b] = [h, next(h)].map(|h| {
            let vertex = origin(&self.surface.triangles, h);
            self.surface.positions[vertex as usize]
        });
        distance(a, b)
    }

    /// Unites regions of thin faces only with the neighbor that they have most of an edge with.
    fn attach_thin_regions(&self, regions: &mut UnionFind) {
        let n_faces = self.lengths.len() as u32;
        let mut is_sound = vec![false; n_faces as usize];
        for face in (0..n_faces).filter(|&f| self.has_normal(f)) {
            is_sound[regions.find(face) as usize] = true;
        }
        let mut longest: Vec<Option<(f64, u32)>> = vec![None; n_faces as usize];
        for face in 0..n_faces {
            let own = regions.find(face);
            if is_sound[own as usize] {
                continue;
            }
            for h in 3 * face..3 * face + 3 {
                let t = self.across[h as usize];
                if t == CUT || regions.find(t / 3) == own {
                    continue;
                }
                let length = self.length(h);
                let best = &mut longest[own as usize];
                if best.is_none_or(|(most, _)| most < length) {
                    *best = Some((length, t / 3));
                }
            }
        }
        for (region, best) in (0..).zip(longest) {
            if let Some((_, other)) = best {
                regions.unite(region, other);
            }
        }
    }
}

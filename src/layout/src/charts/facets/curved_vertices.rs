//! Vertices at which a surface is bent two ways.

use super::faces::Faces;
use super::planar::Facets;
use std::f64::consts::TAU;
use unwrapd_maps::mesh::{CUT, next};
use unwrapd_method::numerics::vec3::{cross, dot, norm, sub};

/// The cosine of the angle between the normals of two facets from which on their edge is a crease:
/// 30°.
const CREASE_COS: f64 = 0.866;

/// The same at a [coarse](Around::is_coarse) vertex: 50°. A sphere or ring of eight sides turns by
/// 45°.
const COARSE_COS: f64 = 0.643;

/// The largest area of the facets at a coarse vertex, over the least, and the angle that is missing
/// there, at most: 40°, as at 18 vertices of a sphere. A chamfer turns by 45° too, but beside a larger
/// plane; and a body of few corners is a polyhedron.
const COARSE_AREAS: f64 = 8.0;
const COARSE_DEFECT: f64 = 0.7;

/// The angle that is missing at a vertex, or too much, from which on it cannot be laid flat: what
/// rounding to `f32` leaves of a flat one is less.
const LEAST_DEFECT: f64 = 1e-4;

/// A vertex cannot be laid flat if the normals of its facets enclose more than this area on the unit
/// sphere. The area must also exceed this share of the square of the largest turn. Faces can be so fine
/// that hardly an angle is missing at any vertex. Their facets still are a degree apart in all
/// directions; those of a cylinder are in one only, but for rounding.
const LEAST_IMAGE: f64 = 1e-5;
const LEAST_WIDTH: f64 = 0.1;

/// For each vertex whether it lies inside, three facets or more meet there without a crease, and
/// their angles or normals are not those of a surface that can be laid flat. O(n).
pub fn curved_vertices(
    faces: &Faces,
    facets: &Facets,
    vertex: &[u32],
    n_vertices: usize,
) -> Vec<bool> {
    let mut around = vec![Around::default(); n_vertices];
    for (h, &t) in (0u32..).zip(&*faces.across) {
        let facet = facets.of_face[h as usize / 3];
        let [here, there] = [h, next(h)].map(|h| vertex[h as usize] as usize);
        around[here].take_corner(facet, facets.areas[facet as usize], angle(faces, h));
        let cos = match facets.of_face.get(t as usize / 3) {
            None => -1.0,
            Some(&other) if other == facet => continue,
            Some(&other) => {
                let [a, b] = [facet, other].map(|facet| facets.normals[facet as usize]);
                around[here].take_turn(a, b);
                dot(a, b)
            }
        };
        for v in [here, there] {
            around[v].least_cos = around[v].least_cos.min(cos);
        }
    }
    around.iter().map(Around::is_curved).collect()
}

/// What lies around a vertex.
#[derive(Clone)]
struct Around {
    /// The angle that is missing to a full one.
    missing: f64,
    /// The first three facets.
    facets: [u32; 3],
    /// The least and the largest area of its facets.
    areas: [f64; 2],
    /// The least cosine of the angles between the normals across its edges; -1 on the boundary.
    least_cos: f64,
    /// The area vector of the polygon of the normals.
    image: [f64; 3],
}

impl Default for Around {
    fn default() -> Self {
        Self {
            missing: TAU,
            facets: [CUT; 3],
            areas: [f64::INFINITY, 0.0],
            least_cos: 1.0,
            image: [0.0; 3],
        }
    }
}

impl Around {
    /// Takes a corner of a face in a facet of some area.
    fn take_corner(&mut self, facet: u32, area: f64, angle: f64) {
        self.missing -= angle;
        self.areas = [self.areas[0].min(area), self.areas[1].max(area)];
        if !self.facets.contains(&facet)
            && let Some(free) = self.facets.iter_mut().find(|known| **known == CUT)
        {
            *free = facet;
        }
    }

    /// Takes an edge between facets with these normals.
    fn take_turn(&mut self, a: [f64; 3], b: [f64; 3]) {
        let turn = cross(a, b);
        self.image = [0, 1, 2].map(|k| self.image[k] + turn[k] / 2.0);
    }

    fn is_curved(&self) -> bool {
        let is_smooth =
            self.least_cos >= CREASE_COS || self.least_cos >= COARSE_COS && self.is_coarse();
        let is_bent = self.missing.abs() > LEAST_DEFECT || self.is_wide();
        is_smooth && self.facets[2] != CUT && is_bent
    }

    /// Whether the normals are those of facets that are bent towards each other in all directions.
    fn is_wide(&self) -> bool {
        let squared_turn = 2.0 * (1.0 - self.least_cos);
        norm(self.image) > LEAST_IMAGE.max(LEAST_WIDTH * squared_turn)
    }

    /// Whether facets of a size meet here, as where a round surface has few.
    fn is_coarse(&self) -> bool {
        let [least, largest] = self.areas;
        largest <= COARSE_AREAS * least && self.missing.abs() <= COARSE_DEFECT
    }
}

/// The angle of a face at the corner where a halfedge begins.
fn angle(faces: &Faces, h: u32) -> f64 {
    let at = |h: u32| faces.corners[h as usize / 3][h as usize % 3];
    let (to, from) = (sub(at(next(h)), at(h)), sub(at(next(next(h))), at(h)));
    norm(cross(to, from)).atan2(dot(to, from))
}

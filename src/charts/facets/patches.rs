//! Curved patches: facets that only sample a surface which is bent two ways.

use super::faces::Faces;
use super::planar::Facets;
use crate::mesh::{CUT, UnionFind, next};
use crate::numerics::vec3::{cross, dot, norm, sub};
use std::f64::consts::TAU;

/// The cosine of the angle between the normals of two facets from which on their edge is a crease:
/// 30°.
const CREASE_COS: f64 = 0.866;

/// The angle that is missing at a vertex, or too much, from which on it cannot be laid flat: what
/// rounding to `f32` leaves of a flat one is less.
const LEAST_DEFECT: f64 = 1e-4;

/// A facet of this share of the area of all is a plane, whatever it touches.
const PLANE: f64 = 0.01;

/// The longest edge of a strip, which is of a cylinder or of a fillet, is so many times its mean
/// width. It is also so many times the longest edge of the small facets that it meets at curved
/// vertices.
const STRIP: [f64; 2] = [6.0, 2.0];

/// Facets and patches of facets.
pub struct Patches {
    /// For each face the facet or patch that it is in.
    pub of_face: Vec<u32>,
    /// For each whether it is a patch of several facets.
    pub is_curved: Vec<bool>,
}

impl Patches {
    /// Facets around smooth vertices that cannot be laid flat are one patch; `vertex` numbers the
    /// vertices at the corners of faces. O(n).
    pub fn new(faces: &Faces, facets: &Facets, vertex: &[u32], n_vertices: usize) -> Self {
        let vertices = curved_vertices(faces, facets, vertex, n_vertices);
        let is_flat = flat_facets(faces, facets, vertex, &vertices);
        let mut sets = UnionFind::new(facets.len());
        let mut first = vec![CUT; n_vertices];
        for (corner, &v) in vertex.iter().enumerate() {
            let facet = facets.of_face[corner / 3];
            if !vertices[v as usize] || is_flat[facet as usize] {
                continue;
            }
            match first[v as usize] {
                CUT => first[v as usize] = facet,
                other => {
                    sets.unite(facet, other);
                }
            }
        }
        let (label, n) = sets.labels();
        let mut n_facets = vec![0; n];
        for &patch in &label {
            n_facets[patch as usize] += 1;
        }
        Self {
            of_face: (facets.of_face.iter())
                .map(|&facet| label[facet as usize])
                .collect(),
            is_curved: n_facets.iter().map(|&n| n > 1).collect(),
        }
    }
}

/// For each facet whether it stays a facet where it meets curved vertices: planes and strips do.
fn flat_facets(faces: &Faces, facets: &Facets, vertex: &[u32], is_curved: &[bool]) -> Vec<bool> {
    let least = PLANE * faces.areas.iter().sum::<f64>();
    let lengths = lengths(faces, facets);
    let [long, longer] = STRIP;
    let is_long = |f: usize| lengths[f] * lengths[f] > long * facets.areas[f];
    let corners = || {
        let of_face = |corner: usize| facets.of_face[corner / 3] as usize;
        let corners = vertex.iter().enumerate();
        (corners.map(move |(corner, &v)| (of_face(corner), v as usize)))
            .filter(|&(_, v)| is_curved[v])
    };
    // The longest edge of what is neither plane nor long at a vertex, then at a facet's vertices.
    let mut met = vec![0.0; is_curved.len()];
    for (facet, v) in corners().filter(|&(f, _)| facets.areas[f] < least && !is_long(f)) {
        met[v] = lengths[facet].max(met[v]);
    }
    let mut meets: Vec<f64> = vec![0.0; facets.len()];
    for (facet, v) in corners() {
        meets[facet] = meets[facet].max(met[v]);
    }
    (0..facets.len())
        .map(|f| facets.areas[f] >= least || is_long(f) && lengths[f] > longer * meets[f])
        .collect()
}

/// The longest edge of each facet's border.
fn lengths(faces: &Faces, facets: &Facets) -> Vec<f64> {
    let mut lengths = vec![0.0; facets.len()];
    for (h, &t) in (0u32..).zip(&*faces.across) {
        let facet = facets.of_face[h as usize / 3];
        if t == CUT || facets.of_face[t as usize / 3] != facet {
            let longest: &mut f64 = &mut lengths[facet as usize];
            *longest = longest.max(faces.length(h));
        }
    }
    lengths
}

/// For each vertex whether it lies inside, three facets or more meet there without a crease, and
/// their angles are not those of a plane.
fn curved_vertices(faces: &Faces, facets: &Facets, vertex: &[u32], n_vertices: usize) -> Vec<bool> {
    let mut missing = vec![TAU; n_vertices];
    let mut is_smooth = vec![true; n_vertices];
    let mut has_facets = vec![[CUT; 3]; n_vertices];
    for (h, &t) in (0u32..).zip(&*faces.across) {
        let v = vertex[h as usize] as usize;
        let facet = facets.of_face[h as usize / 3];
        missing[v] -= angle(faces, h);
        let known = &mut has_facets[v];
        if !known.contains(&facet)
            && let Some(free) = known.iter_mut().find(|known| **known == CUT)
        {
            *free = facet;
        }
        if t == CUT || is_crease(facets, facet, facets.of_face[t as usize / 3]) {
            is_smooth[v] = false;
            is_smooth[vertex[next(h) as usize] as usize] = false;
        }
    }
    (0..n_vertices)
        .map(|v| is_smooth[v] && has_facets[v][2] != CUT && missing[v].abs() > LEAST_DEFECT)
        .collect()
}

fn is_crease(facets: &Facets, a: u32, b: u32) -> bool {
    let [of_a, of_b] = [a, b].map(|facet| facets.normals[facet as usize]);
    a != b && dot(of_a, of_b) < CREASE_COS
}

/// The angle of a face at the corner where a halfedge begins.
fn angle(faces: &Faces, h: u32) -> f64 {
    let at = |h: u32| faces.corners[h as usize / 3][h as usize % 3];
    let (to, from) = (sub(at(next(h)), at(h)), sub(at(next(next(h))), at(h)));
    norm(cross(to, from)).atan2(dot(to, from))
}

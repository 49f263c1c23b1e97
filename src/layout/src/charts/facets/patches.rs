//! Curved patches: facets that only sample a surface which is bent two ways.

use super::curved_vertices::curved_vertices;
use super::faces::Faces;
use super::planar::Facets;
use unwrapd_maps::mesh::{CUT, UnionFind};

/// A facet of this share of the area of all is a plane if it has so many times the area of any other
/// that it meets at curved vertices, strips aside: the facets of a coarse sphere are as large as the
/// planes of a machine part, but alike.
const PLANE: f64 = 0.01;
const LARGER: f64 = 4.0;

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
    let corners: Vec<(usize, usize)> = (vertex.iter().enumerate())
        .filter(|&(_, &v)| is_curved[v as usize])
        .map(|(corner, &v)| (facets.of_face[corner / 3] as usize, v as usize))
        .collect();
    let small = |f: usize| facets.areas[f] < least && !is_long(f);
    let longest = largest_beside(&corners, &lengths, is_curved.len(), small);
    let areas = largest_beside(&corners, &facets.areas, is_curved.len(), |f| !is_long(f));
    (0..facets.len())
        .map(|f| {
            let is_plane = facets.areas[f] >= least.max(LARGER * areas[f]);
            is_plane || is_long(f) && lengths[f] > longer * longest[f]
        })
        .collect()
}

/// For each facet the largest value of another that counts and has a corner, a facet and a vertex, at
/// one of its vertices; zero if there is none.
fn largest_beside(
    corners: &[(usize, usize)],
    value: &[f64],
    n_vertices: usize,
    counts: impl Fn(usize) -> bool,
) -> Vec<f64> {
    // Of the two that are largest at a vertex one is another.
    let mut largest = vec![[(0.0, usize::MAX); 2]; n_vertices];
    for &(facet, v) in corners.iter().filter(|&&(facet, _)| counts(facet)) {
        let [first, second] = &mut largest[v];
        let here = (value[facet], facet);
        if facet != first.1 && here.0 > first.0 {
            (*first, *second) = (here, *first);
        } else if facet != first.1 && here.0 > second.0 {
            *second = here;
        }
    }
    let mut beside: Vec<f64> = vec![0.0; value.len()];
    for &(facet, v) in corners {
        let [first, second] = largest[v];
        let other = if first.1 == facet { second } else { first };
        beside[facet] = beside[facet].max(other.0);
    }
    beside
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

//! Where a seam is hidden, and where it would be seen at once.

use super::facets::faces::Faces;
use super::facets::patches::Patches;
use super::facets::planar::Facets;
use unwrapd_maps::cut::Sheet;
use unwrapd_maps::mesh::CUT;
use unwrapd_method::numerics::vec3::{area_vector, dot, unit};

/// What a seam on the sharpest crease costs, as a share of what it costs where the surface is bent
/// a little.
const SHARPEST: f64 = 0.4;

/// What a seam across a plane costs, as a multiple of that: there nothing asks for a cut.
const ACROSS_A_PLANE: f64 = 8.0;

/// The share of its border at which a plane must end: at a seam, or with a bend of 2° or more. A
/// round surface goes on in all directions.
const LEAST_END: f64 = 0.6;
const END_COS: f64 = 0.9994;

/// The least area of a plane of a surface that does not consist of planes, as a share of the whole:
/// on a round surface the faces within a degree have less.
const LEAST_PLANE: f64 = 0.01;

/// The share of the area from which on a surface consists of planes.
const OF_PLANES: f64 = 0.6;

/// What a seam costs along the edge of two planes that meet smoothly, as a multiple of that: a
/// cylinder stays whole.
const SMOOTH: f64 = 2.5;

/// The cosine of the angle between the normals of two planes up to which they meet smoothly: 30°. The
/// side of a cylinder with 16 corners is smooth.
const CREASE_COS: f64 = 0.866;

/// Whether a seam along an edge of some length that costs so much lies inside a plane.
pub fn lies_in_plane(cost: f64, length: f64) -> bool {
    cost > 0.5 * ACROSS_A_PLANE * length
}

/// What a seam costs for its length between faces whose normals have this cosine.
fn crease_cost(cos: f64) -> f64 {
    1.0 - (1.0 - SHARPEST) * (1.0 - cos).clamp(0.0, 1.0)
}

/// What a seam costs for its length between two planes whose normals have this cosine.
pub fn cost_between_planes(cos: f64) -> f64 {
    if cos > CREASE_COS {
        SMOOTH
    } else {
        crease_cost(cos)
    }
}

/// For each halfedge what a seam along it costs: its length, less where the surface is bent there,
/// and more inside a plane.
pub fn edge_costs(sheet: &Sheet) -> Vec<f64> {
    let faces = Faces::of_sheet(sheet);
    let facets = Facets::new(&faces);
    let patches = Patches::new(&faces, &facets, &sheet.vertex, sheet.positions.len());
    let is_plane = planes(&faces, &facets, &patches);
    let normals: Vec<[f64; 3]> = (faces.corners.iter())
        .map(|&[a, b, c]| unit(area_vector(a, b, c)))
        .collect();
    (0u32..)
        .zip(&sheet.twin)
        .map(|(h, &t)| {
            let length = faces.length(h);
            if t == CUT {
                return length;
            }
            let sides = [h, t].map(|h| h as usize / 3);
            let [here, there] = sides.map(|face| facets.of_face[face] as usize);
            if here == there && is_plane[here] {
                return ACROSS_A_PLANE * length;
            }
            if is_plane[here] && is_plane[there] {
                return length
                    * cost_between_planes(dot(facets.normals[here], facets.normals[there]));
            }
            length * crease_cost(dot(normals[sides[0]], normals[sides[1]]))
        })
        .collect()
}

/// For each facet whether it is a plane: it has more than one face, samples no curved patch and ends
/// where the surface is bent, and it is large or one of many.
fn planes(faces: &Faces, facets: &Facets, patches: &Patches) -> Vec<bool> {
    let mut is_curved = vec![false; facets.len()];
    for (&facet, &patch) in facets.of_face.iter().zip(&patches.of_face) {
        is_curved[facet as usize] = patches.is_curved[patch as usize];
    }
    let borders = borders(faces, facets);
    let is_one: Vec<bool> = (0..facets.len())
        .map(|facet| {
            let [border, ends] = borders[facet];
            facets.n_faces[facet] > 1 && !is_curved[facet] && ends >= LEAST_END * border
        })
        .collect();
    let area: f64 = facets.areas.iter().sum();
    let ones = (facets.areas.iter().zip(&is_one)).filter(|(_, is_one)| **is_one);
    let of_ones: f64 = ones.map(|(area, _)| area).sum();
    let least = if of_ones >= OF_PLANES * area {
        0.0
    } else {
        LEAST_PLANE * area
    };
    (is_one.iter().zip(&facets.areas))
        .map(|(&is_one, &area)| is_one && area >= least)
        .collect()
}

/// For each facet the length of its border, and of that where it ends.
fn borders(faces: &Faces, facets: &Facets) -> Vec<[f64; 2]> {
    let mut borders = vec![[0.0; 2]; facets.len()];
    for (h, &t) in (0u32..).zip(&*faces.across) {
        let here = facets.of_face[h as usize / 3];
        let is_end = match facets.of_face.get(t as usize / 3) {
            _ if t == CUT => true,
            Some(&there) if there == here => continue,
            Some(&there) => {
                let [a, b] = [here, there].map(|facet| facets.normals[facet as usize]);
                dot(a, b) < END_COS
            }
            None => true,
        };
        let [border, ends] = &mut borders[here as usize];
        let length = faces.length(h);
        *border += length;
        *ends += if is_end { length } else { 0.0 };
    }
    borders
}

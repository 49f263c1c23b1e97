//! Where a seam is hidden, and where it would be seen at once.

use crate::cut::Sheet;
use crate::mesh::{CUT, spread};
use crate::numerics::vec3::{area_vector, dot, norm};
use std::collections::BTreeSet;

/// What a seam on the sharpest crease costs, as a share of what it costs where the surface is bent
/// a little.
const SHARPEST: f64 = 0.4;

/// What a seam across a plane costs, as a multiple of that: there nothing asks for a cut.
const ACROSS_A_PLANE: f64 = 8.0;

/// The cosine of the angle within which the faces of a plane lie: 1°.
const PLANE_COS: f64 = 0.999_85;

/// The least area of a plane, as a share of the whole. On a round surface the faces within a degree
/// have less.
const LEAST_PLANE: f64 = 0.01;

/// The share of its border at which a plane must end: at a seam, or with a bend of 8° or more. A
/// round surface goes on in all directions.
const LEAST_END: f64 = 0.6;
const END_COS: f64 = 0.99;

/// For each halfedge what a seam along it costs: its length, less where the surface is bent there,
/// and more inside a plane.
pub fn edge_costs(sheet: &Sheet) -> Vec<f64> {
    let corner = |h: u32| sheet.positions[sheet.vertex[h as usize] as usize];
    let areas: Vec<[f64; 3]> = (0..sheet.triangles.len() as u32)
        .map(|f| area_vector(corner(3 * f), corner(3 * f + 1), corner(3 * f + 2)))
        .collect();
    let lengths: Vec<f64> = areas.iter().map(|&area| norm(area)).collect();
    let normals: Vec<[f64; 3]> = (areas.iter().zip(&lengths))
        .map(|(area, &length)| area.map(|x| if length > 0.0 { x / length } else { 0.0 }))
        .collect();
    let plane = planes(sheet, &normals, &lengths);
    (0u32..)
        .zip(&sheet.twin)
        .map(|(h, &t)| {
            let length = sheet.length(h);
            if t == CUT {
                return length;
            }
            let [here, there] = [h, t].map(|h| h as usize / 3);
            if plane[here] != CUT && plane[here] == plane[there] {
                return ACROSS_A_PLANE * length;
            }
            let bent = 1.0 - dot(normals[here], normals[there]);
            length * (1.0 - (1.0 - SHARPEST) * bent.clamp(0.0, 1.0))
        })
        .collect()
}

/// For each face the plane that it lies in, or [`CUT`] if that has little area. A plane grows from
/// a face over neighbors with its normal; a face without area belongs to the first that it meets.
fn planes(sheet: &Sheet, normals: &[[f64; 3]], areas: &[f64]) -> Vec<u32> {
    let mut plane = vec![CUT; normals.len()];
    let least = LEAST_PLANE * areas.iter().sum::<f64>();
    // The largest faces first: they have the surest normals.
    let mut seeds: Vec<u32> = (0..normals.len() as u32).collect();
    seeds.sort_by(|&a, &b| {
        let [of_a, of_b] = [a, b].map(|f| areas[f as usize]);
        of_b.total_cmp(&of_a).then(a.cmp(&b))
    });
    let mut is_seen = vec![false; normals.len()];
    for seed in seeds {
        if std::mem::replace(&mut is_seen[seed as usize], true) {
            continue;
        }
        let mut faces = vec![seed];
        spread(&sheet.twin, &mut faces, |_, t| {
            let face = t as usize / 3;
            let is_like =
                areas[face] == 0.0 || dot(normals[face], normals[seed as usize]) > PLANE_COS;
            is_like && !std::mem::replace(&mut is_seen[face], true)
        });
        let area: f64 = faces.iter().map(|&f| areas[f as usize]).sum();
        if area > least && ends(sheet, normals, &faces) {
            for &face in &faces {
                plane[face as usize] = seed;
            }
        }
    }
    plane
}

/// Whether most of the border of some faces is a seam or bent.
fn ends(sheet: &Sheet, normals: &[[f64; 3]], faces: &[u32]) -> bool {
    let is_inside: BTreeSet<u32> = faces.iter().copied().collect();
    let (mut border, mut ending) = (0.0, 0.0);
    for h in faces.iter().flat_map(|&f| 3 * f..3 * f + 3) {
        let t = sheet.twin[h as usize];
        if t != CUT && is_inside.contains(&(t / 3)) {
            continue;
        }
        let length = sheet.length(h);
        let is_end = t == CUT || dot(normals[h as usize / 3], normals[t as usize / 3]) < END_COS;
        border += length;
        ending += if is_end { length } else { 0.0 };
    }
    ending >= LEAST_END * border
}

//! Where a seam is hidden.

use crate::cut::Sheet;
use crate::mesh::CUT;
use crate::numerics::vec3::{area_vector, dot, unit};

/// What a seam on the sharpest crease costs, as a share of what it costs where the surface is flat.
const SHARPEST: f64 = 0.4;

/// For each halfedge what a seam along it costs: its length, less where the surface is bent there.
pub fn edge_costs(sheet: &Sheet) -> Vec<f64> {
    let corner = |h: u32| sheet.positions[sheet.vertex[h as usize] as usize];
    let normals: Vec<[f64; 3]> = (0..sheet.triangles.len() as u32)
        .map(|f| {
            unit(area_vector(
                corner(3 * f),
                corner(3 * f + 1),
                corner(3 * f + 2),
            ))
        })
        .collect();
    (0u32..)
        .zip(&sheet.twin)
        .map(|(h, &t)| {
            let bent = match t {
                CUT => 0.0,
                t => 1.0 - dot(normals[h as usize / 3], normals[t as usize / 3]),
            };
            sheet.length(h) * (1.0 - (1.0 - SHARPEST) * bent.clamp(0.0, 1.0))
        })
        .collect()
}

//! Planes that are cut, or not.

use crate::cut::Sheet;
use crate::numerics::vec2::doubled_area;

/// The share of a chart that lies in planes from which on these stay whole.
const LEAST_FLAT: f64 = 0.5;

/// What may be done to planes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Planes {
    /// They stay whole.
    Whole,
    /// They may be cut, at a price.
    Cut,
}

impl Planes {
    /// Those of a map with vertices at `uv` stay whole if they are most of it and the page is not too small for it; `cost` is that
    /// of a seam along each halfedge, more than its length where it crosses a plane.
    pub fn of(sheet: &Sheet, uv: &[[f64; 2]], cost: &[f64], is_too_large: bool) -> Self {
        if !is_too_large && flat_share(sheet, uv, cost) > LEAST_FLAT {
            Self::Whole
        } else {
            Self::Cut
        }
    }
}

/// The share of a map's area that lies in planes.
fn flat_share(sheet: &Sheet, uv: &[[f64; 2]], cost: &[f64]) -> f64 {
    let (mut flat, mut all) = (0.0, 0.0);
    for f in 0..sheet.triangles.len() as u32 {
        let halfedges = 3 * f..3 * f + 3;
        let corner = |h: u32| uv[sheet.vertex[h as usize] as usize];
        let area = doubled_area(corner(3 * f), corner(3 * f + 1), corner(3 * f + 2));
        let is_flat = |h: u32| cost[h as usize] > sheet.length(h);
        flat += if halfedges.into_iter().any(is_flat) {
            area
        } else {
            0.0
        };
        all += area;
    }
    flat / all
}

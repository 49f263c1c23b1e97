//! Planes that are cut, or not.

use crate::charts::crease::lies_in_plane;
use unwrapd_maps::cut::Sheet;
use unwrapd_method::numerics::vec2::doubled_area;

/// The share of a chart that lies in planes from which on these stay whole.
const LEAST_FLAT: f64 = 0.5;

/// The share of its convex hull that a chart fills from which on the cylinders in it stay whole, too.
const COMPACT: f64 = 0.85;

/// What may be done to planes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Planes {
    /// They stay whole, and so do cylinders: planes that meet smoothly.
    WholeWithCylinders,
    /// They stay whole.
    Whole,
    /// They may be cut, at a price.
    Cut,
}

impl Planes {
    /// Those of a map with vertices at `uv` and a convex hull of this area stay whole if they are most of it; `cost` is that of a
    /// seam along each halfedge, more than its length where it crosses a plane.
    pub fn of(sheet: &Sheet, uv: &[[f64; 2]], cost: &[f64], hull: f64) -> Self {
        let (flat, all) = flat_and_all(sheet, uv, cost);
        if flat <= LEAST_FLAT * all {
            Self::Cut
        } else if all < COMPACT * hull {
            Self::Whole
        } else {
            Self::WholeWithCylinders
        }
    }

    /// Whether no seam may run along an edge of this length for which it costs so much.
    pub fn keep(self, cost: f64, length: f64) -> bool {
        match self {
            Self::WholeWithCylinders => cost > length,
            Self::Whole => lies_in_plane(cost, length),
            Self::Cut => false,
        }
    }
}

/// The area of a map that lies in planes, and all of it.
fn flat_and_all(sheet: &Sheet, uv: &[[f64; 2]], cost: &[f64]) -> (f64, f64) {
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
    (flat / 2.0, all / 2.0)
}

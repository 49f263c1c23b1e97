//! A map in coordinates of its own.

use unwrapd_maps::cut::Sheet;
use unwrapd_maps::mesh::CUT;
use unwrapd_maps::plane::Straightness;
use unwrapd_method::numerics::vec2::{doubled_area, sub};

/// The vertices of a sheet along the axes of its map and from its center. So a map that is turned or moved is cut in the same
/// places, but for quarter turns.
///
/// The axes are those along which most of the outline runs, or else the principal axes of the area.
pub(super) fn along_own_axes(sheet: &Sheet, uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let edges = (0u32..).zip(&sheet.twin).filter(|(_, t)| **t == CUT);
    let outline: Vec<_> = edges
        .map(|(h, _)| sheet.ends(h).map(|v| uv[v as usize]))
        .collect();
    let (center, principal) = center_and_axis(sheet, uv);
    let [c, s] = match Straightness::of(&outline) {
        Straightness::Upright(axis) | Straightness::Leaning(axis) => axis,
        Straightness::Round => principal,
    };
    let turned = |p: &[f64; 2]| {
        let [x, y] = sub(*p, center);
        [c * x + s * y, c * y - s * x]
    };
    uv.iter().map(turned).collect()
}

/// The center of the area, and the principal axis of its triangles' centers.
fn center_and_axis(sheet: &Sheet, uv: &[[f64; 2]]) -> ([f64; 2], [f64; 2]) {
    let of_triangle = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| uv[v as usize]);
        let middle = [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0);
        (doubled_area(a, b, c), middle)
    };
    let triangles = || sheet.vertex.as_chunks().0.iter().map(of_triangle);
    let (mut area, mut first) = (0.0, [0.0; 2]);
    for (weight, p) in triangles() {
        area += weight;
        first = [0, 1].map(|k| first[k] + weight * p[k]);
    }
    let center = first.map(|x| x / f64::max(area, f64::MIN_POSITIVE));
    let (mut difference, mut product) = (0.0, 0.0);
    for (weight, p) in triangles() {
        let [x, y] = sub(p, center);
        difference += weight * (x * x - y * y);
        product += weight * 2.0 * x * y;
    }
    let (sin, cos) = (product.atan2(difference) / 2.0).sin_cos();
    (center, [cos, sin])
}

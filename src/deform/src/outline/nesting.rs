//! Nesting of disjoint polygons.

use unwrapd_maps::plane::doubled_polygon_area;
use unwrapd_method::numerics::bounds::{Bounds, bounds_of};

/// Winding numbers of disjoint closed polygons around points that lie on no polygon.
pub(super) struct Windings<'a> {
    loops: &'a [Vec<[f64; 2]>],
    boxes: Vec<Bounds>,
}

impl<'a> Windings<'a> {
    pub fn new(loops: &'a [Vec<[f64; 2]>]) -> Self {
        let boxes = loops.iter().map(|l| bounds_of(l)).collect();
        Self { loops, boxes }
    }

    /// Returns the winding number of polygon `of` around a point that is not on it.
    pub fn around(&self, point: [f64; 2], of: usize) -> i32 {
        let [low, high] = self.boxes[of];
        if (0..2).any(|k| point[k] < low[k] || high[k] < point[k]) {
            return 0;
        }
        let vertices = &self.loops[of];
        (0..vertices.len())
            .map(|k| crossing(point, vertices[k], vertices[(k + 1) % vertices.len()]))
            .sum()
    }
}

/// Returns +1 where an edge passes upwards to the right of the point, −1 downwards; half open, so that a vertex counts
/// once.
fn crossing(point: [f64; 2], a: [f64; 2], b: [f64; 2]) -> i32 {
    use unwrapd_method::numerics::predicates::orient2d_sign;
    match (a[1] <= point[1], b[1] <= point[1]) {
        (true, false) => i32::from(orient2d_sign(a, b, point) > 0),
        (false, true) => -i32::from(orient2d_sign(a, b, point) < 0),
        _ => 0,
    }
}

/// Turns disjoint polygons so that the region inside an odd number of them lies on their left.
pub(super) fn orient(loops: &mut [Vec<[f64; 2]>]) {
    let windings = Windings::new(loops);
    let is_hole: Vec<bool> = (0..loops.len())
        .map(|k| {
            let around = (0..loops.len()).filter(|&other| other != k);
            let n: i32 = around.map(|o| windings.around(loops[k][0], o).abs()).sum();
            n % 2 == 1
        })
        .collect();
    for (vertices, is_hole) in loops.iter_mut().zip(is_hole) {
        if (doubled_polygon_area(vertices) < 0.0) != is_hole {
            vertices.reverse();
        }
    }
}

//! Axis-aligned boxes of plane and space.

/// Smallest and greatest coordinates of a box.
pub type Bounds<const D: usize = 2> = [[f64; D]; 2];

/// Returns the box of some points; without points, a box that encloses and meets nothing.
pub fn bounds_of<const D: usize>(points: &[[f64; D]]) -> Bounds<D> {
    let mut bounds = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
    for point in points {
        for axis in 0..D {
            bounds[0][axis] = bounds[0][axis].min(point[axis]);
            bounds[1][axis] = bounds[1][axis].max(point[axis]);
        }
    }
    bounds
}

/// Returns the box with its sides moved out by `margin`.
pub fn widened<const D: usize>([low, high]: Bounds<D>, margin: f64) -> Bounds<D> {
    [low.map(|x| x - margin), high.map(|x| x + margin)]
}

/// Returns whether two closed boxes have a common point.
pub fn touch<const D: usize>(a: &Bounds<D>, b: &Bounds<D>) -> bool {
    (0..D).all(|axis| a[0][axis] <= b[1][axis] && b[0][axis] <= a[1][axis])
}

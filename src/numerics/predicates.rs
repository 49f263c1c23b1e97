//! Exact answers to geometric yes-or-no questions.
//!
//! Based on: Shewchuk 1997, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates.

use robust::{Coord, orient2d};

/// The sign of the area of the triangle `a`, `b`, `c`: 1 counter-clockwise, −1 clockwise, 0 exactly collinear.
///
/// Exact for all coordinates between 1e-140 and 1e150 in magnitude (or 0): there no product of two differences
/// underflows or overflows. A coordinate that is not finite gives 0: such a triangle is not positive.
pub fn orient2d_sign(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> i8 {
    let coord = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
    let area = orient2d(coord(a), coord(b), coord(c));
    i8::from(area > 0.0) - i8::from(area < 0.0)
}

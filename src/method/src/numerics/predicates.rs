//! Exact geometric predicates.
//!
//! Based on: Shewchuk 1997, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates.

use robust::{Coord, Coord3D, orient2d, orient3d};

/// Returns the sign of the area of the triangle `a`, `b`, `c`: 1 counter-clockwise, −1 clockwise, 0 exactly collinear.
///
/// Exact for all coordinates between 1e-140 and 1e150 in magnitude (or 0): there no product of two differences
/// underflows or overflows. A coordinate that is not finite gives 0: such a triangle is not positive.
pub fn orient2d_sign(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> i8 {
    let coord = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
    let area = orient2d(coord(a), coord(b), coord(c));
    i8::from(area > 0.0) - i8::from(area < 0.0)
}

/// Returns the sign of det[b−a, c−a, d−a]: 1 when `a`, `b`, `c` turn counter-clockwise seen from `d`, −1 when
/// clockwise, 0 when the four are exactly coplanar.
///
/// Exact while no product of three differences underflows or overflows: coordinates between 1e-90 and 1e90 in magnitude
/// (or 0). A coordinate that is not finite gives 0.
pub fn orient3d_sign(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> i8 {
    let coord = |p: [f64; 3]| Coord3D {
        x: p[0],
        y: p[1],
        z: p[2],
    };
    // robust's sign is that of det[a−d, b−d, c−d], the opposite.
    let volume = orient3d(coord(a), coord(b), coord(c), coord(d));
    i8::from(volume < 0.0) - i8::from(volume > 0.0)
}

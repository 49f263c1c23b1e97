//! Exact orientation.

use unwrapd::numerics::predicates::orient2d_sign;
use unwrapd::numerics::vec2::doubled_area;

#[test]
fn orientation_is_exact_where_rounding_is_not() {
    // Shewchuk's example: points within a few last places of the line y = x, where the rounded determinant errs.
    let (b, c) = ([12.0, 12.0], [24.0, 24.0]);
    let last_place = f64::EPSILON / 2.0;
    let mut rounded_wrong = 0;
    for i in 0..16_i32 {
        for j in 0..16_i32 {
            let a = [
                0.5 + f64::from(i) * last_place,
                0.5 + f64::from(j) * last_place,
            ];
            let expected = (j - i).signum();
            assert_eq!(i32::from(orient2d_sign(b, c, a)), expected);
            rounded_wrong += i32::from((doubled_area(a, b, c) > 0.0) != (expected > 0));
        }
    }
    assert!(rounded_wrong > 0, "the example no longer shows rounding");
    assert_eq!(orient2d_sign([f64::NAN, 0.0], b, [1.0, 2.0]), 0);
}

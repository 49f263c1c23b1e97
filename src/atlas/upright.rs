//! Charts that have an upright position.

/// Widths of the classes into which directions are sorted, over a quarter turn.
const CLASSES: usize = 180;

/// The share of an outline that must run along two perpendicular directions.
const LEAST_SHARE: f64 = 0.5;

/// The unit vector along which most of an outline runs, itself or at a right angle; none if that is
/// less than half of its length. A rectangle has one, a disc has none.
pub(super) fn upright_axis(edges: &[[[f64; 2]; 2]]) -> Option<[f64; 2]> {
    let mut classes = vec![[0.0; 3]; CLASSES];
    let mut perimeter = 0.0;
    for [p, q] in edges {
        let [x, y] = [q[0] - p[0], q[1] - p[1]];
        let length = x.hypot(y);
        if !length.is_normal() {
            continue;
        }
        // Four times the angle is the same for all four directions of a quarter turn.
        let [c, s] = squared(squared([x / length, y / length]));
        let turn = s.atan2(c).rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU;
        let class = &mut classes[(turn * CLASSES as f64) as usize % CLASSES];
        for (sum, x) in class.iter_mut().zip([length, length * c, length * s]) {
            *sum += x;
        }
        perimeter += length;
    }
    // A direction may lie at the border of two classes.
    let pair = |i: usize| {
        let next = classes[(i + 1) % CLASSES];
        [0, 1, 2].map(|k| classes[i][k] + next[k])
    };
    let most = (0..CLASSES)
        .map(pair)
        .fold([0.0; 3], |best, of| if of[0] > best[0] { of } else { best });
    let [length, c, s] = most;
    if length < LEAST_SHARE * perimeter || length == 0.0 {
        return None;
    }
    let (sin, cos) = (s.atan2(c) / 4.0).sin_cos();
    Some([cos, sin])
}

/// The unit vector at twice the angle.
fn squared([c, s]: [f64; 2]) -> [f64; 2] {
    [c * c - s * s, 2.0 * c * s]
}

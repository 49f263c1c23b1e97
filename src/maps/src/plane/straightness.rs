//! Axes of outlines.

/// Number of classes into which directions are sorted, over a quarter turn: half a degree each.
const CLASSES: usize = 180;

/// Shares of an outline along two perpendicular directions: from the first on a chart must be upright, from the second
/// on it is if the atlas stays about as full.
const UPRIGHT: f64 = 0.5;
const LEANING: f64 = 0.25;

/// Axes of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Straightness {
    /// Most of the outline runs along this unit vector or at a right angle to it, as for a rectangle.
    Upright([f64; 2]),
    /// A good part of the outline does: a third for a hexagon.
    Leaning([f64; 2]),
    /// The outline has no axes, like a disc.
    Round,
}

impl Straightness {
    /// Finds the axes of an outline that consists of these edges.
    pub fn of(edges: &[[[f64; 2]; 2]]) -> Self {
        match main_axis(edges) {
            Some((axis, share)) if share >= UPRIGHT => Self::Upright(axis),
            Some((axis, share)) if share >= LEANING => Self::Leaning(axis),
            _ => Self::Round,
        }
    }
}

/// Returns the unit vector along which, or at a right angle to which, most of an outline runs, and that share.
fn main_axis(edges: &[[[f64; 2]; 2]]) -> Option<([f64; 2], f64)> {
    let mut classes = vec![[0.0; 3]; CLASSES];
    // Add the length of each edge to its class, together with its direction.
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
    // Take the longest pair of neighboring classes; its mean direction is the axis.
    let most = (0..CLASSES)
        .map(pair)
        .fold([0.0; 3], |best, of| if of[0] > best[0] { of } else { best });
    let [length, c, s] = most;
    let (sin, cos) = (s.atan2(c) / 4.0).sin_cos();
    (length > 0.0).then_some(([cos, sin], length / perimeter))
}

/// Returns the unit vector at twice the angle.
fn squared([c, s]: [f64; 2]) -> [f64; 2] {
    [c * c - s * s, 2.0 * c * s]
}

//! Distances and intersections of segments.

use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::numerics::vec2::{dot, sub, way_from};

/// Ends of a straight line.
pub type Segment = [[f64; 2]; 2];

/// Returns the distance of two segments, rounded; 0 if they cross.
pub fn segment_distance(s: Segment, t: Segment) -> f64 {
    if cross(s, t) {
        return 0.0;
    }
    let of_ends = |s: Segment, t: Segment| {
        let [p, q] = s.map(|end| way_from(t, end));
        p[0].hypot(p[1]).min(q[0].hypot(q[1]))
    };
    of_ends(s, t).min(of_ends(t, s))
}

/// Returns whether each segment has the ends of the other on its two sides, exactly.
fn cross(s: Segment, t: Segment) -> bool {
    let parts = |s: Segment, t: Segment| {
        orient2d_sign(s[0], s[1], t[0]) * orient2d_sign(s[0], s[1], t[1]) < 0
    };
    parts(s, t) && parts(t, s)
}

/// Returns whether two segments have a common point, exactly.
pub(super) fn meet(s: Segment, t: Segment) -> bool {
    let ends = |s: Segment, t: Segment| s.iter().any(|&end| contains(t, end));
    cross(s, t) || ends(s, t) || ends(t, s)
}

/// Returns whether a point lies on a segment, including its ends, exactly.
fn contains([a, b]: Segment, p: [f64; 2]) -> bool {
    let is_between = |k: usize| (a[k].min(b[k])..=a[k].max(b[k])).contains(&p[k]);
    is_between(0) && is_between(1) && orient2d_sign(a, b, p) == 0
}

/// Returns whether the second of two segments, which begins where the first ends, runs back over it.
pub(super) fn turns_back(s: Segment, t: Segment) -> bool {
    orient2d_sign(s[0], s[1], t[1]) == 0 && dot(sub(s[1], s[0]), sub(t[1], t[0])) < 0.0
}

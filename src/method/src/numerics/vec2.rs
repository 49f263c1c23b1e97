//! Vectors of the plane as plain `[f64; 2]`.

/// Returns a − b.
pub fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Returns a·b.
pub fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Returns the third coordinate of a × b: twice the signed area of the triangle 0, a, b.
pub fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Returns twice the signed area of the triangle a, b, c, positive if counter-clockwise; rounded, see
/// [`orient2d_sign`](super::predicates::orient2d_sign) for its exact sign.
pub fn doubled_area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    cross(sub(b, a), sub(c, a))
}

/// Returns the vector to a point from the nearest point of a segment, which may have length zero.
pub fn way_from([a, b]: [[f64; 2]; 2], p: [f64; 2]) -> [f64; 2] {
    let (along, to) = (sub(b, a), sub(p, a));
    let share = dot(to, along) / dot(along, along).max(f64::MIN_POSITIVE);
    let share = share.clamp(0.0, 1.0);
    [0, 1].map(|k| to[k] - share * along[k])
}

/// Returns the square of the distance of a point from a segment.
pub fn squared_distance(p: [f64; 2], segment: [[f64; 2]; 2]) -> f64 {
    let way = way_from(segment, p);
    dot(way, way)
}

//! Simplification of polygons within a tolerance.

use unwrapd_method::numerics::vec2::{dot, squared_distance, sub};

/// Returns a closed polygon through some of the vertices; every other vertex is within `tolerance` of the edge that
/// replaces it (Douglas, Peucker 1973).
///
/// The result may cross itself where the polygon passes itself within the tolerance. Begins at the smallest vertex and
/// its most distant one, which are likely to be corners of the shape.
pub(super) fn simplified(vertices: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let n = vertices.len();
    let Some(first) = (0..n).min_by(|&a, &b| {
        let order = vertices[a][0].total_cmp(&vertices[b][0]);
        order.then(vertices[a][1].total_cmp(&vertices[b][1]))
    }) else {
        return Vec::new();
    };
    let at = |k: usize| vertices[(first + k) % n];
    let far = (0..n)
        .max_by(|&a, &b| distance_squared(at(a), at(0)).total_cmp(&distance_squared(at(b), at(0))));
    let mut kept = vec![false; n + 1];
    kept[0] = true;
    let mut open = Vec::new();
    if let Some(far) = far.filter(|&far| far > 0) {
        kept[far] = true;
        open.extend([(0, far), (far, n)]);
    }
    while let Some((from, to)) = open.pop() {
        let segment = [at(from), at(to)];
        let worst = (from + 1..to)
            .map(|k| (squared_distance(at(k), segment), k))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((distance, k)) = worst
            && distance > tolerance * tolerance
        {
            kept[k] = true;
            open.extend([(from, k), (k, to)]);
        }
    }
    (0..n).filter(|&k| kept[k]).map(at).collect()
}

fn distance_squared(p: [f64; 2], q: [f64; 2]) -> f64 {
    let d = sub(p, q);
    dot(d, d)
}

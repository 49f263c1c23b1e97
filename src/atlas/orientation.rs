//! The angle at which a chart fills its bounding rectangle best.

/// The chart rotated so that the bounding rectangle of smallest area is axis-aligned and not higher
/// than wide, with its lower left corner at the origin.
pub(super) fn turned(uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let [c, s] = smallest_rectangle(&convex_hull(uv));
    let mut out: Vec<[f64; 2]> = uv
        .iter()
        .map(|&[x, y]| [c * x + s * y, c * y - s * x])
        .collect();
    let lowest = [0, 1].map(|k| out.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min));
    for p in &mut out {
        *p = [p[0] - lowest[0], p[1] - lowest[1]];
    }
    out
}

/// Direction of the side of the smallest enclosing rectangle (one side lies on a hull edge).
fn smallest_rectangle(hull: &[[f64; 2]]) -> [f64; 2] {
    let mut best = ([1.0, 0.0], f64::INFINITY);
    for i in 0..hull.len() {
        let (p, q) = (hull[i], hull[(i + 1) % hull.len()]);
        let d = [q[0] - p[0], q[1] - p[1]];
        let length = d[0].hypot(d[1]);
        if length.is_normal() {
            let d = [d[0] / length, d[1] / length];
            let [width, height] = extent(hull, d);
            if width * height < best.1 {
                let along = if width < height { [-d[1], d[0]] } else { d };
                best = (along, width * height);
            }
        }
    }
    best.0
}

fn extent(hull: &[[f64; 2]], [c, s]: [f64; 2]) -> [f64; 2] {
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    for &[x, y] in hull {
        for (k, value) in [c * x + s * y, c * y - s * x].into_iter().enumerate() {
            low[k] = low[k].min(value);
            high[k] = high[k].max(value);
        }
    }
    [high[0] - low[0], high[1] - low[1]]
}

/// Andrew's monotone chain; counter-clockwise.
fn convex_hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    let mut hull: Vec<[f64; 2]> = Vec::new();
    for pass in 0..2 {
        let start = hull.len();
        for &p in &sorted {
            while hull.len() >= start + 2
                && !left_turn(hull[hull.len() - 2], hull[hull.len() - 1], p)
            {
                hull.pop();
            }
            hull.push(p);
        }
        hull.pop();
        if pass == 0 {
            sorted.reverse();
        }
    }
    hull
}

fn left_turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> bool {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
}

//! The angle at which a chart is packed.

/// What a good angle makes small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bounds {
    /// The area of the bounding rectangle: many charts share the square.
    Rectangle,
    /// The side of the bounding square: one chart has it to itself.
    Square,
    /// Nothing: the chart stays as it is.
    Given,
}

/// Hull edges tried at most; the hull of a round chart is thinned to this many.
const HULL_EDGES: usize = 512;
/// Angles tried for the bounding square, over a quarter turn.
const SQUARE_ANGLES: u32 = 360;

/// Unit vector that becomes the horizontal axis.
pub(super) fn direction(uv: &[[f64; 2]], bounds: Bounds) -> [f64; 2] {
    match bounds {
        Bounds::Rectangle => smallest_rectangle(&convex_hull(uv)),
        Bounds::Square => smallest_square(&convex_hull(uv)),
        Bounds::Given => [1.0, 0.0],
    }
}

/// One side of the smallest enclosing rectangle lies on a hull edge.
fn smallest_rectangle(hull: &[[f64; 2]]) -> [f64; 2] {
    let mut best = ([1.0, 0.0], f64::INFINITY);
    for i in (0..hull.len()).step_by(hull.len().div_ceil(HULL_EDGES).max(1)) {
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

fn smallest_square(hull: &[[f64; 2]]) -> [f64; 2] {
    let mut best = ([1.0, 0.0], f64::INFINITY);
    for step in 0..SQUARE_ANGLES {
        let angle = std::f64::consts::FRAC_PI_2 * f64::from(step) / f64::from(SQUARE_ANGLES);
        let d = [angle.cos(), angle.sin()];
        let side = extent(hull, d).into_iter().fold(0.0, f64::max);
        if side < best.1 {
            best = (d, side);
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

/// Andrew's monotone chain, counter-clockwise.
fn convex_hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    let mut hull: Vec<[f64; 2]> = Vec::new();
    for _ in 0..2 {
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
        sorted.reverse();
    }
    hull
}

fn left_turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> bool {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
}

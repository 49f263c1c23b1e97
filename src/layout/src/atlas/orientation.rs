//! The angle at which a chart is packed.

/// What a good angle makes small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bounds {
    /// The area of the bounding rectangle: many charts share the square.
    Rectangle,
    /// The longer side of the bounding page, whose sides along u and v are that halved so often: one chart has it to itself.
    Page([u32; 2]),
}

/// Hull edges tried at most; the hull of a round chart is thinned to this many.
const HULL_EDGES: usize = 512;
/// Angles tried for the bounding page, over a quarter turn, each upright and on its side.
const PAGE_ANGLES: u32 = 360;

/// Unit vector that becomes the horizontal axis.
pub(super) fn direction(hull: &[[f64; 2]], bounds: Bounds) -> [f64; 2] {
    match bounds {
        Bounds::Rectangle => smallest_rectangle(hull),
        Bounds::Page(halvings) => smallest_page(hull, halvings).0,
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

/// The direction for the smallest page that encloses a hull, and its longer side.
pub(super) fn smallest_page(hull: &[[f64; 2]], halvings: [u32; 2]) -> ([f64; 2], f64) {
    let [u, v] = halvings.map(|times| f64::from(1_u32 << times));
    let mut best = ([1.0, 0.0], f64::INFINITY);
    for step in 0..PAGE_ANGLES {
        let angle = std::f64::consts::FRAC_PI_2 * f64::from(step) / f64::from(PAGE_ANGLES);
        let d = [angle.cos(), angle.sin()];
        let [width, height] = extent(hull, d);
        for (d, side) in [
            (d, (u * width).max(v * height)),
            ([-d[1], d[0]], (u * height).max(v * width)),
        ] {
            if side < best.1 {
                best = (d, side);
            }
        }
    }
    best
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

//! A chart as the packer sees it.
use super::ChartMap;
use super::orientation::{self, Bounds};

/// A chart turned to its packing angle.
#[derive(Clone, Debug)]
pub(super) struct Outline<'a> {
    /// Rotated, with the lower left corner of the bounding rectangle at the origin; mesh units.
    pub uv: Vec<[f64; 2]>,
    pub triangles: &'a [[u32; 3]],
    /// Directed edges around the area, which lies to their left.
    pub boundary: Vec<[u32; 2]>,
    /// Sides of the bounding rectangle.
    pub extent: [f64; 2],
    /// Square root of the area.
    pub size: f64,
    /// The horizontal axis in the plane of the map, and what was subtracted after turning to it.
    axis: [f64; 2],
    low: [f64; 2],
}

impl<'a> Outline<'a> {
    pub(super) fn new(map: &ChartMap<'a>, bounds: Bounds, area: f64) -> Self {
        let mut outline = Self {
            uv: Vec::new(),
            triangles: map.triangles,
            boundary: boundary(map),
            extent: [0.0; 2],
            size: area.max(0.0).sqrt(),
            axis: orientation::direction(map.uv, bounds),
            low: [0.0; 2],
        };
        let mut high = [f64::NEG_INFINITY; 2];
        let mut low = [f64::INFINITY; 2];
        for &p in map.uv {
            let p = outline.place(p);
            for k in 0..2 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        if !map.uv.is_empty() {
            outline.low = low;
            outline.extent = [high[0] - low[0], high[1] - low[1]];
        }
        outline.uv = map.uv.iter().map(|&p| outline.place(p)).collect();
        outline
    }

    /// A point of the map, turned and shifted.
    pub(super) fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.axis;
        [c * x + s * y - self.low[0], c * y - s * x - self.low[1]]
    }

    /// Length of the boundary.
    pub(super) fn perimeter(&self) -> f64 {
        let at = |v: u32| self.uv[v as usize];
        let length = |&[p, q]: &[u32; 2]| (at(p)[0] - at(q)[0]).hypot(at(p)[1] - at(q)[1]);
        self.boundary.iter().map(length).sum()
    }
}

/// Sum of the signed areas.
pub(super) fn area(map: &ChartMap) -> f64 {
    map.triangles
        .iter()
        .map(|t| doubled_area(map, t))
        .sum::<f64>()
        / 2.0
}

fn doubled_area(map: &ChartMap, triangle: &[u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|v| map.uv[v as usize]);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// What remains of all triangles' edges when those that run in opposite directions cancel, in sorted order.
///
/// Flipped triangles, which maps without a barrier may have, are turned over first, so that they count as area too: their
/// edges then run as those of their neighbours do, and stay, twice.
pub(super) fn boundary(map: &ChartMap) -> Vec<[u32; 2]> {
    let counter_clockwise = |t: &[u32; 3]| {
        let [a, b, c] = *t;
        if doubled_area(map, t) < 0.0 {
            [a, c, b]
        } else {
            [a, b, c]
        }
    };
    // Edges by their ends, and whether they run from the smaller one to the larger.
    let mut edges: Vec<(u32, u32, bool)> = (map.triangles.iter().map(counter_clockwise))
        .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[p, q]| (p.min(q), p.max(q), p < q))
        .collect();
    edges.sort_unstable();
    let mut boundary = Vec::new();
    for same in edges.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        let (low, high, _) = same[0];
        let forward = same.iter().filter(|edge| edge.2).count();
        let back = same.len() - forward;
        boundary.extend((back..forward).map(|_| [low, high]));
        boundary.extend((forward..back).map(|_| [high, low]));
    }
    boundary
}

//! A chart as the packer sees it.
use super::ChartMap;
use super::orientation::{self, Bounds};

/// A chart turned to its packing angle.
#[derive(Clone, Debug)]
pub(super) struct Outline<'a> {
    /// Rotated, with the lower left corner of the bounding rectangle at the origin; mesh units.
    pub uv: Vec<[f64; 2]>,
    pub triangles: &'a [[u32; 3]],
    /// Edges of one triangle only.
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
            boundary: boundary(map.triangles),
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
    let signed = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| map.uv[v as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    map.triangles.iter().map(signed).sum::<f64>() / 2.0
}

/// Edges that only one triangle has, in sorted order.
fn boundary(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut edges: Vec<[u32; 2]> = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[p, q]| [p.min(q), p.max(q)])
        .collect();
    edges.sort_unstable();
    edges
        .chunk_by(|a, b| a == b)
        .filter(|run| run.len() == 1)
        .map(|run| run[0])
        .collect()
}

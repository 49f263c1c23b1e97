//! Distances of points to the region that a chart keeps free of others.
use std::f32::consts::SQRT_2;

use unwrapd_method::numerics::vec2::{dot, squared_distance};

/// Width of the raster beyond the region, in cells.
const MARGIN: f64 = 6.0;
/// Distance up to which edges are measured, beyond the distance kept, in cells.
const BAND: f64 = 2.5;
/// Bound on the difference between the value at the nearest node and that at the point, plus the error of distances beyond the
/// band, in cells.
const BLUR: f64 = 1.25;
/// A node that is deeper in the region than its distance to the nearest edge implies, by more than this many cells, lies in a slit
/// that is too narrow for anything.
const NARROW: f32 = 1.5;
/// Bound of all values, in cells, so that differences are finite.
const FARTHEST: f32 = 1e6;

/// Signed distance to the border of the region that is nearer to a chart than the distance to be kept; positive outside.
///
/// The field stores values at the nodes of a raster with cells of side 1, and is bilinear between them. Gaps of the chart that are
/// narrower than twice the distance belong to the region, as if they were filled.
pub(super) struct Field {
    size: [usize; 2],
    /// Position of the first node.
    low: [f64; 2],
    values: Vec<f32>,
}

impl Field {
    /// Computes the field of the chart to the left of directed edges, which keeps a distance of `kept` cells.
    pub(super) fn new(edges: &[[[f64; 2]; 2]], kept: f64) -> Self {
        let mut raster = Raster::around(edges, kept + MARGIN);
        raster.measure(edges, kept + BAND);
        raster.wind(edges);
        Self {
            values: raster.signed(kept, kept + BAND),
            size: raster.size,
            low: raster.low,
        }
    }

    /// Returns the signed distance of a point and its gradient. Beyond the raster, the distance is a positive constant and the
    /// gradient 0.
    pub(super) fn at(&self, p: [f64; 2]) -> (f64, [f64; 2]) {
        let [x, y] = [p[0] - self.low[0], p[1] - self.low[1]];
        let [width, height] = self.size;
        if x < 0.0 || y < 0.0 || x >= (width - 1) as f64 || y >= (height - 1) as f64 {
            return (MARGIN - 1.0, [0.0; 2]);
        }
        let (i, j) = (x as usize, y as usize);
        let (x, y) = (x - i as f64, y - j as f64);
        let corner = |k: usize| f64::from(self.values[j * width + i + k]);
        let [a, b, c, d] = [0, 1, width, width + 1].map(corner);
        let (below, above) = (a + x * (b - a), c + x * (d - c));
        let gradient = [(b - a) * (1.0 - y) + (d - c) * y, above - below];
        (below + y * (above - below), gradient)
    }

    /// Returns a lower bound of the signed distance of a point. This is cheaper than the distance.
    pub(super) fn at_least(&self, p: [f64; 2]) -> f64 {
        let [x, y] = [p[0] - self.low[0], p[1] - self.low[1]];
        let last = self.size.map(|n| (n - 1) as f64);
        let beyond = [
            (-x).max(x - last[0]).max(0.0),
            (-y).max(y - last[1]).max(0.0),
        ];
        if beyond != [0.0; 2] {
            return dot(beyond, beyond).sqrt() + MARGIN - BLUR;
        }
        let node = (y + 0.5) as usize * self.size[0] + (x + 0.5) as usize;
        f64::from(self.values[node]) - BLUR
    }
}

/// Distances of the nodes to the chart's outline, and the nodes inside it.
struct Raster {
    size: [usize; 2],
    low: [f64; 2],
    /// Distance to the nearest edge; infinite far from all edges.
    distance: Vec<f64>,
    is_inside: Vec<bool>,
}

impl Raster {
    fn around(edges: &[[[f64; 2]; 2]], margin: f64) -> Self {
        let corners = || edges.iter().map(|edge| edge[0]);
        let low = [0, 1].map(|k| corners().map(|p| p[k]).fold(0.0, f64::min) - margin);
        let size = [0, 1].map(|k| {
            let high = corners().map(|p| p[k]).fold(0.0, f64::max) + margin;
            (high - low[k]).ceil() as usize + 2
        });
        let n = size[0] * size[1];
        Self {
            size,
            low,
            distance: vec![f64::INFINITY; n],
            is_inside: vec![false; n],
        }
    }

    /// Measures distances up to `band`.
    fn measure(&mut self, edges: &[[[f64; 2]; 2]], band: f64) {
        for edge in edges {
            let [first, last] = [0, 1].map(|end| {
                [0, 1].map(|k| {
                    let (p, q) = (edge[0][k] - self.low[k], edge[1][k] - self.low[k]);
                    let reach = if end == 0 {
                        p.min(q) - band
                    } else {
                        p.max(q) + band
                    };
                    (reach.max(0.0) as usize).min(self.size[k] - 1)
                })
            });
            for j in first[1]..=last[1] {
                for i in first[0]..=last[0] {
                    let node = [self.low[0] + i as f64, self.low[1] + j as f64];
                    let distance = &mut self.distance[j * self.size[0] + i];
                    *distance = distance.min(squared_distance(node, *edge));
                }
            }
        }
        for distance in &mut self.distance {
            *distance = distance.sqrt();
        }
    }

    /// Marks the nodes around which the edges wind.
    fn wind(&mut self, edges: &[[[f64; 2]; 2]]) {
        // Row, position at which it is crossed, and change of the winding number there.
        let mut crossings: Vec<(usize, f64, i32)> = Vec::new();
        for &[p, q] in edges {
            let (from, to, sign) = if p[1] <= q[1] { (p, q, 1) } else { (q, p, -1) };
            let first = (from[1] - self.low[1]).ceil() as usize;
            let end = (to[1] - self.low[1]).ceil() as usize;
            crossings.extend((first..end).map(|row| {
                let share = (self.low[1] + row as f64 - from[1]) / (to[1] - from[1]);
                (row, from[0] + share * (to[0] - from[0]) - self.low[0], sign)
            }));
        }
        crossings.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut winding = 0;
        for pair in crossings.windows(2) {
            let [(row, start, sign), (_, end, _)] = [pair[0], pair[1]];
            winding += sign;
            // The winding number of closed lines is 0 at the end of a row.
            if winding != 0 && start < end {
                let row = row * self.size[0];
                self.is_inside[row + start.ceil() as usize..row + end.ceil() as usize].fill(true);
            }
        }
    }

    /// Returns the signed distances of the nodes to the border of the region, for a chart that was measured up to `band`.
    fn signed(&self, kept: f64, band: f64) -> Vec<f32> {
        let [width, height] = self.size;
        let is_free = |node: usize| !self.is_inside[node] && self.distance[node] >= kept;
        let is_edge = |node: usize| {
            let (i, j) = (node % width, node / width);
            i == 0 || j == 0 || i + 1 == width || j + 1 == height
        };
        // Free nodes near the chart have exact distances. Other nodes follow from their neighbors.
        let mut unknown = Vec::new();
        let start = |node: usize| {
            if is_edge(node) {
                return MARGIN as f32;
            }
            if is_free(node) && self.distance[node] <= band {
                return (self.distance[node] - kept) as f32;
            }
            unknown.push(node);
            if is_free(node) {
                f32::INFINITY
            } else {
                f32::NEG_INFINITY
            }
        };
        let mut values: Vec<f32> = (0..width * height).map(start).collect();
        spread(&mut values, width, &unknown);
        for node in unknown {
            let value = &mut values[node];
            if *value < 0.0 && self.distance[node] <= band {
                let sign = if self.is_inside[node] { -1.0 } else { 1.0 };
                let signed = (sign * self.distance[node] - kept) as f32;
                if *value >= signed - NARROW {
                    *value = signed;
                }
            }
            // Nothing is free beside a chart without edges.
            *value = value.clamp(-FARTHEST, FARTHEST);
        }
        values
    }
}

/// Estimates the values of unknown nodes, which are in the order of the raster, from their neighbors: adds the way from a neighbor, or
/// subtracts it within the region. Ways are too long by up to 8 %, which matters little so deep in the region.
///
/// From: Borgefors 1986, Distance Transformations in Digital Images.
fn spread(values: &mut [f32], width: usize, unknown: &[usize]) {
    let mut estimate = |node: usize, straight: [usize; 2], diagonal: [usize; 2]| {
        let [[a, b], [c, d]] = [straight, diagonal].map(|two| two.map(|it| values[it]));
        let value = &mut values[node];
        *value = if *value > 0.0 {
            value.min(a.min(b) + 1.0).min(c.min(d) + SQRT_2)
        } else {
            value.max(a.max(b) - 1.0).max(c.max(d) - SQRT_2)
        };
    };
    for &node in unknown {
        let above = node - width;
        estimate(node, [node - 1, above], [above - 1, above + 1]);
    }
    for &node in unknown.iter().rev() {
        let below = node + width;
        estimate(node, [node + 1, below], [below + 1, below - 1]);
    }
}

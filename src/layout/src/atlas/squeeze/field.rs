//! Distances of points to the region that a chart keeps free of others.
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
const NARROW: f64 = 1.5;

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
            values: raster.signed(kept),
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

    /// Returns the signed distances of the nodes to the border of the region.
    fn signed(&self, kept: f64) -> Vec<f32> {
        let both = self.is_inside.iter().zip(&self.distance);
        let is_free: Vec<bool> = both
            .map(|(&is_inside, &distance)| !is_inside && distance >= kept)
            .collect();
        let mut nearest = vec![Nearest::UNKNOWN; is_free.len()];
        for (index, nearest) in nearest.iter_mut().enumerate() {
            let distance = self.distance[index];
            if is_free[index] && distance.is_finite() {
                *nearest = Nearest::itself(distance - kept);
            }
        }
        self.spread(&mut nearest, &is_free);
        let both = nearest.iter().zip(is_free).enumerate();
        let values = both.map(|(index, (nearest, is_free))| {
            let by = nearest.by(is_free);
            let sign = if self.is_inside[index] { -1.0 } else { 1.0 };
            let signed = sign * self.distance[index] - kept;
            if by == f64::INFINITY {
                signed
            } else if is_free {
                by
            } else if by > NARROW - signed || signed.is_infinite() {
                -by
            } else {
                signed
            }
        });
        values.map(|value| value.clamp(-1e6, 1e6) as f32).collect()
    }

    /// Assigns to each node the nearest known node that its neighbors pass on. A known node keeps itself.
    ///
    /// From: Danielsson 1980, Euclidean Distance Mapping.
    fn spread(&self, nearest: &mut [Nearest], is_free: &[bool]) {
        let [width, height] = self.size;
        for j in 0..height {
            for i in 0..width {
                let before = [[-1, 0], [-1, -1], [0, -1], [1, -1]];
                self.pass_on(nearest, is_free, [i, j], before);
            }
        }
        for j in (0..height).rev() {
            for i in (0..width).rev() {
                let before = [[1, 0], [1, 1], [0, 1], [-1, 1]];
                self.pass_on(nearest, is_free, [i, j], before);
            }
        }
    }

    /// Passes the known nodes of four neighbors on to a node.
    fn pass_on(
        &self,
        nearest: &mut [Nearest],
        is_free: &[bool],
        [i, j]: [usize; 2],
        neighbors: [[isize; 2]; 4],
    ) {
        let [width, height] = self.size;
        let index = j * width + i;
        let mut best = nearest[index];
        if best.way == [0.0; 2] {
            return;
        }
        let is_free = is_free[index];
        let mut least = best.by(is_free);
        for [x, y] in neighbors {
            let (column, row) = (i.wrapping_add_signed(x), j.wrapping_add_signed(y));
            if column < width && row < height {
                let neighbor = nearest[row * width + column];
                if neighbor.is_unknown() {
                    continue;
                }
                let known = neighbor.seen_from([x, y]);
                if known.is_nearer(least, is_free) {
                    (best, least) = (known, known.by(is_free));
                }
            }
        }
        nearest[index] = best;
    }
}

/// Known free node that is the nearest of those that a node has heard of.
#[derive(Clone, Copy)]
struct Nearest {
    /// Columns and rows from the known node to this one.
    way: [f64; 2],
    /// Distance of the known node to the border of the region.
    rest: f64,
}

impl Nearest {
    const UNKNOWN: Self = Self {
        way: [f64::INFINITY; 2],
        rest: 0.0,
    };

    const fn itself(rest: f64) -> Self {
        Self {
            way: [0.0; 2],
            rest,
        }
    }

    fn is_unknown(self) -> bool {
        self.way[0] == f64::INFINITY
    }

    /// Returns the known node of a neighbor, `way` columns and rows ahead, as this node sees it.
    fn seen_from(self, way: [isize; 2]) -> Self {
        Self {
            way: [0, 1].map(|k| self.way[k] - way[k] as f64),
            ..self
        }
    }

    /// Estimates the distance of this node to the border of the region: adds the distance of the known node to the border if this node
    /// is free, too, and subtracts it if it lies in the region. Infinite if no node is known.
    fn by(self, is_free: bool) -> f64 {
        dot(self.way, self.way).sqrt() + self.signed_rest(is_free)
    }

    /// Returns whether that distance is below a bound, without its root.
    fn is_nearer(self, bound: f64, is_free: bool) -> bool {
        let most = bound - self.signed_rest(is_free);
        most > 0.0 && dot(self.way, self.way) < most * most
    }

    fn signed_rest(self, is_free: bool) -> f64 {
        if is_free { self.rest } else { -self.rest }
    }
}

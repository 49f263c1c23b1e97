//! Sides of a chart: parts of its border that run along an axis, or nearly so.

use crate::charts::Chart;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
use unwrapd_method::numerics::vec2::sub;
use unwrapd_method::numerics::vec3;

/// Angle to the axis from which on an edge of an ordinary chart is on no side: halfway to the diagonal.
const FREE: f64 = PI / 8.0;

/// Least length of a side, as a share of the square root of the chart's area.
const SHORTEST: f64 = 0.1;

/// Price of a turn on the surface within a side, for one radian, as a share of the square root of the chart's area. With it, sides of
/// their own do not pay on discs (an eighth of the border would gain .044), and turns of 10 degrees do where a side is longer than a
/// tenth of that root.
const TURN: f64 = 0.1;

/// Angles from which the axes are chosen, in a quarter turn: neighbors differ by far less than [`FREE`].
const ANGLES: usize = 64;

/// A part of the border that is to run along an axis.
pub struct Side {
    /// Its edges.
    pub edges: Vec<[u32; 2]>,
    /// The coordinate that its vertices are to share: 0 for a side along v, 1 along u.
    pub coordinate: usize,
    /// Mean of sin² of the angle to the axis.
    pub deviation: f64,
    pub length: f64,
}

impl Side {
    /// Returns the mean of sin² of the angle to the axis in a map in which it is along its coordinate.
    pub fn deviation_in(&self, uv: &[[f64; 2]]) -> f64 {
        let (mut sum, mut all) = (0.0, 0.0);
        for ends in &self.edges {
            let [p, q] = ends.map(|v| uv[v as usize]);
            let edge = sub(q, p);
            let length = edge[0].hypot(edge[1]).max(f64::MIN_POSITIVE);
            sum += edge[self.coordinate].powi(2) / length;
            all += length;
        }
        sum / all
    }
}

/// Sides of a chart, those that bend least first, and the unit vector along the first axis.
pub struct Sides {
    pub axis: [f64; 2],
    pub sides: Vec<Side>,
}

impl Sides {
    /// Finds the sides of a map; `None` if it has no border.
    ///
    /// The border of a *strip* turns by about a right angle at four corners, and by less everywhere else. Each part between two corners
    /// is a side, even if it is an arc, as on a belt. The axes of any other chart follow most of its border, and its sides are the parts
    /// that run along them and are straight on the surface.
    pub fn of(chart: &Chart, uv: &[[f64; 2]]) -> Option<Self> {
        let disk = &chart.disk;
        let around = angle_sums(chart);
        let loops: Vec<ClosedBorder> = (disk.loops.iter())
            .map(|of| ClosedBorder::new(of, uv, &around))
            .collect();
        let outer = (0..loops.len()).max_by(|&a, &b| loops[a].area.total_cmp(&loops[b].area))?;
        let strip = loops[outer].strip_directions();
        let angle = match &strip {
            Some(directions) => loops[outer].angle_to(directions),
            None => main_angle(&loops),
        };
        let area: f64 = loops.iter().map(|border| border.area).sum();
        let size = area.max(0.0).sqrt();
        let mut sides = Vec::new();
        for (index, border) in loops.iter().enumerate() {
            let directions = match &strip {
                Some(directions) if index == outer => {
                    directions.iter().copied().map(Some).collect()
                }
                _ => border.directions(angle, size),
            };
            sides.extend(border.sides(&directions, angle));
        }
        sides.sort_by(|a, b| a.deviation.total_cmp(&b.deviation));
        Some(Self {
            axis: [angle.cos(), angle.sin()],
            sides,
        })
    }
}

/// A closed border; its edges go around the area to their left.
struct ClosedBorder {
    /// First vertex of each edge.
    vertices: Vec<u32>,
    length: Vec<f64>,
    /// Direction of each edge, in radians.
    angle: Vec<f64>,
    /// Angle by which the border turns on the surface before each edge.
    turning: Vec<f64>,
    /// Area to the left, negative for a hole.
    area: f64,
}

/// Returns the angle of a full turn less that is nearest to zero.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// Returns the angle of an edge to the nearest axis.
fn to_nearest_axis(angle: f64) -> f64 {
    angle - FRAC_PI_2 * (angle / FRAC_PI_2).round()
}

/// Price of a length of border that is on no side: what one at the angle [`FREE`] to its axis costs.
fn free_price() -> f64 {
    2.0 * (1.0 - FREE.cos())
}

/// Returns the angle of the axes that leave least of the borders free: the best of [`ANGLES`], then the mean over what is near it.
fn main_angle(loops: &[ClosedBorder]) -> f64 {
    let edges = || {
        let edges = loops.iter().flat_map(|it| it.length.iter().zip(&it.angle));
        edges.map(|(&length, &angle)| (length, angle))
    };
    let cost = |axis: f64| -> f64 {
        let costs = edges().map(|(length, angle)| {
            let deviation = to_nearest_axis(angle - axis);
            length * (2.0 * (1.0 - deviation.cos())).min(free_price())
        });
        costs.sum()
    };
    let candidates = (0..ANGLES).map(|k| FRAC_PI_2 * k as f64 / ANGLES as f64);
    let (axis, _) = candidates
        .map(|axis| (axis, cost(axis)))
        .fold((0.0, f64::INFINITY), |a, b| if b.1 < a.1 { b } else { a });
    let (mut sum, mut all) = (0.0, 0.0);
    for (length, angle) in edges() {
        let deviation = to_nearest_axis(angle - axis);
        if deviation.abs() < FREE {
            sum += length * deviation;
            all += length;
        }
    }
    if all > 0.0 { axis + sum / all } else { axis }
}

/// Returns for each vertex the sum of the angles around it on the surface.
fn angle_sums(chart: &Chart) -> Vec<f64> {
    let mut sums = vec![0.0; chart.disk.n_vertices];
    for triangle in &chart.disk.triangles {
        let p = triangle.map(|v| chart.positions[v as usize]);
        for k in 0..3 {
            let [u, v] = [1, 2].map(|next| vec3::sub(p[(k + next) % 3], p[k]));
            let angle = vec3::norm(vec3::cross(u, v)).atan2(vec3::dot(u, v));
            sums[triangle[k] as usize] += angle;
        }
    }
    sums
}

impl ClosedBorder {
    fn new(vertices: &[u32], uv: &[[f64; 2]], around: &[f64]) -> Self {
        let n = vertices.len();
        let at = |i: usize| uv[vertices[i % n] as usize];
        let edges: Vec<[f64; 2]> = (0..n).map(|i| sub(at(i + 1), at(i))).collect();
        let first = at(0);
        let doubled = |i: usize| {
            let [p, q] = [sub(at(i), first), sub(at(i + 1), first)];
            p[0] * q[1] - p[1] * q[0]
        };
        Self {
            vertices: vertices.to_vec(),
            length: edges.iter().map(|e| e[0].hypot(e[1])).collect(),
            angle: edges.iter().map(|e| e[1].atan2(e[0])).collect(),
            turning: vertices.iter().map(|&v| PI - around[v as usize]).collect(),
            area: (0..n).map(doubled).sum::<f64>() / 2.0,
        }
    }

    fn n(&self) -> usize {
        self.vertices.len()
    }

    /// Returns the quarter turn in which each edge of a strip is to run; `None` if the chart is not a strip.
    fn strip_directions(&self) -> Option<Vec<u8>> {
        let n = self.n();
        let turn = |i: usize| wrapped(self.angle[i] - self.angle[(i + n - 1) % n]);
        let quarters = |i: usize| (turn(i) / FRAC_PI_2).round();
        let corners: Vec<usize> = (0..n).filter(|&i| quarters(i) != 0.0).collect();
        if corners.len() != 4 || corners.iter().any(|&i| quarters(i) != 1.0) {
            return None;
        }
        let passed = |i: usize| corners.iter().filter(|&&corner| corner <= i).count();
        let directions: Vec<u8> = (0..n).map(|i| (passed(i) % 4) as u8).collect();
        // An edge at a right angle to its axis would not know where to turn.
        let angle = self.angle_to(&directions);
        let is_near = |i: usize| self.deviation(i, directions[i], angle).abs() < FRAC_PI_2;
        (0..n).all(is_near).then_some(directions)
    }

    /// Returns the angle of the first axis that suits these directions best.
    fn angle_to(&self, directions: &[u8]) -> f64 {
        let (mut cos, mut sin) = (0.0, 0.0);
        for (i, &direction) in directions.iter().enumerate() {
            let angle = self.angle[i] - f64::from(direction) * FRAC_PI_2;
            cos += self.length[i] * angle.cos();
            sin += self.length[i] * angle.sin();
        }
        sin.atan2(cos)
    }

    /// Returns the angle of an edge to its direction, if the first axis has this angle.
    fn deviation(&self, edge: usize, direction: u8, axis: f64) -> f64 {
        wrapped(self.angle[edge] - axis - f64::from(direction) * FRAC_PI_2)
    }

    /// Returns for each edge the quarter turn in which it runs, `None` for those that run along no axis.
    ///
    /// The directions minimize the deviations, 2 (1 − cos δ) for each length, plus prices for each change, with which short sides do
    /// not pay, and for what a side turns on the surface (Viterbi's algorithm; each state in turn is that of the first edge). `size`
    /// is that of the chart.
    fn directions(&self, axis: f64, size: f64) -> Vec<Option<u8>> {
        const STATES: usize = 5;
        let free = free_price();
        let change = free * SHORTEST * size / 2.0;
        let turn = |i: usize, state: usize| match state {
            4 => 0.0,
            _ => TURN * size * self.turning[i].abs(),
        };
        let cost = |i: usize, state: usize| {
            let unit = match state {
                4 => free,
                _ => 2.0 * (1.0 - self.deviation(i, state as u8, axis).cos()),
            };
            self.length[i] * unit
        };
        let n = self.n();
        let mut best: (f64, Vec<usize>) = (f64::INFINITY, Vec::new());
        for first in 0..STATES {
            let mut sums = [f64::INFINITY; STATES];
            sums[first] = cost(0, first);
            let mut from: Vec<[usize; STATES]> = vec![[first; STATES]];
            for i in 1..n {
                let cheapest = (0..STATES).fold(0, |a, b| if sums[b] < sums[a] { b } else { a });
                let mut next = [0.0; STATES];
                let mut origin = [0; STATES];
                for state in 0..STATES {
                    let kept = sums[state] + turn(i, state);
                    let (source, sum) = if sums[cheapest] + change < kept {
                        (cheapest, sums[cheapest] + change)
                    } else {
                        (state, kept)
                    };
                    origin[state] = source;
                    next[state] = sum + cost(i, state);
                }
                sums = next;
                from.push(origin);
            }
            let closing = |state: usize| {
                if state == first {
                    turn(0, state)
                } else {
                    change
                }
            };
            let total = |state: usize| sums[state] + closing(state);
            let last = (0..STATES).fold(0, |a, b| if total(b) < total(a) { b } else { a });
            if total(last) < best.0 {
                let mut states = vec![last; n];
                for i in (1..n).rev() {
                    states[i - 1] = from[i][states[i]];
                }
                best = (total(last), states);
            }
        }
        // An edge that is nearer to another axis, as in a notch, ends a side.
        let is_near = |i: usize, state: u8| self.deviation(i, state, axis).abs() < FRAC_PI_4;
        let direction = |(i, state): (usize, &usize)| {
            let state = *state as u8;
            (state < 4 && is_near(i, state)).then_some(state)
        };
        best.1.iter().enumerate().map(direction).collect()
    }

    /// Returns the sides: edges in a row that have one direction.
    fn sides(&self, directions: &[Option<u8>], axis: f64) -> Vec<Side> {
        let n = self.n();
        let before = |i: usize| (i + n - 1) % n;
        let begins = |&i: &usize| directions[i] != directions[before(i)];
        let Some(first) = (0..n).find(begins) else {
            return Vec::new();
        };
        let mut sides: Vec<Side> = Vec::new();
        for i in (first..first + n).map(|i| i % n) {
            let Some(direction) = directions[i] else {
                continue;
            };
            if begins(&i) {
                sides.push(Side {
                    edges: Vec::new(),
                    coordinate: usize::from(direction % 2 == 0),
                    deviation: 0.0,
                    length: 0.0,
                });
            }
            if let Some(side) = sides.last_mut() {
                let sin = self.deviation(i, direction, axis).sin();
                let ends = [i, (i + 1) % n].map(|k| self.vertices[k]);
                side.edges.push(ends);
                side.deviation += self.length[i] * sin * sin;
                side.length += self.length[i];
            }
        }
        sides.retain(|side| side.length.is_normal());
        for side in &mut sides {
            side.deviation /= side.length;
        }
        sides
    }
}

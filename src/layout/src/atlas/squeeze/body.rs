//! A chart that moves and rotates freely, with sample points along its outline.
use std::collections::HashMap;

use super::field::Field;
use crate::atlas::outline::Outline;
use crate::atlas::problem::Rotation;
use unwrapd_method::numerics::vec2::{cross, dot, sub};

/// Position and angle of a body.
#[derive(Clone, Copy, Debug)]
pub(in crate::atlas) struct Pose {
    /// Position of its middle.
    pub middle: [f64; 2],
    /// Angle by which it is turned counter-clockwise, in radians.
    pub angle: f64,
    /// Cosine and sine of the angle.
    turn: [f64; 2],
    /// Factor by which the body is enlarged.
    pub(super) stretch: f64,
}

impl Pose {
    pub(in crate::atlas) fn new(middle: [f64; 2], angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self {
            middle,
            angle,
            turn: [cos, sin],
            stretch: 1.0,
        }
    }

    /// Returns the pose with the body enlarged about its middle.
    pub(super) fn stretched(self, stretch: f64) -> Self {
        Self { stretch, ..self }
    }

    /// Returns the pose shifted by `by` and turned further by `angle`.
    pub(super) fn moved(&self, by: [f64; 2], angle: f64) -> Self {
        Self::new([0, 1].map(|k| self.middle[k] + by[k]), self.angle + angle)
    }

    /// Maps a point from the frame of the body to the page.
    pub(super) fn place(&self, p: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.turned(p.map(|x| x * self.stretch));
        [self.middle[0] + x, self.middle[1] + y]
    }

    /// Rotates a vector from the frame of the body to that of the page.
    pub(super) fn turned(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.turn;
        [c * x - s * y, s * x + c * y]
    }

    /// Maps a point from the page to the frame of the body.
    fn back(&self, p: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.turn.map(|x| x / self.stretch);
        let [x, y] = [p[0] - self.middle[0], p[1] - self.middle[1]];
        [c * x + s * y, c * y - s * x]
    }
}

/// Chart in a frame whose origin is the middle of its rectangle, in cells.
pub(in crate::atlas) struct Body {
    field: Field,
    pub(super) samples: Vec<Samples>,
    /// Distance that it keeps from other charts, in cells.
    pub(super) kept: f64,
    /// Half the sides of its rectangle.
    pub(super) half: [f64; 2],
    /// Half the diagonal of its rectangle; at least 1.
    pub(super) radius: f64,
    pub(super) rotation: Rotation,
}

impl Body {
    /// Creates the body of an outline at `scale` cells per mesh unit, which keeps other charts `kept` cells away.
    pub(in crate::atlas) fn new(outline: &Outline, scale: f64, kept: f64) -> Self {
        let half = outline.extent.map(|x| x * scale / 2.0);
        let place = |p: [f64; 2]| [p[0] * scale - half[0], p[1] * scale - half[1]];
        let edges: Vec<[[f64; 2]; 2]> = outline.edges().map(|edge| edge.map(place)).collect();
        let field = Field::new(&edges, kept);
        // Points in a slit touch nothing.
        let samples = samples(&edges, |p| field.at(p).0 > -1.5 * kept - 0.5);
        Self {
            samples,
            field,
            kept,
            half,
            radius: half[0].hypot(half[1]).max(1.0),
            rotation: if outline.has_copies {
                Rotation::None
            } else {
                outline.rotation()
            },
        }
    }

    /// Returns the signed distance of a point of the page to the region that the body keeps free at a pose, and its gradient.
    pub(super) fn distance(&self, pose: &Pose, point: [f64; 2]) -> (f64, [f64; 2]) {
        let (distance, gradient) = self.field.at(pose.back(point));
        (self.stretched(distance, pose), pose.turned(gradient))
    }

    /// Returns a lower bound of this distance. This is cheaper than the distance.
    pub(super) fn least_distance(&self, pose: &Pose, point: [f64; 2]) -> f64 {
        self.stretched(self.field.at_least(pose.back(point)), pose)
    }

    /// Returns a distance from the region around the enlarged body. The distance that it keeps is not enlarged.
    fn stretched(&self, distance: f64, pose: &Pose) -> f64 {
        (distance + self.kept) * pose.stretch - self.kept
    }

    /// Returns the bounds, at a pose, of the body's rectangle.
    pub(super) fn bounds(&self, pose: &Pose) -> [[f64; 2]; 2] {
        let [c, s] = pose.turn.map(|x| x.abs() * pose.stretch);
        let [w, h] = self.half;
        let half = [c * w + s * h, s * w + c * h];
        [[-1.0; 2], [1.0; 2]].map(|sign| [0, 1].map(|k| pose.middle[k] + sign[k] * half[k]))
    }
}

/// Distance between sample points along the outline, in cells.
const SPACING: f64 = 1.0;
/// Smallest turn of the outline that counts as a corner, in radians. Every corner has a sample point.
const CORNER: f64 = 0.4;
/// Number of points in a run.
pub(super) const SAMPLES: usize = 8;

/// Consecutive sample points, and a circle around them.
pub(super) struct Samples {
    pub points: [[f64; 2]; SAMPLES],
    pub center: [f64; 2],
    pub radius: f64,
}

/// Returns sample points along closed lines, spaced evenly and at corners, in groups. Includes only points that `is_wanted` accepts.
pub(super) fn samples(
    edges: &[[[f64; 2]; 2]],
    is_wanted: impl Fn([f64; 2]) -> bool,
) -> Vec<Samples> {
    let mut samples = Vec::new();
    for line in lines(edges) {
        let points: Vec<[f64; 2]> = spaced(&line)
            .into_iter()
            .filter(|&p| is_wanted(p))
            .collect();
        samples.extend(points.chunks(SAMPLES).map(Samples::of));
    }
    samples
}

impl Samples {
    fn of(some: &[[f64; 2]]) -> Self {
        let points = std::array::from_fn(|k| some[k.min(some.len() - 1)]);
        let center =
            [0, 1].map(|k| points.iter().map(|p: &[f64; 2]| p[k]).sum::<f64>() / SAMPLES as f64);
        let reach = |p: &[f64; 2]| (p[0] - center[0]).hypot(p[1] - center[1]);
        Self {
            radius: points.iter().map(reach).fold(0.0, f64::max),
            points,
            center,
        }
    }
}

/// Joins directed edges to closed lines.
fn lines(edges: &[[[f64; 2]; 2]]) -> Vec<Vec<[f64; 2]>> {
    let key = |p: [f64; 2]| p.map(f64::to_bits);
    let mut next: HashMap<[u64; 2], Vec<usize>> = HashMap::new();
    for (i, edge) in edges.iter().enumerate().rev() {
        next.entry(key(edge[0])).or_default().push(i);
    }
    let mut lines = Vec::new();
    let mut is_used = vec![false; edges.len()];
    for first in 0..edges.len() {
        let mut line = Vec::new();
        let mut edge = Some(first).filter(|&i| !is_used[i]);
        while let Some(i) = edge {
            is_used[i] = true;
            line.push(edges[i][0]);
            let following = next.get_mut(&key(edges[i][1]));
            edge = following.and_then(|following| {
                following.retain(|&i| !is_used[i]);
                following.pop()
            });
        }
        if !line.is_empty() {
            lines.push(line);
        }
    }
    lines
}

/// Returns points along a closed line, spaced evenly and at its corners.
fn spaced(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    let mut since = SPACING;
    let mut before = line.last().map_or([0.0; 2], |&last| sub(line[0], last));
    for (i, &p) in line.iter().enumerate() {
        let q = line[(i + 1) % line.len()];
        let along = sub(q, p);
        let turn = cross(before, along).atan2(dot(before, along));
        before = along;
        let length = along[0].hypot(along[1]);
        let is_corner = turn.abs() > CORNER;
        let mut at = if is_corner { 0.0 } else { SPACING - since };
        while at < length {
            points.push([0, 1].map(|k| p[k] + along[k] * at / length));
            at += SPACING;
        }
        since = length + SPACING - at;
    }
    points
}

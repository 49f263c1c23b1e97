//! Points along the outline of a chart.
use std::collections::HashMap;
use unwrapd_method::numerics::vec2::{cross, dot, sub};

/// Between points along the outline, in cells.
const SPACING: f64 = 1.0;
/// Corners turn by more than this, in radians; a point lies on each.
const CORNER: f64 = 0.4;
/// Points of one run.
pub(super) const RUN: usize = 8;

/// Some points that follow each other, within a circle.
pub(super) struct Run {
    pub points: [[f64; 2]; RUN],
    pub center: [f64; 2],
    pub radius: f64,
}

/// Points along closed lines, evenly and at their corners; of those that may be left out only some.
pub(super) fn runs(edges: &[[[f64; 2]; 2]], is_wanted: impl Fn([f64; 2]) -> bool) -> Vec<Run> {
    let mut runs = Vec::new();
    for line in lines(edges) {
        let points: Vec<[f64; 2]> = spaced(&line)
            .into_iter()
            .filter(|&p| is_wanted(p))
            .collect();
        runs.extend(points.chunks(RUN).map(Run::of));
    }
    runs
}

impl Run {
    fn of(some: &[[f64; 2]]) -> Self {
        let points = std::array::from_fn(|k| some[k.min(some.len() - 1)]);
        let center =
            [0, 1].map(|k| points.iter().map(|p: &[f64; 2]| p[k]).sum::<f64>() / RUN as f64);
        let reach = |p: &[f64; 2]| (p[0] - center[0]).hypot(p[1] - center[1]);
        Self {
            radius: points.iter().map(reach).fold(0.0, f64::max),
            points,
            center,
        }
    }
}

/// The closed lines that directed edges make.
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

/// Points along a closed line.
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

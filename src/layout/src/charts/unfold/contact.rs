//! Where the boundary of a map has passed itself.

use crate::charts::Chart;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use unwrapd_maps::mesh::{CUT, next, origin};
use unwrapd_method::numerics::vec2::{cross, dot, sub};

/// Overlapped faces at most that are searched for the edge over which a vertex came.
const SEARCHED: usize = 400;

/// How far a vertex is to stay from an edge, in units of its length.
const CLEARANCE: f64 = 0.1;

/// Boundary vertices that lie, or lay, where other faces are, each with the edge of the boundary that it should be beyond.
pub struct Contacts<'a> {
    chart: &'a Chart,
    twin: &'a [u32],
    /// For each vertex of the boundary the ones before and after it.
    before: BTreeMap<u32, u32>,
    after: BTreeMap<u32, u32>,
    /// For each vertex the start of its edge.
    edges: BTreeMap<u32, u32>,
}

/// A vertex and the nearest point of an edge: where the one should be, seen from the other.
struct Offset {
    /// Share of the way from the edge's start to its end.
    share: f64,
    /// The vertex less the point.
    way: [f64; 2],
    /// Direction out of the surface.
    normal: [f64; 2],
    /// How far the vertex should be out.
    clearance: f64,
}

impl<'a> Contacts<'a> {
    pub fn new(chart: &'a Chart, twin: &'a [u32]) -> Self {
        let (mut before, mut after) = (BTreeMap::new(), BTreeMap::new());
        for boundary in &chart.disk.loops {
            for (&v, &w) in boundary.iter().zip(boundary.iter().cycle().skip(1)) {
                after.insert(v, w);
                before.insert(w, v);
            }
        }
        Self {
            chart,
            twin,
            before,
            after,
            edges: BTreeMap::new(),
        }
    }

    /// Adds the vertices that lie in other faces, given the pairs of faces of a fold, and lets go of those that are farther out than
    /// they should be; false if one lies deeper than `deepest`, or where no edge is to be seen that it could have come over.
    pub fn renew(&mut self, uv: &[[f64; 2]], pairs: &[[u32; 2]], deepest: f64) -> bool {
        let mut edges = std::mem::take(&mut self.edges);
        edges.retain(|&v, edge| {
            *edge = self.slid(uv, v, *edge);
            let offset = self.offset(uv, v, *edge);
            dot(offset.way, offset.normal) <= offset.clearance
        });
        let is_overlapped: BTreeSet<u32> = pairs.as_flattened().iter().copied().collect();
        for (face, other) in pairs.iter().flat_map(|&[f, g]| [(f, g), (g, f)]) {
            for v in self.chart.disk.triangles[face as usize] {
                if !self.after.contains_key(&v)
                    || edges.contains_key(&v)
                    || !self.covers(uv, other, v)
                {
                    continue;
                }
                match self.exit(uv, &is_overlapped, other, v) {
                    Some((depth, edge)) if depth <= deepest => edges.insert(v, edge),
                    _ => return false,
                };
            }
        }
        self.edges = edges;
        true
    }

    /// Takes over those of another.
    pub fn extend(&mut self, other: &Self) {
        self.edges.extend(&other.edges);
    }

    /// None, on the same boundary.
    pub fn none(&self) -> Self {
        Self {
            edges: BTreeMap::new(),
            before: self.before.clone(),
            after: self.after.clone(),
            ..*self
        }
    }

    pub fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    /// The vertices and the ends of their edges.
    pub fn vertices(&self) -> impl Iterator<Item = u32> {
        let three = |(&v, &a): (&u32, &u32)| [v, a, self.after[&a]];
        self.edges.iter().flat_map(three)
    }

    /// Each vertex less its point, as a linear function of the vertices, and what that should be.
    pub fn constraints(
        &self,
        uv: &[[f64; 2]],
    ) -> impl Iterator<Item = ([(u32, f64); 3], [f64; 2])> {
        self.edges.iter().map(move |(&v, &a)| {
            let offset = self.offset(uv, v, a);
            let mut row = [
                (v, 1.0),
                (a, offset.share - 1.0),
                (self.after[&a], -offset.share),
            ];
            row.sort_unstable_by_key(|&(v, _)| v);
            (row, offset.normal.map(|n| n * offset.clearance))
        })
    }

    fn covers(&self, uv: &[[f64; 2]], face: u32, v: u32) -> bool {
        let corners = self.chart.disk.triangles[face as usize];
        let p = uv[v as usize];
        !corners.contains(&v)
            && (0..3).all(|k| {
                let [a, b] = [corners[k], corners[(k + 1) % 3]].map(|v| uv[v as usize]);
                cross(sub(b, a), sub(p, a)) >= 0.0
            })
    }

    /// The start of the nearest edge of the boundary that is reached from a face over overlapped faces and has the vertex on its
    /// inner side.
    fn exit(
        &self,
        uv: &[[f64; 2]],
        is_overlapped: &BTreeSet<u32>,
        from: u32,
        v: u32,
    ) -> Option<(f64, u32)> {
        let triangles = &self.chart.disk.triangles;
        let mut seen = vec![from];
        let mut queue = VecDeque::from([from]);
        let mut best: Option<(f64, u32)> = None;
        while let Some(face) = queue.pop_front() {
            for h in 3 * face..3 * face + 3 {
                let (a, b) = (origin(triangles, h), origin(triangles, next(h)));
                match self.twin[h as usize] {
                    CUT if a != v && b != v => {
                        let offset = self.offset(uv, v, a);
                        let depth = -dot(offset.way, offset.normal);
                        if depth >= 0.0 && best.is_none_or(|(least, _)| depth < least) {
                            best = Some((depth, a));
                        }
                    }
                    CUT => {}
                    t => {
                        let across = t / 3;
                        if is_overlapped.contains(&across)
                            && seen.len() < SEARCHED
                            && !seen.contains(&across)
                            && !triangles[across as usize].contains(&v)
                        {
                            seen.push(across);
                            queue.push_back(across);
                        }
                    }
                }
            }
        }
        best
    }

    /// The edge next to this one, or next to that, which is nearest to a vertex.
    fn slid(&self, uv: &[[f64; 2]], v: u32, mut edge: u32) -> u32 {
        let distance = |a: u32| {
            if a == v || self.after[&a] == v {
                return f64::INFINITY;
            }
            let way = self.offset(uv, v, a).way;
            dot(way, way)
        };
        loop {
            let [before, after] = [self.before[&edge], self.after[&edge]];
            let here = distance(edge);
            if distance(before) < here {
                edge = before;
            } else if distance(after) < here {
                edge = after;
            } else {
                return edge;
            }
        }
    }

    fn offset(&self, uv: &[[f64; 2]], v: u32, edge: u32) -> Offset {
        let [p, a, b] = [v, edge, self.after[&edge]].map(|v| uv[v as usize]);
        let along = sub(b, a);
        let length = dot(along, along).sqrt();
        let share = (dot(sub(p, a), along) / (length * length)).clamp(0.0, 1.0);
        let point = [0, 1].map(|k| a[k] + share * along[k]);
        let way = sub(p, point);
        let distance = dot(way, way).sqrt();
        let is_inside = cross(along, sub(p, a)) > 0.0;
        let normal = if distance < 1e-6 * length {
            [along[1] / length, -along[0] / length]
        } else {
            way.map(|x| if is_inside { -x } else { x } / distance)
        };
        Offset {
            share,
            way,
            normal,
            clearance: CLEARANCE * length,
        }
    }
}

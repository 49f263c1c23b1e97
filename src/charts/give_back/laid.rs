//! A chart laid on another along a common border.

use super::border::Run;
use super::occupied::Ground;
use crate::charts::{Chart, MappedChart};
use crate::embed::{self, Embedding};
use crate::mesh::Disk;
use crate::numerics::vec2::{cross, dot, sub};

/// A chart moved to where it might be glued to another.
pub struct Laid {
    chart: Chart,
    uv: Vec<[f64; 2]>,
    /// The common vertices: its own, and the other's.
    seam: Vec<[u32; 2]>,
}

impl Laid {
    /// The chart moved rigidly to where the vertices of a run fit best to the neighbor's, and these put to where the neighbor has
    /// them; none if a face is not positive so.
    pub fn new(map: &MappedChart, neighbor: &MappedChart, run: &Run) -> Option<Self> {
        let mut chart = map.chart.clone();
        let mut from = map.embedding.uv.clone();
        if run.is_turned {
            chart.turn_over();
            for p in &mut from {
                p[0] = -p[0];
            }
        }
        let mut uv = fitted(&from, &neighbor.embedding.uv, &run.vertices);
        for &[v, w] in &run.vertices {
            uv[v as usize] = neighbor.embedding.uv[w as usize];
        }
        embed::is_positive(&chart.disk.triangles, &uv).then(|| Self {
            chart,
            uv,
            seam: run.vertices.clone(),
        })
    }

    /// How many pairs of its faces and the neighbor's overlap, counted up to about this many.
    pub fn n_overlaps(&self, ground: &Ground, most: usize) -> usize {
        ground.n_overlaps(&self.chart.disk.triangles, &self.uv, most)
    }

    /// The neighbor, its map as it is, with the chart glued to it; none if that is no disk.
    pub fn glued(self, neighbor: &MappedChart) -> Option<MappedChart> {
        let (chart, number) = glued(&self.chart, &neighbor.chart, &self.seam)?;
        let mut uv = neighbor.embedding.uv.clone();
        uv.resize(chart.disk.n_vertices, [0.0; 2]);
        for (&n, &p) in number.iter().zip(&self.uv) {
            uv[n as usize] = p;
        }
        Some(MappedChart {
            chart,
            embedding: Embedding {
                uv,
                summary: neighbor.embedding.summary,
            },
            seconds: neighbor.seconds,
        })
    }
}

/// The places of one map, moved rigidly to where those of its vertices in `pairs` are as near as can be to their partners' in another.
fn fitted(from: &[[f64; 2]], to: &[[f64; 2]], pairs: &[[u32; 2]]) -> Vec<[f64; 2]> {
    let mean = |places: &[[f64; 2]], k: usize| {
        let sum = pairs.iter().fold([0.0; 2], |sum, pair| {
            let p = places[pair[k] as usize];
            [sum[0] + p[0], sum[1] + p[1]]
        });
        sum.map(|x| x / pairs.len() as f64)
    };
    let (here, there) = (mean(from, 0), mean(to, 1));
    let mut turn = [0.0; 2];
    for &[v, w] in pairs {
        let (p, q) = (sub(from[v as usize], here), sub(to[w as usize], there));
        turn = [turn[0] + dot(p, q), turn[1] + cross(p, q)];
    }
    let length = turn[0].hypot(turn[1]).max(f64::MIN_POSITIVE);
    let [cos, sin] = turn.map(|x| x / length);
    let moved = |&p: &[f64; 2]| {
        let [x, y] = sub(p, here);
        [there[0] + cos * x - sin * y, there[1] + sin * x + cos * y]
    };
    from.iter().map(moved).collect()
}

/// The second chart with the first glued to it where vertices are paired, and the numbers of the first's vertices in it; none if
/// that is no disk.
fn glued(first: &Chart, second: &Chart, pairs: &[[u32; 2]]) -> Option<(Chart, Vec<u32>)> {
    let mut positions = second.positions.clone();
    let mut number = vec![u32::MAX; first.disk.n_vertices];
    for &[v, w] in pairs {
        number[v as usize] = w;
    }
    for (n, &p) in number.iter_mut().zip(&first.positions) {
        if *n == u32::MAX {
            *n = positions.len() as u32;
            positions.push(p);
        }
    }
    let mut triangles = second.disk.triangles.clone();
    let renumbered = |t: &[u32; 3]| t.map(|v| number[v as usize]);
    triangles.extend(first.disk.triangles.iter().map(renumbered));
    let chart = Chart {
        disk: Disk::new(positions.len(), triangles).ok()?,
        corners: [&*second.corners, &*first.corners].concat(),
        mirror: second.mirror,
        positions,
    };
    Some((chart, number))
}

//! A chart laid on another along a common border.

use super::border::Run;
use super::occupied::Ground;
use crate::charts::motion::Motion;
use crate::charts::{Chart, MappedChart};
use unwrapd_maps::embed::{self, Embedding};
use unwrapd_maps::mesh::Disk;

/// A chart moved to where it might be glued to another.
pub struct MovedChart {
    pub map: MappedChart,
    /// The common vertices: its own, and the other's.
    seam: Vec<[u32; 2]>,
}

impl MovedChart {
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
        let pairs = run.vertices.iter();
        let pairs = pairs.map(|&[v, w]| [from[v as usize], neighbor.embedding.uv[w as usize]]);
        let motion = Motion::fitting(&pairs.collect::<Vec<_>>());
        let mut uv: Vec<[f64; 2]> = from.iter().map(|&p| motion.moved(p)).collect();
        for &[v, w] in &run.vertices {
            uv[v as usize] = neighbor.embedding.uv[w as usize];
        }
        embed::is_positive(&chart.disk.triangles, &uv).then(|| Self {
            map: MappedChart {
                chart,
                embedding: Embedding {
                    uv,
                    summary: map.embedding.summary,
                },
                seconds: map.seconds,
            },
            seam: run.vertices.clone(),
        })
    }

    /// How many pairs of its faces and the neighbor's overlap, counted up to about this many.
    pub fn n_overlaps(&self, ground: &Ground, most: usize) -> usize {
        ground.n_overlaps(&self.map.chart.disk.triangles, &self.map.embedding.uv, most)
    }

    /// The neighbor, its map as it is, with the chart glued to it; none if that is no disk.
    pub fn glued(self, neighbor: &MappedChart) -> Option<MappedChart> {
        let (chart, number) = glued(&self.map.chart, &neighbor.chart, &self.seam)?;
        let mut uv = neighbor.embedding.uv.clone();
        uv.resize(chart.disk.n_vertices, [0.0; 2]);
        for (&n, &p) in number.iter().zip(&self.map.embedding.uv) {
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

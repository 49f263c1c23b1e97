//! A chart with fewer faces, on which slits are planned.

use crate::charts::Chart;
use crate::embed::simplified;

/// A chart with fewer faces.
pub struct Simplified {
    /// The chart; its corners are numbered in its own triangles.
    pub chart: Chart,
    /// For each corner of its triangles the vertex of the chart it was made from.
    vertex: Vec<u32>,
}

impl Simplified {
    /// A chart of about so many vertices, if that is fewer and its shape allows it.
    pub fn new(chart: &Chart, n_vertices: usize) -> Option<Self> {
        let (disk, vertices) = simplified(&chart.disk, &chart.positions, n_vertices)?;
        let corners = disk.triangles.as_flattened().iter();
        let position = |&v: &u32| chart.positions[v as usize];
        Some(Self {
            vertex: corners.map(|&v| vertices[v as usize]).collect(),
            chart: Chart {
                positions: vertices.iter().map(position).collect(),
                corners: (0..disk.triangles.len() as u32)
                    .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
                    .collect(),
                mirror: chart.mirror,
                disk,
            },
        })
    }

    /// The vertex of the chart at a corner.
    pub fn vertex(&self, corner: u32) -> u32 {
        self.vertex[corner as usize]
    }
}

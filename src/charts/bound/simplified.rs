//! A chart with fewer faces, on which slits are planned.

use crate::charts::Chart;
use crate::embed::simplified;
use crate::mesh::VertexFaces;
use std::collections::HashSet;

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

    /// For each of its triangles a face of the surface at one of its vertices, another one for each as far as there are.
    pub fn faces(&self, chart: &Chart) -> Vec<u32> {
        let around = VertexFaces::new(chart.positions.len(), &chart.disk.triangles);
        let mut taken = HashSet::new();
        let mut near = |vertices: &[u32; 3]| {
            let mut near = vertices.iter().flat_map(|&v| around.of(v));
            let first = near.clone().next().copied();
            near.find(|&&face| taken.insert(face)).copied().or(first)
        };
        let of_surface = |face: u32| chart.corners[face as usize][0] / 3;
        let triangles = self.vertex.as_chunks().0.iter();
        triangles
            .filter_map(|vertices| near(vertices).map(of_surface))
            .collect()
    }

    /// The vertex of the chart at a corner.
    pub fn vertex(&self, corner: u32) -> u32 {
        self.vertex[corner as usize]
    }
}

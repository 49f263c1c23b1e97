//! A chart with fewer faces, on which its seams are planned.

use crate::charts::{Chart, MappedChart, parted_along};
use std::collections::HashSet;
use unwrapd_maps::embed::Simplification;
use unwrapd_maps::mesh::{CUT, Surface, VertexFaces, next};

/// Distance that a seam of the simplification may move when it is drawn on the chart, in edges of the simplification. Not tuned.
const EDGES_OFF: usize = 2;

/// A chart with fewer faces.
pub struct Simplified {
    /// The chart; its corners are numbered in its own triangles.
    pub chart: Chart,
    simplification: Simplification,
}

impl Simplified {
    /// Least number of faces of a component whose seams are planned on a simplification. Not tuned.
    pub const LARGE: usize = 50_000;
    /// Number of vertices of that simplification. Not tuned.
    pub const VERTICES: usize = 10_000;

    /// Creates a chart of about `n_vertices` vertices; `None` if that is not fewer, or its shape does not allow it.
    pub fn new(chart: &Chart, n_vertices: usize) -> Option<Self> {
        let simplification = Simplification::new(&chart.disk, &chart.positions, n_vertices)?;
        let disk = simplification.disk.clone();
        let vertices = simplification.vertices.iter();
        Some(Self {
            chart: Chart {
                positions: vertices.map(|&v| chart.positions[v as usize]).collect(),
                corners: (0..disk.triangles.len() as u32)
                    .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
                    .collect(),
                mirror: chart.mirror,
                disk,
            },
            simplification,
        })
    }

    /// Returns for each of its triangles a face of the surface at one of its vertices, another one for each as far as there are.
    pub fn faces(&self, chart: &Chart) -> Vec<u32> {
        let around = VertexFaces::new(chart.positions.len(), &chart.disk.triangles);
        let mut taken = HashSet::new();
        let of_chart = |v: u32| self.simplification.vertices[v as usize];
        let mut near = |vertices: &[u32; 3]| {
            let mut near = vertices.iter().flat_map(|&v| around.of(of_chart(v)));
            let first = near.clone().next().copied();
            near.find(|&&face| taken.insert(face)).copied().or(first)
        };
        let of_surface = |face: u32| chart.corners[face as usize][0] / 3;
        let triangles = self.chart.disk.triangles.iter();
        triangles
            .filter_map(|vertices| near(vertices).map(of_surface))
            .collect()
    }

    /// Returns the chart as a surface, cut where the chart ends; `None` if a triangle has two corners in one place.
    pub fn surface(&self) -> Option<Surface> {
        let disk = &self.chart.disk;
        let mut surface = Surface::new(&self.chart.positions, &disk.triangles).ok()?;
        let twin = disk.twins();
        surface.cut_along(|h, t| twin[h as usize] != t);
        (surface.triangles.len() == disk.triangles.len()).then_some(surface)
    }

    /// Divides the chart that this is a simplification of like the simplification, along the cheapest paths near its seams.
    pub fn parts_as(&self, chart: &Chart, charts: &[MappedChart]) -> Vec<Chart> {
        let edges = self.carried_back(charts.iter().map(|map| &map.chart));
        let share = chart.positions.len() as f64 / self.chart.positions.len() as f64;
        let an_edge = share.sqrt().ceil() as usize;
        parted_along(chart, |edge| edges.contains(&edge), EDGES_OFF * an_edge)
    }

    /// Returns the edges of the chart that this is a simplification of, each as its two vertices in ascending order, at which that is cut
    /// like this.
    fn carried_back<'a>(&self, parts: impl Iterator<Item = &'a Chart>) -> HashSet<[u32; 2]> {
        let twin = self.chart.disk.twins();
        let mut is_glued = vec![false; twin.len()];
        for part in parts {
            for (h, _) in (0..).zip(part.disk.twins()).filter(|&(_, t)| t != CUT) {
                is_glued[part.surface_halfedge(h) as usize] = true;
            }
        }
        let vertex = |h: u32| self.chart.disk.triangles[h as usize / 3][h as usize % 3];
        let seams: Vec<[u32; 2]> = (0u32..)
            .zip(&twin)
            .filter(|&(h, &t)| t != CUT && h < t && !is_glued[h as usize])
            .map(|(h, _)| [h, next(h)].map(vertex))
            .collect();
        self.simplification.carried_back(&seams)
    }
}

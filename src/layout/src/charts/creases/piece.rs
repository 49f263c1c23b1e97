//! Charts that hang together as one rigid piece.

use super::contact::Edge;
use crate::charts::give_back::occupied::Ground;
use crate::charts::mapped::MappedChart;
use std::sync::Arc;
use unwrapd_maps::mesh::{CUT, CornerUvs, next};

/// Charts that hang together.
#[derive(Clone, Default)]
pub struct Piece {
    pub charts: Vec<u32>,
    pub outline: Vec<Edge>,
    /// Its faces; each has at least twice as many as the next.
    grounds: Vec<Arc<Ground>>,
    pub area: f64,
    pub n_faces: usize,
    /// How often pieces were joined to it or it to others.
    pub n_joins: u32,
}

impl Piece {
    /// A chart, with vertices counted from `first_vertex`.
    pub fn new(number: u32, map: &MappedChart, first_vertex: u32) -> Self {
        let faces = faces_of(map, &map.embedding.uv, false);
        Self {
            charts: vec![number],
            outline: outline(map, first_vertex),
            area: map.area(),
            n_faces: faces.len(),
            grounds: vec![Arc::new(Ground::of(faces))],
            n_joins: 0,
        }
    }

    /// Returns whether a face overlaps the piece. Adds the number of compared pairs to `work`.
    pub fn meets(&self, faces: &[CornerUvs], work: &mut u64) -> bool {
        let mut grounds = self.grounds.iter();
        grounds.any(|ground| ground.meets(faces, work))
    }

    /// Takes in a piece whose faces now lie beside its own, joined at these edges of both outlines.
    pub fn take(&mut self, mut other: Self, faces: Vec<CornerUvs>, common: &[[Edge; 2]]) {
        let mut inner: Vec<u32> = common.iter().flatten().map(|edge| edge.halfedge).collect();
        inner.sort_unstable();
        self.charts.append(&mut other.charts);
        self.outline.append(&mut other.outline);
        self.outline
            .retain(|edge| inner.binary_search(&edge.halfedge).is_err());
        self.area += other.area;
        self.n_faces += faces.len();
        self.n_joins = self.n_joins.max(other.n_joins) + 1;
        self.add(Ground::of(faces));
    }

    fn add(&mut self, ground: Ground) {
        self.grounds.push(Arc::new(ground));
        while let [.., before, last] = &*self.grounds
            && before.len() < 2 * last.len()
            && let (Some(last), Some(before)) = (self.grounds.pop(), self.grounds.pop())
        {
            self.grounds.push(Arc::new(before.and(&last)));
        }
    }
}

/// The faces of a chart, counter-clockwise also where it is seen from behind.
pub fn faces_of(map: &MappedChart, places: &[[f64; 2]], is_turned: bool) -> Vec<CornerUvs> {
    let corners = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|v| places[v as usize]);
        if is_turned { [a, c, b] } else { [a, b, c] }
    };
    map.chart.disk.triangles.iter().map(corners).collect()
}

/// The boundary of a chart, with vertices counted from `first`.
fn outline(map: &MappedChart, first: u32) -> Vec<Edge> {
    let chart = &map.chart;
    let corner = |h: u32| (h as usize / 3, h as usize % 3);
    (0u32..)
        .zip(chart.disk.twins())
        .filter(|&(_, t)| t == CUT)
        .map(|(h, _)| {
            let [here, there] = [h, next(h)].map(corner);
            Edge {
                halfedge: chart.surface_halfedge(h),
                ends: [here, there].map(|(face, c)| first + chart.disk.triangles[face][c]),
            }
        })
        .collect()
}

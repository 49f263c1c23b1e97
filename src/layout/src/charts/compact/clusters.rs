//! The faces of a map in small clusters.

use super::planes::Planes;
use std::collections::BTreeMap;
use unwrapd_maps::cut::Sheet;
use unwrapd_maps::mesh::{CUT, UnionFind};
use unwrapd_method::numerics::support::{Directions, Support};
use unwrapd_method::numerics::vec2::doubled_area;

/// Cells along the square root of a map's area; faces of one cell that hang together make a cluster.
const CELLS: f64 = 48.0;

/// The cost of a seam over its length below which it runs on a crease.
const CREASE: f64 = 0.9;

/// Connected faces that lie close together in the plane: what is cut off a map is decided on them, and on faces only where
/// exactly the seam runs.
pub struct Clusters {
    /// For each face its cluster.
    pub of_face: Vec<u32>,
    /// For each cluster the area it covers, the mean of its faces' centers, and its extent.
    pub area: Vec<f64>,
    pub centre: Vec<[f64; 2]>,
    pub support: Vec<Support>,
    /// For each cluster those it touches, and the length of their common border on the surface,
    /// which counts several times where it crosses a plane.
    pub neighbors: Vec<Vec<(u32, f64)>>,
}

impl Clusters {
    /// The clusters of a sheet with vertices at `uv`; `cost` is that of a seam along each halfedge.
    /// Between planes clusters end at creases. A plane that is not to be cut is in one cluster.
    pub fn new(sheet: &Sheet, uv: &[[f64; 2]], cost: &[f64], planes: Planes) -> Self {
        let corners =
            |f: usize| [3 * f, 3 * f + 1, 3 * f + 2].map(|c| uv[sheet.vertex[c] as usize]);
        let n_faces = sheet.triangles.len();
        let area: Vec<f64> = (0..n_faces)
            .map(|f| {
                let [a, b, c] = corners(f);
                doubled_area(a, b, c) / 2.0
            })
            .collect();
        let cell = area.iter().sum::<f64>().max(f64::MIN_POSITIVE).sqrt() / CELLS;
        let places = (0..n_faces).map(|f| centre(corners(f)).map(|x| (x / cell).floor() as i64));
        let places: Vec<[i64; 2]> = places.collect();
        let has_planes = (0u32..).zip(cost).any(|(h, &cost)| cost > sheet.length(h));
        let is_crease = |h: u32| has_planes && cost[h as usize] < CREASE * sheet.length(h);
        let mut sets = UnionFind::new(n_faces);
        for (h, &t) in (0u32..).zip(&sheet.twin).filter(|(_, t)| **t != CUT) {
            let is_near = !is_crease(h) && places[h as usize / 3] == places[t as usize / 3];
            if is_near || planes.keep(cost[h as usize], sheet.length(h)) {
                sets.unite(h / 3, t / 3);
            }
        }
        let (of_face, n) = sets.labels();
        let mut clusters = Self {
            area: vec![0.0; n],
            centre: vec![[0.0; 2]; n],
            support: vec![Support::EMPTY; n],
            neighbors: neighbors(sheet, &of_face, n, cost),
            of_face,
        };
        clusters.measure(&area, corners);
        clusters
    }

    fn measure(&mut self, area: &[f64], corners: impl Fn(usize) -> [[f64; 2]; 3]) {
        let directions = Directions::default();
        let mut count = vec![0.0; self.area.len()];
        for (f, &c) in self.of_face.iter().enumerate() {
            let c = c as usize;
            self.area[c] += area[f];
            count[c] += 1.0;
            let middle = centre(corners(f));
            self.centre[c] = [0, 1].map(|k| self.centre[c][k] + middle[k]);
            for p in corners(f) {
                self.support[c].add(p, &directions);
            }
        }
        for (centre, n) in self.centre.iter_mut().zip(count) {
            *centre = centre.map(|x| x / n);
        }
    }
}

fn centre(corners: [[f64; 2]; 3]) -> [f64; 2] {
    [0, 1].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0)
}

fn neighbors(sheet: &Sheet, of_face: &[u32], n: usize, cost: &[f64]) -> Vec<Vec<(u32, f64)>> {
    let mut borders: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    for (h, &t) in (0u32..).zip(&sheet.twin).filter(|(_, t)| **t != CUT) {
        let (a, b) = (of_face[h as usize / 3], of_face[t as usize / 3]);
        if a != b {
            let h = h.min(t);
            *borders.entry((a, b)).or_default() += cost[h as usize].max(sheet.length(h));
        }
    }
    let mut neighbors = vec![Vec::new(); n];
    for ((a, b), length) in borders {
        neighbors[a as usize].push((b, length));
    }
    neighbors
}

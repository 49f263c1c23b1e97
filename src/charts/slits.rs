//! Slits cut into a chart where it would be distorted most.

use super::Chart;
use super::crease::edge_costs;
use super::part::{parts, twins};
use super::predictor::Predictor;
use crate::cut::{Neighbors, Sheet, distances_until};
use crate::mesh::CUT;
use crate::numerics::vec3::distance;

/// A chart and the slits that are planned in it.
pub struct Slits {
    chart: Chart,
    sheet: Sheet,
    neighbors: Neighbors,
    /// For each halfedge what a seam along it costs.
    cost: Vec<f64>,
    predictor: Predictor,
    /// For each vertex the loop of the boundary that it lies on, or whose slits it lies on; that with most edges is 0.
    seam: Vec<Option<u32>>,
    log_scale: Vec<f64>,
    /// Halfedges along the slits.
    edges: Vec<u32>,
    /// What the predictor says of the chart with these slits, see [`Predictor::excess`].
    pub excess: f64,
    /// The chart's area.
    pub area: f64,
}

/// Vertices for which one more slit may be planned at once, far from the goal: with a large chart a factorization costs more than
/// a slit that is a little less well chosen.
const VERTICES_PER_SLIT: usize = 5_000;

impl Slits {
    /// No slit yet.
    pub fn new(chart: Chart) -> Self {
        let twin = twins(&chart.disk);
        let label = vec![0; chart.disk.triangles.len()];
        let mesh = (&*chart.disk.triangles, &*chart.positions);
        let sheet = Sheet::divide(mesh, &twin, &label, 1).swap_remove(0);
        let neighbors = Neighbors::new(&sheet);
        let mut predictor = Predictor::new(&sheet.positions, sheet.vertex.as_chunks().0);
        let seam = boundary_loops(&chart, &sheet);
        let log_scale = predictor.log_scale(&are_some(&seam));
        Self {
            excess: predictor.excess(&log_scale),
            area: predictor.area(),
            cost: edge_costs(&sheet),
            edges: Vec::new(),
            chart,
            sheet,
            neighbors,
            predictor,
            seam,
            log_scale,
        }
    }

    /// Slits the chart from the nearest seam to the vertex whose scale differs most from that of the boundary, or else from a
    /// hole; false if there is neither. With `is_far` also to the next such vertices, as long as they lie farther from the
    /// slits that are new than these are long. One factorization.
    pub fn cut(&mut self, is_far: bool) -> bool {
        let most = if is_far {
            1 + self.seam.len() / VERTICES_PER_SLIT
        } else {
            1
        };
        // The tips of the slits and their lengths.
        let mut new: Vec<([f64; 3], f64)> = Vec::new();
        while new.len() < most {
            let Some(tip) = self.worst_vertex(&new) else {
                break;
            };
            let Some((length, hole)) = self.slit([tip], None) else {
                break;
            };
            self.slit_from(hole);
            new.push((self.sheet.positions[tip as usize], length));
        }
        if new.is_empty() && (self.is_cut() || !self.slit_from_largest_hole()) {
            return false;
        }
        self.log_scale = self.predictor.log_scale(&are_some(&self.seam));
        self.excess = self.predictor.excess(&self.log_scale);
        true
    }

    /// The vertex off the seams whose scale is farthest from 1, not near the new slits.
    fn worst_vertex(&self, new: &[([f64; 3], f64)]) -> Option<u32> {
        let position = |v: u32| self.sheet.positions[v as usize];
        let is_near = |v: u32| {
            new.iter()
                .any(|&(tip, length)| distance(position(v), tip) < length)
        };
        (0u32..)
            .zip(&self.log_scale)
            .filter(|&(v, &u)| u != 0.0 && self.seam[v as usize].is_none() && !is_near(v))
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()).then(b.0.cmp(&a.0)))
            .map(|(v, _)| v)
    }

    /// Plans the cheapest slit from the hole with most edges to another seam; false if there is no hole.
    ///
    /// The predictor lets holes be as they are. A tube has no curvature, so it sees nothing to slit there, and yet the map that
    /// leaves the tube whole is a ring.
    fn slit_from_largest_hole(&mut self) -> bool {
        let holes = 1..self.chart.disk.loops.len() as u32;
        let has_edges = |hole: &u32| self.chart.disk.loops[*hole as usize].len();
        let hole = holes.rev().max_by_key(has_edges);
        hole.is_some_and(|hole| self.slit_from(hole))
    }

    /// Plans slits on from a hole until it hangs together with the outer boundary; false if there is nothing to do.
    ///
    /// A hole alone leaves the surface around it as it is. One with slits to it opens, and the surface wrapped around it could be
    /// laid into the plane only as a ring.
    fn slit_from(&mut self, hole: u32) -> bool {
        let mut seam = hole;
        while seam != 0 {
            let of_seam = |(v, s): (u32, &Option<u32>)| (*s == Some(seam)).then_some(v);
            let from: Vec<u32> = (0..).zip(&self.seam).filter_map(of_seam).collect();
            let Some((_, reached)) = self.slit(from, Some(seam)) else {
                break;
            };
            for of_vertex in self.seam.iter_mut().filter(|s| **s == Some(seam)) {
                *of_vertex = Some(reached);
            }
            seam = reached;
        }
        seam != hole
    }

    /// Plans the cheapest slit from some vertices to a seam other than their own: its length and the seam it belongs to from now on.
    fn slit(
        &mut self,
        from: impl IntoIterator<Item = u32>,
        own: Option<u32>,
    ) -> Option<(f64, u32)> {
        let (distances, end) = distances_until(
            &self.sheet,
            &self.neighbors,
            from,
            |h| self.cost[h as usize],
            |v| self.seam[v as usize].is_some_and(|seam| Some(seam) != own),
        );
        let reached = self.seam[end? as usize];
        let path: Vec<u32> = distances.path(&self.sheet, end?).collect();
        for &h in &path {
            for v in self.sheet.ends(h) {
                self.seam[v as usize] = reached;
            }
        }
        let length = path.iter().map(|&h| self.sheet.length(h)).sum();
        self.edges.extend(path);
        Some((length, reached?))
    }

    /// Whether a slit is planned.
    pub fn is_cut(&self) -> bool {
        !self.edges.is_empty()
    }

    /// The chart with the slits opened.
    pub fn opened(&self) -> Vec<Chart> {
        let mut twin = twins(&self.chart.disk);
        for &h in &self.edges {
            let t = std::mem::replace(&mut twin[h as usize], CUT);
            twin[t as usize] = CUT;
        }
        let parts = parts(&self.chart, &twin);
        parts.into_iter().map(|(part, _)| part).collect()
    }
}

/// For each vertex of a chart's sheet the loop of the boundary that it lies on.
fn boundary_loops(chart: &Chart, sheet: &Sheet) -> Vec<Option<u32>> {
    let mut of_chart = vec![None; chart.disk.n_vertices];
    for (number, boundary) in (0..).zip(&chart.disk.loops) {
        for &v in boundary {
            of_chart[v as usize] = Some(number);
        }
    }
    let mut of_sheet = vec![None; sheet.positions.len()];
    let corners = chart.disk.triangles.as_flattened();
    for (&v, &numbered_anew) in corners.iter().zip(&sheet.vertex) {
        of_sheet[numbered_anew as usize] = of_chart[v as usize];
    }
    of_sheet
}

fn are_some<T>(values: &[Option<T>]) -> Vec<bool> {
    values.iter().map(Option::is_some).collect()
}

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
    /// For each vertex whether it lies on the boundary or on a slit.
    on_seam: Vec<bool>,
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
        let on_seam = sheet.on_boundary();
        let log_scale = predictor.log_scale(&on_seam);
        Self {
            excess: predictor.excess(&log_scale),
            area: predictor.area(),
            cost: edge_costs(&sheet),
            edges: Vec::new(),
            chart,
            sheet,
            neighbors,
            predictor,
            on_seam,
            log_scale,
        }
    }

    /// Slits the chart from the nearest seam to the vertex whose scale differs most from that of the boundary, or else from a
    /// hole; false if there is neither. With `is_far` also to the next such vertices, as long as they lie farther from the
    /// slits that are new than these are long. One factorization.
    pub fn cut(&mut self, is_far: bool) -> bool {
        let most = if is_far {
            1 + self.on_seam.len() / VERTICES_PER_SLIT
        } else {
            1
        };
        // The tips of the slits and their lengths.
        let mut new: Vec<([f64; 3], f64)> = Vec::new();
        while new.len() < most {
            let Some(tip) = self.worst_vertex(&new) else {
                break;
            };
            let Some(length) = self.slit([tip], |_| false) else {
                break;
            };
            new.push((self.sheet.positions[tip as usize], length));
        }
        if new.is_empty() && (self.is_cut() || !self.slit_from_hole()) {
            return false;
        }
        self.log_scale = self.predictor.log_scale(&self.on_seam);
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
            .filter(|&(v, &u)| u != 0.0 && !self.on_seam[v as usize] && !is_near(v))
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()).then(b.0.cmp(&a.0)))
            .map(|(v, _)| v)
    }

    /// Plans the cheapest slit from the hole with most edges to another loop; false if there is no hole.
    ///
    /// The predictor lets holes be as they are. A tube has no curvature, so it sees nothing to slit there, and yet the map that
    /// leaves the tube whole is a ring.
    fn slit_from_hole(&mut self) -> bool {
        let holes = self.chart.disk.loops.iter().skip(1);
        let Some(hole) = holes.max_by_key(|hole| hole.len()) else {
            return false;
        };
        let mut is_of_chart = vec![false; self.chart.disk.n_vertices];
        for &v in hole {
            is_of_chart[v as usize] = true;
        }
        let mut is_of_hole = vec![false; self.on_seam.len()];
        let of_chart = self.chart.disk.triangles.as_flattened();
        for (&v, &of_sheet) in of_chart.iter().zip(&self.sheet.vertex) {
            is_of_hole[of_sheet as usize] = is_of_chart[v as usize];
        }
        let rim = (0u32..)
            .zip(&is_of_hole)
            .filter_map(|(v, is)| is.then_some(v));
        self.slit(rim, |v| is_of_hole[v as usize]).is_some()
    }

    /// Plans the cheapest slit from some vertices to a seam that has none of the vertices with `is_from`; its length.
    fn slit(
        &mut self,
        from: impl IntoIterator<Item = u32>,
        is_from: impl Fn(u32) -> bool,
    ) -> Option<f64> {
        let (distances, end) = distances_until(
            &self.sheet,
            &self.neighbors,
            from,
            |h| self.cost[h as usize],
            |v| self.on_seam[v as usize] && !is_from(v),
        );
        let path: Vec<u32> = distances.path(&self.sheet, end?).collect();
        for &h in &path {
            for v in self.sheet.ends(h) {
                self.on_seam[v as usize] = true;
            }
        }
        let length = path.iter().map(|&h| self.sheet.length(h)).sum();
        self.edges.extend(path);
        Some(length)
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

//! Slits cut into a chart from its boundary.

use crate::charts::Chart;
use crate::charts::crease::edge_costs;
use crate::charts::parts::parts;
use crate::cut::{Neighbors, Sheet, distances_until};
use crate::mesh::CUT;

/// A chart and the slits that are planned in it.
pub struct Slits {
    chart: Chart,
    sheet: Sheet,
    neighbors: Neighbors,
    /// For each halfedge what a seam along it costs.
    cost: Vec<f64>,
    /// For each vertex of the sheet the loop of the boundary that it lies on, or whose slits it lies on; that with most edges is 0.
    seam: Vec<Option<u32>>,
    /// Where slits were begun, in their order: a vertex inside, or one of a hole.
    tips: Vec<u32>,
    /// Halfedges along the slits.
    edges: Vec<u32>,
}

impl Slits {
    /// No slit yet.
    pub fn new(chart: Chart) -> Self {
        let twin = chart.disk.twins();
        let label = vec![0; chart.disk.triangles.len()];
        let mesh = (&*chart.disk.triangles, &*chart.positions);
        let sheet = Sheet::divide(mesh, &twin, &label, 1).swap_remove(0);
        Self {
            neighbors: Neighbors::new(&sheet),
            cost: edge_costs(&sheet),
            seam: boundary_loops(&chart, &sheet),
            tips: Vec::new(),
            edges: Vec::new(),
            chart,
            sheet,
        }
    }

    /// Slits from some vertices of the chart, one after the other.
    pub fn from_tips(chart: Chart, tips: &[u32]) -> Self {
        let mut slits = Self::new(chart);
        let mut in_sheet = vec![0; slits.chart.disk.n_vertices];
        let corners = slits.chart.disk.triangles.as_flattened();
        for (&v, &numbered_anew) in corners.iter().zip(&slits.sheet.vertex) {
            in_sheet[v as usize] = numbered_anew;
        }
        for &tip in tips {
            let tip = in_sheet[tip as usize];
            if let Some(hole) = slits.seam[tip as usize] {
                slits.slit_from(hole);
            } else {
                slits.slit_to(tip);
            }
        }
        slits
    }

    /// The chart without them.
    pub fn chart(&self) -> &Chart {
        &self.chart
    }

    /// For each slit a corner of the surface where it was begun.
    pub fn tips(&self) -> impl Iterator<Item = u32> {
        let corners = self.chart.corners.as_flattened();
        let first = |tip: &u32| self.sheet.vertex.iter().position(|v| v == tip);
        let first = self.tips.iter().filter_map(first);
        first.map(|corner| corners[corner])
    }

    /// The chart's triangles, in vertices numbered anew, and the positions of these.
    pub fn mesh(&self) -> (&[[u32; 3]], &[[f64; 3]]) {
        (self.sheet.vertex.as_chunks().0, &self.sheet.positions)
    }

    /// For each vertex of [`mesh`](Self::mesh) whether it lies on the boundary or a slit.
    pub fn is_seam(&self) -> Vec<bool> {
        self.seam.iter().map(Option::is_some).collect()
    }

    /// Plans the cheapest slit from the nearest seam to a vertex inside: its length; none if there is no seam.
    ///
    /// A hole that it starts at is slit on from.
    pub fn slit_to(&mut self, tip: u32) -> Option<f64> {
        let (length, hole) = self.slit([tip], None)?;
        self.tips.push(tip);
        self.open(hole);
        Some(length)
    }

    /// Plans the cheapest slit from the hole with most edges to another seam; false if there is no hole.
    ///
    /// The predictor lets holes be as they are. A tube has no curvature, so it sees nothing to slit there, and yet the map that
    /// leaves the tube whole is a ring.
    pub fn slit_from_largest_hole(&mut self) -> bool {
        let holes = 1..self.chart.disk.loops.len() as u32;
        let has_edges = |hole: &u32| self.chart.disk.loops[*hole as usize].len();
        let hole = holes.rev().max_by_key(has_edges);
        hole.is_some_and(|hole| self.slit_from(hole))
    }

    /// The same from this hole; false if there is nothing to do.
    fn slit_from(&mut self, hole: u32) -> bool {
        let of_hole = |seam: &Option<u32>| *seam == Some(hole);
        let tip = self.seam.iter().position(of_hole);
        let is_new = self.open(hole);
        if is_new {
            self.tips.extend(tip.map(|v| v as u32));
        }
        is_new
    }

    /// Plans slits on from a hole until it hangs together with the outer boundary; false if there is nothing to do.
    ///
    /// A hole alone leaves the surface around it as it is. One with slits to it opens, and the surface wrapped around it could be
    /// laid into the plane only as a ring.
    fn open(&mut self, hole: u32) -> bool {
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
        let mut twin = self.chart.disk.twins();
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

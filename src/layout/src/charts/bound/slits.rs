//! Slits cut into a chart from its boundary.

use crate::charts::Chart;
use crate::charts::crease::edge_costs;
use crate::charts::parts::parts;
use crate::charts::symmetry::sheet_mirror::SheetMirror;
use crate::charts::symmetry::way::Way;
use unwrapd_maps::cut::{Neighbors, Sheet};
use unwrapd_maps::mesh::CUT;

/// A chart and the slits that are planned in it.
pub struct Slits {
    chart: Chart,
    pub(super) sheet: Sheet,
    pub(super) neighbors: Neighbors,
    /// For each halfedge what a seam along it costs.
    pub(super) cost: Vec<f64>,
    /// For each vertex of the sheet the loop of the boundary that it lies on, or whose slits it lies on; that with most edges is 0.
    pub(super) seam: Vec<Option<u32>>,
    /// Halfedges along the slits.
    edges: Vec<u32>,
    /// Their vertices, each from the seam that it was drawn to.
    pub(super) lines: Vec<Vec<[f64; 3]>>,
    /// The plane in which the chart is its own mirror image.
    pub(super) mirror: Option<SheetMirror>,
}

impl Slits {
    /// No slit yet.
    pub fn new(chart: Chart) -> Self {
        let sheet = Sheet::of_disk(&chart.disk, &chart.positions);
        Self {
            mirror: (chart.mirror.as_ref()).and_then(|plane| SheetMirror::of(&sheet, plane)),
            neighbors: Neighbors::new(&sheet),
            cost: edge_costs(&sheet),
            seam: boundary_loops(&chart, &sheet),
            edges: Vec::new(),
            lines: Vec::new(),
            chart,
            sheet,
        }
    }

    /// The chart without them.
    pub fn chart(&self) -> &Chart {
        &self.chart
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
    /// A hole that it starts at is slit on from. A chart that is its own mirror image is slit alike on the other side.
    pub fn slit_to(&mut self, tip: u32) -> Option<f64> {
        if let Some(mirror) = self.mirror {
            return self.slit_alike(tip, &mirror);
        }
        let way = self.way([tip], None, |h| self.cost[h as usize])?;
        self.draw(&way);
        Some(way.length(&self.sheet))
    }

    /// Plans the cheapest slit from the hole with most edges to another seam; false if there is no hole.
    ///
    /// The predictor lets holes be as they are. A tube has no curvature, so it sees nothing to slit there, and yet the map that
    /// leaves the tube whole is a ring.
    pub fn slit_from_largest_hole(&mut self) -> bool {
        let holes = 1..self.chart.disk.loops.len() as u32;
        let has_edges = |hole: &u32| self.chart.disk.loops[*hole as usize].len();
        let hole = holes.rev().max_by_key(has_edges);
        hole.is_some_and(|hole| self.open(hole))
    }

    /// Plans slits on from a hole until it hangs together with the outer boundary; false if there is nothing to do.
    ///
    /// A hole alone leaves the surface around it as it is. One with slits to it opens, and the surface wrapped around it could be
    /// laid into the plane only as a ring.
    pub(super) fn open(&mut self, hole: u32) -> bool {
        if hole == 0 {
            return false;
        }
        let way = match self.mirror {
            Some(mirror) => self.way_from_hole(hole, &mirror),
            None => self.way(self.of_seam(hole), Some(hole), |h| self.cost[h as usize]),
        };
        let Some(way) = way else {
            return false;
        };
        self.draw(&way);
        if let Some(mirror) = self.mirror {
            self.draw_image_of_hole(&way, &mirror);
        }
        true
    }

    /// The vertices of a seam.
    pub(super) fn of_seam(&self, seam: u32) -> Vec<u32> {
        let of_seam = |(v, s): (u32, &Option<u32>)| (*s == Some(seam)).then_some(v);
        (0..).zip(&self.seam).filter_map(of_seam).collect()
    }

    /// The cheapest way from some vertices to a seam other than their own.
    pub(super) fn way(
        &self,
        from: impl IntoIterator<Item = u32>,
        own: Option<u32>,
        cost: impl Fn(u32) -> f64,
    ) -> Option<Way> {
        let is_goal = |v: u32| self.seam[v as usize].is_some_and(|seam| Some(seam) != own);
        Way::cheapest(&self.sheet, &self.neighbors, from, cost, is_goal)
    }

    /// Plans a slit along a way to a seam. What seam the way began at belongs to that from now on, and if it is a hole it is slit on
    /// from.
    pub(super) fn draw(&mut self, way: &Way) {
        let own = self.seam[way.start() as usize];
        let reached = self.seam[way.end() as usize];
        for v in own.map_or(Vec::new(), |own| self.of_seam(own)) {
            self.seam[v as usize] = reached;
        }
        for &v in &way.vertices {
            self.seam[v as usize] = reached;
        }
        self.edges.extend(&way.edges);
        self.lines.push(way.positions(&self.sheet));
        self.open(reached.unwrap_or(0));
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
            // Slits may share edges.
            if t != CUT {
                twin[t as usize] = CUT;
            }
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

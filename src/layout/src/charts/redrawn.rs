//! Seams that were planned on a simplified chart drawn on the chart itself.

use crate::charts::Chart;
use crate::charts::crease::edge_costs;
use crate::charts::parts::parts;
use crate::charts::symmetry::way::Way;
use std::collections::HashSet;
use unwrapd_maps::cut::{Neighbors, Sheet, opposite_end};
use unwrapd_maps::mesh::{CUT, next};

/// The charts into which seams part a chart once they are drawn anew: from each end or meeting to the next along the cheapest way at
/// most so many edges off. Seams without either stay. `is_seam` is asked of the two vertices of an edge, in ascending order.
///
/// Two charts that meet along one line are a disk together, and whatever line with the same ends parts that, it leaves two disks. So
/// lines may move freely as long as they touch no other.
pub fn parted_along(
    chart: &Chart,
    is_seam: impl Fn([u32; 2]) -> bool,
    most_off: usize,
) -> Vec<Chart> {
    let mut drawing = Drawing::new(chart, is_seam);
    for line in drawing.lines() {
        drawing.redraw(&line, most_off);
    }
    let mut twin = drawing.sheet.twin;
    for (glued, is_cut) in twin.iter_mut().zip(drawing.is_cut) {
        if is_cut {
            *glued = CUT;
        }
    }
    let parts = parts(chart, &twin);
    parts.into_iter().map(|(part, _)| part).collect()
}

/// Seams in a chart.
struct Drawing {
    sheet: Sheet,
    neighbors: Neighbors,
    /// For each halfedge what a seam along it costs, and whether there is one.
    cost: Vec<f64>,
    is_cut: Vec<bool>,
    /// For each vertex whether it lies on the boundary.
    is_on_boundary: Vec<bool>,
    /// For each vertex how many seams it has.
    n_at: Vec<u32>,
}

/// Edges that follow each other, and their vertices.
struct EdgeChain {
    edges: Vec<u32>,
    vertices: Vec<u32>,
}

impl Drawing {
    fn new(chart: &Chart, is_seam: impl Fn([u32; 2]) -> bool) -> Self {
        let sheet = Sheet::of_disk(&chart.disk, &chart.positions);
        let vertex = |h: u32| chart.disk.triangles[h as usize / 3][h as usize % 3];
        let mut drawing = Self {
            neighbors: Neighbors::new(&sheet),
            cost: edge_costs(&sheet),
            is_cut: vec![false; sheet.twin.len()],
            is_on_boundary: sheet.on_boundary(),
            n_at: vec![0; sheet.positions.len()],
            sheet,
        };
        let inner: Vec<u32> = (drawing.sheet.edges())
            .filter(|&h| drawing.sheet.twin[h as usize] != CUT)
            .collect();
        for h in inner {
            let [a, b] = [h, next(h)].map(vertex);
            if is_seam([a.min(b), a.max(b)]) {
                drawing.mark(h, true);
            }
        }
        drawing
    }

    /// Makes an edge a seam, or no longer one.
    fn mark(&mut self, h: u32, is_cut: bool) {
        self.is_cut[h as usize] = is_cut;
        self.is_cut[self.sheet.twin[h as usize] as usize] = is_cut;
        for v in self.sheet.ends(h) {
            if is_cut {
                self.n_at[v as usize] += 1;
            } else {
                self.n_at[v as usize] -= 1;
            }
        }
    }

    /// Whether seams end or meet at a vertex.
    fn is_end(&self, v: u32) -> bool {
        let n = self.n_at[v as usize];
        n > 0 && (n != 2 || self.is_on_boundary[v as usize])
    }

    /// The lines from end to end. Closed ones without any are left out.
    fn lines(&self) -> Vec<EdgeChain> {
        let mut is_done = vec![false; self.is_cut.len()];
        let mut lines = Vec::new();
        for end in (0..self.n_at.len() as u32).filter(|&v| self.is_end(v)) {
            for &h in self.seams_at(end) {
                if !is_done[h as usize] {
                    let line = self.line(end, h);
                    for &h in &line.edges {
                        is_done[h as usize] = true;
                    }
                    lines.push(line);
                }
            }
        }
        lines
    }

    fn seams_at(&self, v: u32) -> impl Iterator<Item = &u32> {
        let edges = self.neighbors.of(v).iter();
        edges.filter(|&&h| self.is_cut[h as usize])
    }

    /// The line that begins at an end with an edge.
    fn line(&self, end: u32, first: u32) -> EdgeChain {
        let mut line = EdgeChain {
            edges: vec![first],
            vertices: vec![end, opposite_end(&self.sheet, first, end)],
        };
        let (mut h, mut v) = (first, line.vertices[1]);
        while !self.is_end(v) {
            let Some(&other) = self.seams_at(v).find(|&&other| other != h) else {
                break;
            };
            (h, v) = (other, opposite_end(&self.sheet, other, v));
            line.edges.push(h);
            line.vertices.push(v);
        }
        line
    }

    /// Moves a line to the cheapest way between its ends.
    fn redraw(&mut self, line: &EdgeChain, most_off: usize) {
        let (first, last) = (line.vertices[0], line.vertices[line.vertices.len() - 1]);
        if first == last {
            return;
        }
        for &h in &line.edges {
            self.mark(h, false);
        }
        let near = self.near(line, most_off);
        let cost = |h: u32| {
            let is_free = !self.is_cut[h as usize] && self.sheet.twin[h as usize] != CUT;
            if is_free && self.sheet.ends(h).iter().all(|v| near.contains(v)) {
                self.cost[h as usize]
            } else {
                f64::INFINITY
            }
        };
        let way = Way::cheapest(&self.sheet, &self.neighbors, [first], cost, |v| v == last);
        let edges = way.map_or(line.edges.clone(), |way| way.edges);
        for h in edges {
            self.mark(h, true);
        }
    }

    /// The vertices at most so many edges off a line that no other seam and no boundary touches, and its ends.
    fn near(&self, line: &EdgeChain, most_off: usize) -> HashSet<u32> {
        let is_free = |v: u32| self.n_at[v as usize] == 0 && !self.is_on_boundary[v as usize];
        let mut near: HashSet<u32> = line.vertices.iter().copied().collect();
        let mut front = line.vertices[1..line.vertices.len() - 1].to_vec();
        for _ in 0..most_off {
            let around = front.iter().flat_map(|&v| {
                let edges = self.neighbors.of(v).iter();
                edges.map(move |&h| opposite_end(&self.sheet, h, v))
            });
            let next: Vec<u32> = around.filter(|&v| is_free(v) && near.insert(v)).collect();
            front = next;
        }
        near
    }
}

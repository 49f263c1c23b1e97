//! Where the charts of a surface lie side by side.

use crate::charts::{Chart, MappedChart};
use std::collections::BTreeMap;
use std::ops::Range;
use unwrapd_maps::mesh::{CUT, Surface, next};
use unwrapd_method::numerics::vec2::sub;

/// Which chart each triangle of a surface is in.
pub struct ChartBorders<'a> {
    surface: &'a Surface,
    /// For each triangle its chart and its number there.
    home: Vec<[u32; 2]>,
}

/// A part of the boundary of a chart that follows a part of the boundary of another.
#[derive(Clone, Debug)]
pub struct Run {
    /// The other chart.
    pub neighbor: u32,
    /// Whether the other chart is wound the other way.
    pub is_turned: bool,
    /// The vertices along it, at least two: of the chart and of the neighbor.
    pub vertices: Vec<[u32; 2]>,
    /// The surface's halfedges along it, those of the chart's faces.
    pub halfedges: Vec<u32>,
}

impl<'a> ChartBorders<'a> {
    /// Of charts that have each triangle once.
    pub fn new<'b>(
        surface: &'a Surface,
        charts: impl IntoIterator<Item = (u32, &'b Chart)>,
    ) -> Self {
        let mut borders = Self {
            surface,
            home: vec![[CUT; 2]; surface.triangles.len()],
        };
        for (number, chart) in charts {
            borders.place(number, chart);
        }
        borders
    }

    /// Takes the triangles of a chart to be in it.
    pub fn place(&mut self, number: u32, chart: &Chart) {
        for (face, corners) in (0..).zip(&chart.corners) {
            self.home[corners[0] as usize / 3] = [number, face];
        }
    }

    /// The runs along which a chart could be glued to others, which `charts` has by their numbers.
    pub fn runs(&self, number: u32, charts: &BTreeMap<u32, MappedChart>) -> Vec<Run> {
        let chart = &charts[&number].chart;
        let outgoing: BTreeMap<u32, u32> = (0u32..)
            .zip(chart.disk.twins())
            .filter(|&(_, t)| t == CUT)
            .map(|(h, _)| (chart.disk.triangles[h as usize / 3][h as usize % 3], h))
            .collect();
        let mut runs: Vec<Run> = Vec::new();
        for boundary in &chart.disk.loops {
            let first_of_loop = runs.len();
            for v in boundary {
                let run = self.across(chart, outgoing[v], charts);
                let Some(run) = run.filter(|run| run.neighbor != number) else {
                    continue;
                };
                let last = runs[first_of_loop..].last_mut();
                match last.filter(|last| goes_on(last, &run)) {
                    Some(last) => {
                        last.vertices.push(run.vertices[1]);
                        last.halfedges.extend(run.halfedges);
                    }
                    None => runs.push(run),
                }
            }
            // The loop begins anywhere: its last run may go on in its first.
            if runs.len() > first_of_loop + 1
                && goes_on(&runs[runs.len() - 1], &runs[first_of_loop])
                && let Some(mut last) = runs.pop()
            {
                last.vertices.pop();
                last.vertices.append(&mut runs[first_of_loop].vertices);
                last.halfedges.append(&mut runs[first_of_loop].halfedges);
                runs[first_of_loop] = last;
            }
        }
        runs
    }

    /// The edge of a neighbor across a halfedge of a chart's boundary.
    fn across(&self, chart: &Chart, h: u32, charts: &BTreeMap<u32, MappedChart>) -> Option<Run> {
        let ends = [h, next(h)];
        let corners = ends.map(|h| chart.corners[h as usize / 3][h as usize % 3]);
        let vertices = ends.map(|h| chart.disk.triangles[h as usize / 3][h as usize % 3]);
        let welded = |corner: u32| self.surface.triangles[corner as usize / 3][corner as usize % 3];
        let of_surface = chart.surface_halfedge(h);
        let twin = self.surface.adjacency().twin[of_surface as usize];
        if twin == CUT {
            return None;
        }
        let [neighbor, face] = self.home[twin as usize / 3];
        let other = &charts.get(&neighbor)?.chart;
        let mut beyond = [twin, next(twin)];
        if welded(twin) != welded(corners[0]) {
            beyond.reverse();
        }
        let corners_there = other.corners[face as usize];
        let [start, end] = beyond.map(|corner| corners_there.iter().position(|&c| c == corner));
        let (start, end) = (start?, end?);
        let triangle = other.disk.triangles[face as usize];
        Some(Run {
            neighbor,
            is_turned: end == (start + 1) % 3,
            vertices: vec![[vertices[0], triangle[start]], [vertices[1], triangle[end]]],
            halfedges: vec![of_surface],
        })
    }
}

impl Run {
    /// The edges in this range.
    pub fn part(&self, edges: Range<usize>) -> Self {
        Self {
            vertices: self.vertices[edges.start..=edges.end].to_vec(),
            halfedges: self.halfedges[edges].to_vec(),
            ..*self
        }
    }

    /// How long it is in a map of the chart.
    pub fn length(&self, uv: &[[f64; 2]]) -> f64 {
        let edges = self.vertices.windows(2);
        let length = |edge: &[[u32; 2]]| {
            let [x, y] = sub(uv[edge[0][0] as usize], uv[edge[1][0] as usize]);
            x.hypot(y)
        };
        edges.map(length).sum()
    }
}

/// Whether a run goes on in another.
fn goes_on(last: &Run, run: &Run) -> bool {
    (last.neighbor, last.is_turned, last.vertices.last())
        == (run.neighbor, run.is_turned, run.vertices.first())
}

/// Runs of a half, a quarter and so on of the edges of some, besides these, the longest first.
pub fn parts_of_runs(runs: &[Run], uv: &[[f64; 2]]) -> Vec<Run> {
    let mut parts = Vec::new();
    for run in runs {
        let mut n_edges = run.vertices.len() - 1;
        while n_edges > 0 {
            let starts = (0..run.vertices.len() - n_edges).step_by(n_edges.div_ceil(2));
            parts.extend(starts.map(|start| run.part(start..start + n_edges)));
            n_edges /= 2;
        }
    }
    parts.sort_by(|a, b| b.length(uv).total_cmp(&a.length(uv)));
    parts
}

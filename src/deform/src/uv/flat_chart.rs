//! Charts as bodies, with the spots that anchors hold.

use super::anchors::{Held, Spot};
use super::chart::UvChart;
use super::{EditError, UvRest, body};
use crate::body::Body;
use crate::boundary::Boundary;
use crate::locate::locate;
use crate::pull::{Grip, Holds};
use unwrapd_maps::mesh::PlanarMesh;

/// A chart as a body whose mean triangle has area 1.
pub(super) struct FlatChart {
    pub body: Body,
    /// UVs at the start, in the body's unit.
    pub start: Vec<[f64; 2]>,
    pub unit: f64,
}

/// The vertices and points of a chart that anchors hold.
pub(super) struct Grips {
    pub holds: Holds,
    /// Targets of the pulled vertices, in the caller's unit.
    targets: Vec<[f64; 2]>,
}

impl FlatChart {
    /// Creates the body of a chart; fails if it folds over an edge.
    pub fn new(chart: &UvChart, rest: UvRest) -> Result<Self, EditError> {
        PlanarMesh::new(chart.uvs.clone(), chart.triangles.clone())?;
        let (body, start, unit) = body(chart, rest);
        Ok(Self { body, start, unit })
    }

    /// Returns the vertices and points of the chart that these anchors hold.
    pub fn grips(
        &self,
        chart: &UvChart,
        held: &[Held],
        boundary: Boundary,
    ) -> Result<Grips, EditError> {
        let fixed = boundary.held(chart.uvs.len(), &chart.triangles);
        let mut grips = Grips {
            holds: Holds::new(fixed),
            targets: Vec::with_capacity(held.len()),
        };
        for anchor in held {
            self.take_hold(&mut grips, chart, anchor)?;
        }
        Ok(grips)
    }

    fn take_hold(
        &self,
        Grips { holds, targets }: &mut Grips,
        chart: &UvChart,
        &Held { anchor, spot, to }: &Held,
    ) -> Result<(), EditError> {
        let unknown = EditError::UnknownHandle(anchor);
        // Find what the spot holds in this chart.
        let (at, grip) = match spot {
            Spot::Vertex(vertex) => {
                // The vertex of a face left out of its chart is not there.
                let local = chart.vertices.binary_search(&vertex);
                let local = local.map_err(|_| unknown)?;
                (chart.uvs[local], holds.grip(vec![(local as u32, 1.0)]))
            }
            Spot::Place { at, .. } => {
                let row = locate(&self.body, at.map(|x| x / self.unit)).ok_or(unknown)?;
                (at, holds.grip(row))
            }
        };
        // Pull it: a vertex beside the spot keeps its offset from it, a point needs none.
        match grip {
            Grip::Fixed if at == to => {}
            Grip::Fixed => return Err(EditError::OnBoundary(anchor)),
            Grip::Vertex(vertex) => {
                let place = chart.uvs[vertex as usize];
                let to = [0, 1].map(|k| to[k] + (place[k] - at[k]));
                holds.pull_vertex(anchor, vertex, to.map(|x| x / self.unit));
                targets.push(to);
            }
            Grip::Point(row) => holds.pull_point(anchor, row, to.map(|x| x / self.unit)),
        }
        Ok(())
    }

    /// Returns the UVs of the chart's vertices with the body's at `vertices`. Vertices that did not move or that
    /// arrived are not rounded.
    pub fn uvs(&self, chart: &UvChart, grips: &Grips, vertices: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let uv = |v: usize| {
            if vertices[v] == self.start[v] {
                chart.uvs[v]
            } else {
                vertices[v].map(|x| x * self.unit)
            }
        };
        let mut uvs: Vec<[f64; 2]> = (0..vertices.len()).map(uv).collect();
        for (to, &(v, target)) in grips.targets.iter().zip(&grips.holds.pulled) {
            if vertices[v as usize] == target {
                uvs[v as usize] = *to;
            }
        }
        uvs
    }
}

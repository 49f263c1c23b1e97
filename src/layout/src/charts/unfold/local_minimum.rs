//! Maps minimized in one place.

use super::surroundings::Surroundings;
use crate::charts::Chart;
use unwrapd_maps::embed::{self, RestShapes, map_term};
use unwrapd_maps::mesh::VertexFaces;
use unwrapd_method::energy::{Positional, RestShape};
use unwrapd_method::solver::{Iterate, Objective, Settings, Watch, minimize};

/// What a constraint pulls with, in the unit of the energy per area of a mean triangle.
const STRENGTH: f64 = 10.0;

/// Steps of the solver at once.
const STEPS: usize = 8;

/// A chart that is minimized around some of its vertices, the rest held.
pub struct Local<'a> {
    pub chart: &'a Chart,
    of_vertex: VertexFaces,
    rest: &'a RestShapes,
    options: &'a embed::Options,
    watch: &'a dyn Watch,
}

/// A linear function of three vertices, and what it should be.
pub type Constraint = ([(u32, f64); 3], [f64; 2]);

impl<'a> Local<'a> {
    /// A chart whose faces have these rest shapes.
    pub fn new(
        chart: &'a Chart,
        rest: &'a RestShapes,
        options: &'a embed::Options,
        watch: &'a dyn Watch,
    ) -> Self {
        Self {
            of_vertex: VertexFaces::new(chart.disk.n_vertices, &chart.disk.triangles),
            rest,
            chart,
            options,
            watch,
        }
    }

    /// A map in the unit of the rest shapes.
    pub fn in_unit(&self, uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
        uv.iter().map(|p| p.map(|x| x / self.rest.scale)).collect()
    }

    /// A map in the mesh's unit.
    pub fn in_mesh_unit(&self, uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
        uv.iter().map(|p| p.map(|x| x * self.rest.scale)).collect()
    }

    /// Minimizes the energy of a map, in the unit of the rest shapes, around some vertices with soft constraints, of which those
    /// count that lie there; returns the faces that have moved.
    pub fn minimize(
        &self,
        uv: &mut [[f64; 2]],
        near: impl Iterator<Item = u32>,
        constraints: &[Constraint],
    ) -> Vec<u32> {
        let around = Surroundings::new(self.chart, &self.of_vertex, near);
        let mut local = Positional {
            dim: 2,
            rows: Vec::new(),
            targets: Vec::new(),
            alpha: STRENGTH,
        };
        for (row, target) in constraints {
            let near = |&(v, weight)| Some((around.vertices.number(v)?, weight));
            if let Some(row) = row.iter().map(near).collect() {
                local.rows.push(row);
                local.targets.extend(target);
            }
        }
        let start = around.gathered(uv);
        let rest = around.faces.iter().map(|&f| self.rest.shapes[f as usize]);
        let rest: Vec<RestShape> = rest.collect();
        let term = map_term(&around.triangles, &rest, &start, self.options);
        let mut objective = Objective::constrained(around.vertices.count(), vec![term], local);
        objective.fix(&around.held);
        let settings = Settings {
            max_iterations: STEPS,
            ..self.options.solver
        };
        let mut x = start.into_flattened();
        // The watch is of the whole chart: pass on iterates, but not the positions of this part.
        let watch = |iterate: &Iterate| self.watch.iterate(iterate);
        let summary = minimize(&mut objective, &mut x, &settings, &watch);
        let places: &[[f64; 2]] = x.as_chunks().0;
        if summary.iterations == 0 || !embed::is_positive(&around.triangles, places) {
            return Vec::new();
        }
        for (&v, &p) in around.vertices.as_slice().iter().zip(places) {
            uv[v as usize] = p;
        }
        around.faces
    }
}

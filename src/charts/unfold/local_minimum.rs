//! Maps minimized in one place.

use super::surroundings::{NONE, Surroundings};
use crate::barrier::{Barrier, MapEnergy, epsilon, map_energy};
use crate::charts::Chart;
use crate::embed::{self, RestShapes, rest_shapes};
use crate::energy::{Positional, RestShape, Term};
use crate::mesh::VertexFaces;
use crate::numerics::vec2::doubled_area;
use crate::solver::{Objective, Settings, Watch, minimize};

/// What a constraint pulls with, in the unit of the energy per area of a mean triangle.
const STRENGTH: f64 = 10.0;

/// Steps of the solver at once.
const STEPS: usize = 12;

/// A chart that is minimized around some of its vertices, the rest held.
pub struct Local<'a> {
    pub chart: &'a Chart,
    of_vertex: VertexFaces,
    rest: RestShapes,
    options: &'a embed::Options,
    watch: &'a dyn Watch,
}

/// A linear function of three vertices, and what it should be.
pub type Constraint = ([(u32, f64); 3], [f64; 2]);

impl<'a> Local<'a> {
    pub fn new(chart: &'a Chart, options: &'a embed::Options, watch: &'a dyn Watch) -> Self {
        Self {
            of_vertex: VertexFaces::new(chart.disk.n_vertices, &chart.disk.triangles),
            rest: rest_shapes(&chart.positions, &chart.disk.triangles),
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
            let row = row.map(|(v, weight)| (around.local[v as usize], weight));
            if row.iter().all(|&(v, _)| v != NONE) {
                local.rows.push(row.to_vec());
                local.targets.extend(target);
            }
        }
        let term = self.term(&around, uv);
        let mut objective = Objective::constrained(around.vertices.len(), vec![term], local);
        objective.fix(&around.held);
        let settings = Settings {
            max_iterations: STEPS,
            ..self.options.solver
        };
        let mut x = around.gathered(uv).into_flattened();
        let summary = minimize(&mut objective, &mut x, &settings, self.watch);
        let places: &[[f64; 2]] = x.as_chunks().0;
        if summary.iterations == 0 || !embed::is_positive(&around.triangles, places) {
            return Vec::new();
        }
        for (&v, &p) in around.vertices.iter().zip(places) {
            uv[v as usize] = p;
        }
        around.faces
    }

    /// The energy of the surroundings.
    fn term(&self, around: &Surroundings, uv: &[[f64; 2]]) -> Box<dyn Term> {
        let rest = around.faces.iter().map(|&f| self.rest.shapes[f as usize]);
        let rest: Vec<RestShape> = rest.collect();
        let uv = around.gathered(uv);
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| uv[v as usize]);
            0.5 * doubled_area(a, b, c)
        };
        let smallest = around.triangles.iter().map(area);
        let smallest_rest = rest.iter().map(|shape| shape.size);
        let energy = MapEnergy {
            energy: self.options.energy,
            barrier: Barrier {
                kind: self.options.barrier,
                beta: self.options.beta,
                s: self.options.s,
                epsilon: epsilon(
                    smallest_rest.fold(f64::INFINITY, f64::min),
                    smallest.fold(f64::INFINITY, f64::min),
                ),
            },
        };
        map_energy(&around.triangles, &rest, &energy)
    }
}

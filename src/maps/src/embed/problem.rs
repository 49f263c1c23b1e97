//! A disk, its rest shapes and the energy of its maps.

use super::options::{Embedding, Options};
use super::positive::first_bad_triangle;
use super::rest::RestShapes;
use crate::mesh::Disk;
use std::sync::Arc;
use unwrapd_method::barrier::{Barrier, BarrierKind, epsilon};
use unwrapd_method::energy::{RestShape, Term, Triangles};
use unwrapd_method::numerics::vec2::doubled_area;
use unwrapd_method::solver::{Objective, Settings, Summary, Watch, best_scale, minimize};

/// Most Newton steps times triangles: 14 steps for 357,000 triangles, where one takes 1.5 s. Six of them came within
/// 0.3 % of the final energy: coarse to fine, the finest level has little left to do.
const STEP_BUDGET: usize = 5_000_000;

/// Least number of steps that even the largest disk may take.
const LEAST_STEPS: usize = 8;

/// A disk, its rest shapes and options.
pub(super) struct Problem<'a> {
    pub disk: &'a Disk,
    pub rest: RestShapes,
    pub options: &'a Options,
}

impl Problem<'_> {
    /// Returns the energy with the ε that this start requires.
    fn term(&self, start: &[[f64; 2]]) -> Box<dyn Term> {
        map_term(&self.disk.triangles, &self.rest.shapes, start, self.options)
    }

    fn term_with(&self, epsilon: f64) -> Box<dyn Term> {
        map_term_with(
            &self.disk.triangles,
            &self.rest.shapes,
            epsilon,
            self.options,
        )
    }

    /// Scales the map to the size of lowest energy.
    pub fn at_best_size(&self, uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
        // Scale to a mean area of 1 first: the search then starts near its end in any unit of the map.
        let area = total_area(&self.disk.triangles, uv).abs();
        let mean_area = area.max(f64::MIN_POSITIVE) / self.rest.shapes.len() as f64;
        let uv = scaled(uv, power_of_two(1.0 / mean_area.sqrt()));
        // The domain grows as ε falls; for the search there is none.
        let term = self.term_with(0.0);
        let best = best_scale(&|x| term.value(x), uv.as_flattened());
        self.scaled(&uv, best)
    }

    /// Scales the map so that its area is that of the rest shapes.
    pub fn at_rest_size(&self, uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
        self.with_area(uv, self.rest.shapes.len() as f64)
    }

    fn with_area(&self, uv: &[[f64; 2]], wanted: f64) -> Vec<[f64; 2]> {
        let area = total_area(&self.disk.triangles, uv).abs();
        self.scaled(uv, (wanted / area.max(f64::MIN_POSITIVE)).sqrt())
    }

    /// Multiplies the map by a factor, or by the nearest power of 2 if that would empty a triangle.
    pub fn scaled(&self, uv: &[[f64; 2]], factor: f64) -> Vec<[f64; 2]> {
        let exact = scaled(uv, factor);
        if first_bad_triangle(&self.disk.triangles, &exact).is_none() {
            exact
        } else {
            scaled(uv, power_of_two(factor))
        }
    }

    /// Returns the energy per triangle of a map.
    pub fn mean_energy(&self, uv: &[[f64; 2]]) -> f64 {
        self.term(uv).value(uv.as_flattened()) / self.rest.shapes.len() as f64
    }

    /// Returns the objective to minimize from this start.
    pub fn objective(&self, start: &[[f64; 2]]) -> Objective {
        Objective::new(self.disk.n_vertices, self.term(start))
    }

    /// Like [`objective`](Self::objective), analyzed while the start is found: the analysis takes about as long as
    /// finding it coarse to fine. A caller that wants only the start waits for the longer of the two.
    pub fn objective_beside(
        &self,
        start: impl FnOnce() -> Vec<[f64; 2]> + Send,
    ) -> (Vec<[f64; 2]>, Objective) {
        let analyzed = || {
            let mut objective = Objective::new(self.disk.n_vertices, self.term_with(0.0));
            objective.prepare();
            objective
        };
        let (start, mut objective) = rayon::join(start, analyzed);
        objective.exchange(vec![self.term(&start)]);
        (start, objective)
    }

    /// Minimizes from this start and returns the map in the mesh's unit.
    pub fn minimized(
        &self,
        objective: Objective,
        start: Vec<[f64; 2]>,
        pinned: &[u32],
        watch: &dyn Watch,
    ) -> Embedding {
        let (uv, summary) = self.minimum(objective, start, pinned, watch);
        Embedding {
            uv: self.in_mesh_unit(&uv),
            summary,
        }
    }

    /// Minimizes from this start in the unit of the rest shapes; pinned vertices stay in place.
    pub fn minimum(
        &self,
        mut objective: Objective,
        start: Vec<[f64; 2]>,
        pinned: &[u32],
        watch: &dyn Watch,
    ) -> (Vec<[f64; 2]>, Summary) {
        objective.fix(pinned);
        let affordable = (STEP_BUDGET / self.rest.shapes.len()).max(LEAST_STEPS);
        let settings = Settings {
            max_iterations: self.options.solver.max_iterations.min(affordable),
            ..self.options.solver
        };
        let mut x: Vec<f64> = start.as_flattened().to_vec();
        let summary = minimize(&mut objective, &mut x, &settings, watch);
        let mut uv: Vec<[f64; 2]> = x.as_chunks().0.to_vec();
        // The solver keeps areas above ε in floating point; the promise is about the exact sign.
        let is_promised = self.options.barrier != BarrierKind::None;
        if is_promised && first_bad_triangle(&self.disk.triangles, &uv).is_some() {
            uv = start;
        }
        (uv, summary)
    }

    /// Scales the map so that its area is that of the surface.
    fn in_mesh_unit(&self, uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let wanted = if self.rest.true_area > 0.0 {
            self.rest.true_area
        } else {
            self.rest.area
        };
        self.with_area(uv, wanted)
    }
}

fn total_area(triangles: &[[u32; 3]], uv: &[[f64; 2]]) -> f64 {
    triangles.iter().map(|t| signed_area(t, uv)).sum()
}

fn scaled(uv: &[[f64; 2]], factor: f64) -> Vec<[f64; 2]> {
    uv.iter().map(|p| p.map(|x| x * factor)).collect()
}

fn power_of_two(factor: f64) -> f64 {
    factor.log2().round().exp2()
}

// The energy of maps of some triangles.

/// Creates the energy of maps of triangles with these rest shapes, in their unit, with the ε that a start requires.
pub fn map_term(
    triangles: &[[u32; 3]],
    rest: &[RestShape],
    start: &[[f64; 2]],
    options: &Options,
) -> Box<dyn Term> {
    let smallest = |sizes: &mut dyn Iterator<Item = f64>| sizes.fold(f64::INFINITY, f64::min);
    let smallest_rest = smallest(&mut rest.iter().map(|shape| shape.size));
    let smallest_start = smallest(&mut triangles.iter().map(|t| signed_area(t, start)));
    let epsilon = epsilon(smallest_rest, smallest_start);
    map_term_with(triangles, rest, epsilon, options)
}

/// Like [`map_term`], with a given ε.
fn map_term_with(
    triangles: &[[u32; 3]],
    rest: &[RestShape],
    epsilon: f64,
    options: &Options,
) -> Box<dyn Term> {
    let barrier = Barrier {
        kind: options.barrier,
        beta: options.beta,
        s: options.s,
        epsilon,
    };
    let density = Arc::clone(&options.density);
    Box::new(Triangles::shared(triangles, rest, density, barrier))
}

/// Returns the area of a triangle in a map; negative if it is flipped.
fn signed_area(triangle: &[u32; 3], uv: &[[f64; 2]]) -> f64 {
    let [a, b, c] = triangle.map(|v| uv[v as usize]);
    0.5 * doubled_area(a, b, c)
}

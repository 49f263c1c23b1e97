//! A disk, its rest shapes and the energy of its maps.

use super::rest::RestShapes;
use super::tutte::first_bad_triangle;
use crate::mesh::Disk;
use std::sync::Arc;
use unwrapd_method::barrier::{Barrier, BarrierKind, LEAST_GAIN, epsilon, weaker_strengths};
use unwrapd_method::energy::{Arap, Density, RestShape, Term, Triangles, prefers_a_size};
use unwrapd_method::numerics::hull::convex_hull;
use unwrapd_method::numerics::vec2::doubled_area;
use unwrapd_method::solver::{
    Continued, Objective, Settings, Status, Summary, Watch, best_scale, minimize,
};

/// Most Newton steps times triangles: 14 steps for 357,000 triangles, where one takes 1.5 s. Six of them came within
/// 0.3 % of the final energy: coarse to fine, the finest level has little left to do.
const STEP_BUDGET: usize = 5_000_000;

/// Least number of steps that even the largest disk may take.
const LEAST_STEPS: usize = 8;

/// A disk, its rest shapes and options.
pub(super) struct MapProblem<'a> {
    pub disk: &'a Disk,
    pub rest: RestShapes,
    pub options: &'a Options,
}

impl MapProblem<'_> {
    /// Returns the energy with the ε that this start requires.
    pub fn term(&self, start: &[[f64; 2]]) -> Box<dyn Term> {
        map_term(&self.disk.triangles, &self.rest.shapes, start, self.options)
    }

    /// Returns the energy with the ε that this start requires and another strength of the barrier.
    fn weaker_term(&self, start: &[[f64; 2]], beta: f64) -> Box<dyn Term> {
        let options = Options {
            beta,
            ..self.options.clone()
        };
        map_term(&self.disk.triangles, &self.rest.shapes, start, &options)
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
        let settings = self.settings();
        let mut x: Vec<f64> = start.as_flattened().to_vec();
        let mut summary = minimize(&mut objective, &mut x, &settings, watch);
        // Weaken the barrier while the energy without it falls.
        if self.options.barrier_continuation {
            let unguarded = self.weaker_term(&start, 0.0);
            let mut energy = unguarded.value(&x);
            for beta in weaker_strengths(self.options.beta) {
                if summary.status == Status::Stopped {
                    break;
                }
                objective.exchange(vec![self.weaker_term(&start, beta)]);
                let mut moved = x.clone();
                let counted = Continued {
                    watch,
                    before: summary.iterations,
                };
                let next = minimize(&mut objective, &mut moved, &settings, &counted);
                let reached = unguarded.value(&moved);
                if reached > energy - LEAST_GAIN * energy.abs() {
                    break;
                }
                summary = summary.followed_by(&next);
                (x, energy) = (moved, reached);
            }
        }
        let mut uv: Vec<[f64; 2]> = x.as_chunks().0.to_vec();
        // The solver keeps areas above ε in floating point; the promise is about the exact sign.
        let is_promised = self.options.barrier != BarrierKind::None;
        if is_promised && first_bad_triangle(&self.disk.triangles, &uv).is_some() {
            uv = start;
        }
        (uv, summary)
    }

    /// Returns the solver's settings, with at most as many steps as the size of the disk allows.
    pub fn settings(&self) -> Settings {
        let affordable = (STEP_BUDGET / self.rest.shapes.len()).max(LEAST_STEPS);
        Settings {
            max_iterations: self.options.solver.max_iterations.min(affordable),
            ..self.options.solver
        }
    }

    /// Scales the map so that its area is that of the surface.
    pub fn in_mesh_unit(&self, uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
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

// Options and results of mapping a disk.

/// β for energies that prefer a size: the paper's.
const BETA: f64 = 0.01;

/// β for conformal energies. At their minimum triangles are far from their rest sizes, which the barrier prefers, so it
/// must be weak: of nine disks that libigl maps without flips, 1e-6 leaves the conformal energy of one 4 % above
/// libigl's, 1e-8 none more than 0.7 % (`tests/bench/lscm.py`). The first map is valid already, so that a weak barrier
/// suffices from the start.
const CONFORMAL_BETA: f64 = 1e-8;

/// Returns the β that fits an energy.
pub fn default_beta(density: &dyn Density<2>) -> f64 {
    if prefers_a_size(density) {
        BETA
    } else {
        CONFORMAL_BETA
    }
}

/// Objective and stopping criteria.
#[derive(Clone, Debug)]
pub struct Options {
    /// ψ: one of the library's or a caller's own.
    pub density: Arc<dyn Density<2>>,
    /// Barrier; without one, densities that are finite for flipped triangles may flip them.
    pub barrier: BarrierKind,
    /// β, the barrier's strength, for a mean rest area of 1.
    pub beta: f64,
    /// s, the share of its rest area below which the barrier of a triangle is nonzero.
    pub s: f64,
    /// Lowers β as long as the energy without the barrier falls.
    pub barrier_continuation: bool,
    /// Vertices that keep their places of the start.
    pub pins: Pins,
    /// Settings of the solver.
    pub solver: Settings,
    /// Factor by which the energy of each triangle counts beside its area; 1 for all if empty.
    pub weights: Vec<f64>,
}

impl Default for Options {
    /// Returns ARAP with the inverse-spline barrier, β = 0.01, s = 1.
    fn default() -> Self {
        Self {
            density: Arc::new(Arap),
            barrier: BarrierKind::default(),
            beta: BETA,
            s: 1.0,
            barrier_continuation: false,
            pins: Pins::None,
            solver: Settings::default(),
            weights: Vec::new(),
        }
    }
}

/// A map of a disk and the summary of its optimization.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedding {
    /// One position per vertex, in the mesh's unit of length, counter-clockwise; the sum of the areas in the plane is
    /// that of the triangles in space (or of their rest shapes, if none has an area).
    pub uv: Vec<[f64; 2]>,
    /// Summary of the solver; energies are for a mean rest area of 1.
    pub summary: Summary,
}

// Vertices that keep their places of the start.

/// Vertices that keep their exact places of the start while the others move (Schüller et al. 2013).
///
/// [`Lscm`](unwrapd_method::energy::Lscm) falls when a map shrinks: without pins only the barrier keeps it from
/// collapsing to a point. Two pins fix its size; other energies lose only their freedom to move
/// and to turn, and the distance of the pins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pins {
    /// No vertices.
    #[default]
    None,
    /// Two vertices of the outer boundary that are far from each other in a nearly isometric map, as far apart as
    /// there. Opposite vertices of Tutte's circle, at its diameter, are wrong for a long surface: its least-squares
    /// conformal map would end smaller than the surface and be shaped by the barrier. Energies that depend on size
    /// would pay for any distance except that in a minimum of their own, so it is taken from one, at the price of a
    /// minimization without pins.
    Two,
}

/// Most corners of a convex hull that are compared with each other, two million pairs; of more, as on a circle, every
/// k-th is enough.
const MOST_CORNERS: usize = 2_048;

/// Returns the two vertices of a loop that are farthest apart in a map. O(n log n).
pub(super) fn far_pair(boundary: &[u32], uv: &[[f64; 2]]) -> [u32; 2] {
    let hull = convex_hull(boundary.iter().map(|&v| uv[v as usize]));
    let step = hull.len().div_ceil(MOST_CORNERS).max(1);
    let hull: Vec<[f64; 2]> = hull.into_iter().step_by(step).collect();
    let mut farthest = ([0.0; 2], [0.0; 2], 0.0);
    for (i, &p) in hull.iter().enumerate() {
        for &q in &hull[i + 1..] {
            let apart = (q[0] - p[0]).hypot(q[1] - p[1]);
            if apart > farthest.2 {
                farthest = (p, q, apart);
            }
        }
    }
    let vertex = |p: [f64; 2]| boundary.iter().copied().find(|&v| uv[v as usize] == p);
    let first = boundary.first().copied().unwrap_or_default();
    [farthest.0, farthest.1].map(|p| vertex(p).unwrap_or(first))
}

/// Returns the distance of two vertices in a map.
pub(super) fn pair_distance(uv: &[[f64; 2]], pair: [u32; 2]) -> f64 {
    let [[x, y], [u, v]] = pair.map(|vertex| uv[vertex as usize]);
    (u - x).hypot(v - y)
}

//! Start of a fine cage from the solution in a coarser one.

use super::{Cage, CagedSurface};
use crate::{Body, Handle, Model, Problem};
use unwrapd_method::solver::{Iterate, Settings, Status, Watch};

/// Number of tetrahedra from which a coarse cage is solved first: one of voxels twice as large has an eighth of them,
/// and solving it costs a fraction of what it saves. At 99,000 the coarser cages took 0.9 of 4.7 s
/// (`tests/bench/solids.rs`, `cage-57`).
const LARGE: usize = 50_000;

/// Surfaces in cages, and the handles that pull them.
#[derive(Clone, Copy)]
pub struct Caged<'a> {
    /// Surfaces in the cage.
    pub surfaces: &'a [CagedSurface<'a>],
    /// Places and their targets.
    pub handles: &'a [Handle],
    /// Energy and barrier.
    pub model: &'a Model,
}

impl Caged<'_> {
    /// Sets the start of `problem`, that of `cage` with `n_voxels` along its longest side, to the solution in voxels
    /// twice as large, which starts likewise. Inversions where the fine cage follows the coarse one badly are
    /// untangled; if that fails, and in small cages, the start stays at rest.
    pub fn start(&self, problem: &mut Problem, cage: &Cage, n_voxels: u32, watch: &dyn Watch) {
        if cage.mesh().tets().len() < LARGE {
            return;
        }
        let Some(start) = self.interpolated(cage, n_voxels / 2, watch) else {
            return;
        };
        problem.start = start;
        if problem.untangle_start().is_err() {
            problem.start.clone_from(&problem.body.rest);
        } else if let Some(last) = problem.stations.pop() {
            // The solution in the coarse cage has passed the other stations.
            problem.stations = vec![last];
        }
        problem.untangled = 0;
    }

    /// Returns the positions of a fine cage's vertices under the solution in a coarse one; `None` if there is no such
    /// cage or the watcher stopped the solution.
    fn interpolated(&self, fine: &Cage, n_voxels: u32, watch: &dyn Watch) -> Option<Vec<f64>> {
        let cage = Cage::around(self.surfaces, n_voxels).ok()?;
        let mut problem = Problem::new(Body::from(cage.mesh()), self.handles, self.model).ok()?;
        problem.hold_idle_parts();
        self.start(&mut problem, &cage, n_voxels, watch);
        let unshown = |iterate: &Iterate| watch.iterate(iterate);
        let solution = problem.solve(&Settings::follow(), &unshown).ok()?;
        if solution.summary.status == Status::Stopped {
            return None;
        }
        let embedding = cage.embed(fine.mesh().vertices()).ok()?;
        let moved = cage.interpolate(&embedding, solution.x.as_chunks().0);
        Some(moved.into_flattened())
    }
}

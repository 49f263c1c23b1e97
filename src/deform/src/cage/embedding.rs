//! Points in a cage, which follow its deformation.

use super::grid::{ORDERS, path_slots};
use super::{ABSENT, Cage, CageError, CagedSurface};
use crate::{Body, Handle, Model, Problem};
use unwrapd_method::numerics::vec3::{add_scaled, cross, sub, unit};
use unwrapd_method::solver::{Iterate, Settings, Status, Watch};

/// For each of some points the tetrahedron that contains it and its place there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Embedding {
    /// Element of each point; the lowest if several have it on their boundary.
    pub tets: Vec<u32>,
    /// Barycentric weights of the element's corners, with sum 1 up to rounding; not negative for points inside the
    /// cage.
    pub weights: Vec<[f64; 4]>,
}

impl Cage {
    /// Finds the tetrahedron of every position.
    ///
    /// All points of the surfaces for which the cage was made are inside. Other points (vertices that no triangle uses)
    /// may be outside: they follow an element of a near voxel, whose map is extended.
    pub fn embed(&self, positions: &[[f64; 3]]) -> Result<Embedding, CageError> {
        let mut embedding = Embedding::default();
        let mut near = None;
        for (vertex, position) in positions.iter().enumerate() {
            if !position.iter().all(|x| x.is_finite()) {
                return Err(CageError::NonFinitePosition { vertex });
            }
            let local = self.grid.local(*position);
            let cell = self.lowest_voxel(local).unwrap_or_else(|| {
                let near = near.get_or_insert_with(|| self.near_voxels());
                self.grid
                    .place(near[self.grid.cell(self.nearest_cell(local))])
            });
            let (tet, weights) = self.place(local, cell);
            embedding.tets.push(tet);
            embedding.weights.push(weights);
        }
        Ok(embedding)
    }

    /// Returns the element of a voxel that contains a point, and its weights; for points outside the voxel an element
    /// in whose direction it lies.
    fn place(&self, local: [f64; 3], cell: [usize; 3]) -> (u32, [f64; 4]) {
        let part = [0, 1, 2].map(|k| local[k] - cell[k] as f64);
        let order = ORDERS
            .iter()
            .position(|order: &[usize; 3]| {
                part[order[0]] >= part[order[1]] && part[order[1]] >= part[order[2]]
            })
            .unwrap_or(0); // finite numbers have an order
        let [a, b, c] = ORDERS[order].map(|axis| part[axis]);
        let along_path = [1.0 - a, a - b, b - c, c];
        let mut weights = [0.0; 4];
        for (slot, weight) in path_slots(order).into_iter().zip(along_path) {
            weights[slot] = weight;
        }
        let voxel = self.voxel_of_cell[self.grid.cell(cell)];
        (6 * voxel + order as u32, weights)
    }

    /// Returns the voxel of the grid, in the cage or not, nearest to a point.
    fn nearest_cell(&self, local: [f64; 3]) -> [usize; 3] {
        [0, 1, 2].map(|k| local[k].clamp(0.0, (self.grid.counts[k] - 1) as f64) as usize)
    }

    /// Returns for every voxel of the grid the number of the voxel of the cage that is reached in the fewest steps.
    fn near_voxels(&self) -> Vec<u32> {
        let mut front: Vec<u32> = (0..self.grid.n_cells() as u32)
            .filter(|cell: &u32| self.voxel_of_cell[*cell as usize] != ABSENT)
            .collect();
        let mut near = vec![ABSENT; self.grid.n_cells()];
        for &cell in &front {
            near[cell as usize] = cell;
        }
        while !front.is_empty() {
            let mut next = Vec::new();
            for cell in front {
                for neighbor in self.grid.neighbors(self.grid.place(cell)) {
                    let neighbor = self.grid.cell(neighbor);
                    if near[neighbor] == ABSENT {
                        near[neighbor] = near[cell as usize];
                        next.push(neighbor as u32);
                    }
                }
            }
            front = next;
        }
        near
    }

    /// Returns the lowest voxel of the cage that has a point inside or on its boundary.
    fn lowest_voxel(&self, local: [f64; 3]) -> Option<[usize; 3]> {
        let candidates = |axis: usize| {
            let n = self.grid.counts[axis];
            let floor = local[axis].floor();
            let lower = if local[axis] == floor {
                floor - 1.0
            } else {
                floor
            };
            [lower, floor]
                .into_iter()
                .filter(move |&x| (0.0..n as f64).contains(&x))
                .map(|x| x as usize)
        };
        for z in candidates(2) {
            for y in candidates(1) {
                for x in candidates(0) {
                    if self.voxel_of_cell[self.grid.cell([x, y, z])] != ABSENT {
                        return Some([x, y, z]);
                    }
                }
            }
        }
        None
    }

    /// Returns the positions of the points with the cage's vertices at `deformed`.
    pub fn interpolate(&self, embedding: &Embedding, deformed: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let places = embedding.tets.iter().zip(&embedding.weights);
        places
            .map(|(&tet, weights)| {
                let corners = self.mesh.tets()[tet as usize];
                (0..4).fold([0.0; 3], |sum, k| {
                    add_scaled(sum, weights[k], deformed[corners[k] as usize])
                })
            })
            .collect()
    }

    /// Returns unit normals at the points, transformed by the inverse transpose of the Jacobian of their elements.
    pub fn normals(
        &self,
        embedding: &Embedding,
        deformed: &[[f64; 3]],
        normals: &[[f64; 3]],
    ) -> Vec<[f64; 3]> {
        let transformed = |(&tet, n): (&u32, &[f64; 3])| {
            let [x, y, z] = self.jacobian(tet, deformed);
            // The cofactor matrix: the inverse transpose times the determinant, which is positive.
            unit(combination([cross(y, z), cross(z, x), cross(x, y)], *n))
        };
        embedding
            .tets
            .iter()
            .zip(normals)
            .map(transformed)
            .collect()
    }

    /// Returns unit tangents at the points, transformed by the Jacobian of their elements. Handedness does not change.
    pub fn tangents(
        &self,
        embedding: &Embedding,
        deformed: &[[f64; 3]],
        tangents: &[[f64; 3]],
    ) -> Vec<[f64; 3]> {
        embedding
            .tets
            .iter()
            .zip(tangents)
            .map(|(&tet, t): (&u32, &[f64; 3])| unit(combination(self.jacobian(tet, deformed), *t)))
            .collect()
    }

    /// Returns the columns of an element's Jacobian: its path runs along one axis after the other.
    fn jacobian(&self, tet: u32, deformed: &[[f64; 3]]) -> [[f64; 3]; 3] {
        let order = tet as usize % 6;
        let corners = self.mesh.tets()[tet as usize];
        let path = path_slots(order).map(|slot| deformed[corners[slot] as usize]);
        let mut columns = [[0.0; 3]; 3];
        for (step, &axis) in ORDERS[order].iter().enumerate() {
            columns[axis] = sub(path[step + 1], path[step]).map(|x| x / self.grid.side);
        }
        columns
    }
}

fn combination(columns: [[f64; 3]; 3], factors: [f64; 3]) -> [f64; 3] {
    (0..3).fold([0.0; 3], |sum, k| add_scaled(sum, factors[k], columns[k]))
}

// Start of a fine cage from the solution in a coarser one.

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

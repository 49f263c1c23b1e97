//! Voxels that a surface touches or encloses.

use super::CageError;
use super::grid::Grid;
use unwrapd_method::numerics::bounds::{Bounds, bounds_of};
use unwrapd_method::numerics::vec3::{cross, dot, sub};

/// Enlargement of voxels in tests, in voxels: far above rounding, far below relevance.
const MARGIN: f64 = 1e-6;
/// Most tests of boxes against triangles: about ten seconds' worth.
const MOST_TESTS: u64 = 500_000_000;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Voxel {
    Unreached,
    Touched,
    Outside,
}

/// Voxels of a grid and their states.
pub(super) struct Voxels<'a> {
    grid: &'a Grid,
    state: Vec<Voxel>,
    tests_left: u64,
}

impl<'a> Voxels<'a> {
    pub fn new(grid: &'a Grid) -> Self {
        Self {
            grid,
            state: vec![Voxel::Unreached; grid.n_cells()],
            tests_left: MOST_TESTS,
        }
    }

    /// Marks all voxels that a triangle touches, and none farther away than the margin.
    pub fn touch(&mut self, corners: [[f64; 3]; 3]) -> Result<(), CageError> {
        let triangle = corners.map(|p| self.grid.local(p));
        let [low, high] = bounds_of(&triangle);
        let last = self.grid.counts.map(|c| c - 1);
        // The grid has a layer around the surface, so that these are in range.
        let first = low.map(|x| (x - MARGIN).floor() as usize);
        let end = [0, 1, 2].map(|k| (high[k] + MARGIN).floor().min(last[k] as f64) as usize + 1);
        // Halve the range along its longest side until single voxels are left that the triangle touches.
        let mut open = vec![[first, end]];
        while let Some([first, end]) = open.pop() {
            self.tests_left = self
                .tests_left
                .checked_sub(1)
                .ok_or(CageError::TooFine("a reasonable time"))?;
            let bounds = [
                first.map(|x| x as f64 - MARGIN),
                end.map(|x| x as f64 + MARGIN),
            ];
            if !overlaps(&triangle, &bounds) {
                continue;
            }
            let size = [0, 1, 2].map(|k| end[k] - first[k]);
            let longest = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
            if size[longest] == 1 {
                self.state[self.grid.cell(first)] = Voxel::Touched;
                continue;
            }
            let middle = first[longest] + size[longest] / 2;
            let (mut lower_end, mut upper_first) = (end, first);
            lower_end[longest] = middle;
            upper_first[longest] = middle;
            open.extend([[first, lower_end], [upper_first, end]]);
        }
        Ok(())
    }

    /// Returns for each voxel whether it is touched or cannot be reached from outside without passing through touched
    /// ones.
    pub fn into_kept(mut self) -> Vec<bool> {
        let mut open = vec![[0_usize; 3]];
        self.state[0] = Voxel::Outside;
        while let Some(at) = open.pop() {
            for neighbor in self.grid.neighbors(at) {
                let state = &mut self.state[self.grid.cell(neighbor)];
                if *state == Voxel::Unreached {
                    *state = Voxel::Outside;
                    open.push(neighbor);
                }
            }
        }
        self.state.iter().map(|s| *s != Voxel::Outside).collect()
    }
}

/// Returns whether a triangle and a box have a common point: no axis separates them (Akenine-Möller 2001).
///
/// Also returns `true` where rounding leaves it in doubt, and for triangles without area whose line meets the box.
fn overlaps(triangle: &[[f64; 3]; 3], [low, high]: &Bounds<3>) -> bool {
    let center = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
    let half = [0, 1, 2].map(|k| 0.5 * (high[k] - low[k]));
    let corners = triangle.map(|p| sub(p, center));
    let separates = |axis: [f64; 3]| {
        let reach = half[0] * axis[0].abs() + half[1] * axis[1].abs() + half[2] * axis[2].abs();
        let [a, b, c] = corners.map(|p| dot(axis, p));
        a.min(b).min(c) > reach || a.max(b).max(c) < -reach
    };
    let unit = |k: usize| [0, 1, 2].map(|i| f64::from(u8::from(i == k)));
    let edges = [0, 1, 2].map(|k| sub(corners[(k + 1) % 3], corners[k]));
    !((0..3).any(|k| separates(unit(k)))
        || separates(cross(edges[0], edges[1]))
        || edges
            .iter()
            .any(|&e| (0..3).any(|k| separates(cross(unit(k), e)))))
}

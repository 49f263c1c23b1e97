//! The voxel grid and its tetrahedra.

use unwrapd_maps::mesh::ElementError;
use unwrapd_method::numerics::bounds::{Bounds, bounds_of};
use unwrapd_method::numerics::vec3::{cross, dot, sub};

/// Most voxels of the whole grid, kept or not: a byte and two indices each, 150 MB.
const MOST_CELLS: usize = 1 << 24;

/// The six orders of the axes. Each names a tetrahedron of the unit cube, in which coordinates decrease in that order:
/// its path runs from (0,0,0) along the first axis, the second, the third to (1,1,1) (Kuhn 1960).
pub(super) const ORDERS: [[usize; 3]; 6] = [
    [0, 1, 2],
    [0, 2, 1],
    [1, 0, 2],
    [1, 2, 0],
    [2, 0, 1],
    [2, 1, 0],
];

/// Returns the slots of the path's corners in a positive tetrahedron: half of the orders exchange the last two.
pub(super) fn path_slots(order: usize) -> [usize; 4] {
    match order {
        0 | 3 | 4 => [0, 1, 2, 3],
        _ => [0, 1, 3, 2],
    }
}

/// Cubes of equal side around a box, one layer larger on every side.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    /// Side of a voxel, of few digits, so that all corners are exact.
    pub side: f64,
    /// Lowest corner in units of `side`: integers.
    low: [f64; 3],
    /// Number of voxels along each axis.
    pub counts: [usize; 3],
}

impl Grid {
    /// Creates a grid with `n` voxels along the longest side of the box.
    pub fn around(bounds: &Bounds<3>, n: u32) -> Result<Self, CageError> {
        let [low, high] = bounds;
        let longest = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
        if longest <= 0.0 || !longest.is_finite() {
            return Err(CageError::Empty);
        }
        // 20 binary digits are enough for a side; of the 53 of an `f64` they leave 32 for its multiples.
        let exact = longest / f64::from(n.max(1));
        let unit = (exact.log2().floor() - 20.0).exp2();
        let side = (exact / unit).ceil() * unit;
        // Add a layer on every side, and limit the number of voxels.
        let first = low.map(|x| (x / side).floor() - 1.0);
        let last = high.map(|x| (x / side).floor() + 2.0);
        let is_exact = first
            .iter()
            .chain(&last)
            .all(|x| x.abs() < f64::from(u32::MAX));
        if n == 0 || !is_exact || !side.is_normal() {
            return Err(CageError::TooFine("32 bits for its corners"));
        }
        let counts = [0, 1, 2].map(|k| (last[k] - first[k]) as usize);
        let n_cells = counts.iter().try_fold(1_usize, |n, &c| n.checked_mul(c));
        if n_cells.is_none_or(|n| n > MOST_CELLS) {
            return Err(CageError::TooFine("2^24 voxels"));
        }
        Ok(Self {
            side,
            low: first,
            counts,
        })
    }

    /// Converts a position to units of voxels from the lowest corner.
    pub fn local(&self, p: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| p[k] / self.side - self.low[k])
    }

    /// Returns the exact position of a corner.
    pub fn corner(&self, at: [usize; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| (self.low[k] + at[k] as f64) * self.side)
    }

    /// Returns the number of a voxel; x runs fastest.
    pub fn cell(&self, at: [usize; 3]) -> usize {
        (at[2] * self.counts[1] + at[1]) * self.counts[0] + at[0]
    }

    /// Returns the voxel of a number.
    pub fn place(&self, cell: u32) -> [usize; 3] {
        let (cell, [nx, ny, _]) = (cell as usize, self.counts);
        [cell % nx, cell / nx % ny, cell / nx / ny]
    }

    /// Returns the number of a corner.
    pub fn corner_number(&self, at: [usize; 3]) -> usize {
        (at[2] * (self.counts[1] + 1) + at[1]) * (self.counts[0] + 1) + at[0]
    }

    pub fn n_cells(&self) -> usize {
        self.counts.iter().product()
    }

    pub fn n_corners(&self) -> usize {
        self.counts.iter().map(|c| c + 1).product()
    }

    /// Iterates over the voxels that share a face with one.
    pub fn neighbors(&self, at: [usize; 3]) -> impl Iterator<Item = [usize; 3]> + use<> {
        let counts = self.counts;
        (0..6).filter_map(move |side| {
            let (axis, mut next) = (side / 2, at);
            next[axis] = match side % 2 {
                0 => at[axis].checked_sub(1)?,
                _ => at[axis] + 1,
            };
            (next[axis] < counts[axis]).then_some(next)
        })
    }

    /// Iterates over all voxels in the order of their numbers.
    pub fn cells(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        let [nx, ny, nz] = self.counts;
        (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])))
    }
}

// Voxels that a surface touches or encloses.

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

/// Reason why surfaces get no cage.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CageError {
    /// A surface is broken.
    #[error("surface {surface}: {error}")]
    Surface {
        /// Index of the surface, from 0.
        surface: usize,
        /// Defect of the surface.
        error: ElementError,
    },
    /// There is no surface, or it has no extent.
    #[error("there is no surface to put a cage around")]
    Empty,
    /// The number of voxels is zero or too large.
    #[error("the cage would need more than {0}")]
    TooFine(&'static str),
    /// A position to embed is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NonFinitePosition {
        /// First such vertex, from 0.
        vertex: usize,
    },
}

impl CageError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Surface { error, .. } => error.code(),
            Self::Empty => "no_elements",
            Self::TooFine(_) => "limit_exceeded",
            Self::NonFinitePosition { .. } => "non_finite_position",
        }
    }
}

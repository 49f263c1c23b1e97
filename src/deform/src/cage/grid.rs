//! The voxel grid and its tetrahedra.

use super::CageError;
use unwrapd_method::numerics::bounds::Bounds;

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

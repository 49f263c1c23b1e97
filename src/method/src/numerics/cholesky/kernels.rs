//! Dense kernels on column-major panels whose height is a multiple of [`LANES`].
//!
//! Written for vectors of any width (pulp chooses at run time). A tile of eight columns is held in registers while all
//! columns to its left are subtracted from it, so that the panel is written once.

// Only code inlined into the function that pulp compiles for the processor at hand uses its vectors; everything else is
// compiled for the oldest processor.
#![expect(clippy::inline_always)]

use faer::traits::pulp::{Simd, WithSimd};

/// Columns of a tile, and rows of the smallest strip: numbers in the widest vector, of 512 bits.
pub(super) const LANES: usize = 8;

/// Eight columns of a factor's diagonal block, with reciprocals on the diagonal.
type Tile = [[f64; LANES]; LANES];

/// Factors the columns `from..to` of a panel whose columns before `from` have been subtracted already; returns `false`
/// if a pivot is not positive. The diagonal then holds reciprocals.
pub(super) struct FactorColumns<'a> {
    pub panel: &'a mut [f64],
    pub stride: usize,
    pub height: usize,
    pub from: usize,
    pub to: usize,
}

impl WithSimd for FactorColumns<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let Self {
            panel,
            stride,
            height,
            from,
            to,
        } = self;
        for first in (from..to).step_by(LANES) {
            let width = LANES.min(to - first);
            let (left, right) = panel.split_at_mut(first * stride);
            let mut columns = ColumnBlock {
                left: &left[from * stride..],
                right: &mut right[..width * stride],
                stride,
                width,
                pivot: first,
            };
            let Some(tile) = columns.factor_tile(simd) else {
                return false;
            };
            let mut strips = SolveStrips { columns, tile };
            for_strips(simd, first + LANES, height, &mut strips);
        }
        true
    }
}

/// Work on a strip of rows, `R` vectors high.
trait Strips {
    fn strip<S: Simd, const R: usize>(&mut self, simd: S, row: usize);
}

/// Cuts rows into strips as high as the registers hold next to eight columns: processors with vectors of eight numbers
/// have thirty-two of them, enough for three by eight.
#[inline(always)]
fn for_strips<S: Simd>(simd: S, from: usize, to: usize, work: &mut impl Strips) {
    let mut row = from;
    if S::F64_LANES == LANES {
        while row + 3 * LANES <= to {
            work.strip::<S, 3>(simd, row);
            row += 3 * LANES;
        }
    }
    while row < to {
        work.strip::<S, 1>(simd, row);
        row += S::F64_LANES;
    }
}

/// Some columns of a panel, and those to their left.
struct ColumnBlock<'a> {
    left: &'a [f64],
    right: &'a mut [f64],
    stride: usize,
    /// Number of columns, at most eight.
    width: usize,
    /// Row of the first column's pivot.
    pivot: usize,
}

#[inline(always)]
fn load<S: Simd, const R: usize>(column: &[f64], row: usize) -> [S::f64s; R] {
    let (vectors, _) = S::as_simd_f64s(&column[row..row + R * S::F64_LANES]);
    let mut values = [vectors[0]; R];
    values.copy_from_slice(vectors);
    values
}

#[inline(always)]
fn store<S: Simd, const R: usize>(column: &mut [f64], row: usize, values: [S::f64s; R]) {
    let (vectors, _) = S::as_mut_simd_f64s(&mut column[row..row + R * S::F64_LANES]);
    vectors.copy_from_slice(&values);
}

/// Computes Σ over columns of (rows from `row`) × (eight rows from `across`).
#[inline(always)]
fn products<S: Simd, const R: usize>(
    simd: S,
    columns: &[f64],
    stride: usize,
    row: usize,
    across: usize,
) -> [[S::f64s; R]; LANES] {
    let mut sums = [[simd.splat_f64s(0.0); R]; LANES];
    for column in columns.chunks_exact(stride) {
        let a = load::<S, R>(column, row);
        let b = &column[across..across + LANES];
        for c in 0..LANES {
            let b = simd.splat_f64s(b[c]);
            for r in 0..R {
                sums[c][r] = simd.mul_add_e_f64s(a[r], b, sums[c][r]);
            }
        }
    }
    sums
}

impl ColumnBlock<'_> {
    /// Returns eight columns of a strip minus all products with columns to their left; zeros beyond `width`.
    #[inline(always)]
    fn reduced<S: Simd, const R: usize>(&self, simd: S, row: usize) -> [[S::f64s; R]; LANES] {
        let mut values = products::<S, R>(simd, self.left, self.stride, row, self.pivot);
        for c in 0..LANES {
            if c < self.width {
                let own = load::<S, R>(&self.right[c * self.stride..], row);
                for r in 0..R {
                    values[c][r] = simd.sub_f64s(own[r], values[c][r]);
                }
            }
        }
        values
    }

    /// Factors the square at the pivots; returns `None` if a pivot is not positive.
    #[inline(always)]
    fn factor_tile<S: Simd>(&mut self, simd: S) -> Option<Tile> {
        let mut tile = Tile::default();
        for row in (0..LANES).step_by(S::F64_LANES) {
            let values = self.reduced::<S, 1>(simd, self.pivot + row);
            for c in 0..self.width {
                store::<S, 1>(&mut tile[c], row, values[c]);
            }
        }
        for c in 0..self.width {
            let pivot = tile[c][c];
            if pivot <= 0.0 || pivot.is_nan() {
                return None;
            }
            let reciprocal = 1.0 / pivot.sqrt();
            let column = tile[c].map(|x| x * reciprocal);
            tile[c] = column;
            tile[c][c] = reciprocal;
            for other in c + 1..self.width {
                let factor = column[other];
                for r in 0..LANES {
                    tile[other][r] -= factor * column[r];
                }
            }
        }
        for c in 0..self.width {
            self.right[c * self.stride + self.pivot..][..LANES].copy_from_slice(&tile[c]);
        }
        Some(tile)
    }
}

/// Solves for the rows below a factored tile.
struct SolveStrips<'a> {
    columns: ColumnBlock<'a>,
    tile: Tile,
}

impl Strips for SolveStrips<'_> {
    #[inline(always)]
    fn strip<S: Simd, const R: usize>(&mut self, simd: S, row: usize) {
        let Self { columns, tile } = self;
        let mut values = columns.reduced::<S, R>(simd, row);
        for c in 0..LANES {
            let reciprocal = simd.splat_f64s(tile[c][c]);
            for r in 0..R {
                values[c][r] = simd.mul_f64s(values[c][r], reciprocal);
            }
            for other in c + 1..LANES {
                let factor = simd.splat_f64s(-tile[c][other]);
                for r in 0..R {
                    values[other][r] = simd.mul_add_e_f64s(values[c][r], factor, values[other][r]);
                }
            }
        }
        for c in 0..columns.width {
            store::<S, R>(&mut columns.right[c * columns.stride..], row, values[c]);
        }
    }
}

/// Writes the lower triangle of −LLᵀ for the rows of a panel from `first` on.
pub(super) struct WriteUpdate<'a> {
    pub panel: &'a [f64],
    pub stride: usize,
    pub first: usize,
    /// Column-major square matrix.
    pub update: &'a mut [f64],
    pub size: usize,
}

impl WithSimd for WriteUpdate<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut strips = UpdateStrips {
            update: self,
            column: 0,
        };
        let size = strips.update.size;
        for column in (0..size).step_by(LANES) {
            strips.column = column;
            for_strips(simd, column, size.next_multiple_of(LANES), &mut strips);
        }
    }
}

/// Computes eight columns of an update.
struct UpdateStrips<'a> {
    update: WriteUpdate<'a>,
    column: usize,
}

impl Strips for UpdateStrips<'_> {
    #[inline(always)]
    fn strip<S: Simd, const R: usize>(&mut self, simd: S, row: usize) {
        let Self { update, column } = self;
        let WriteUpdate {
            panel,
            stride,
            first,
            size,
            ..
        } = *update;
        let sums = products::<S, R>(simd, panel, stride, first + row, first + *column);
        let height = size.next_multiple_of(LANES);
        for c in 0..LANES.min(size - *column) {
            let mut negative = sums[c];
            for r in 0..R {
                negative[r] = simd.neg_f64s(negative[r]);
            }
            store::<S, R>(&mut update.update[(*column + c) * height..], row, negative);
        }
    }
}

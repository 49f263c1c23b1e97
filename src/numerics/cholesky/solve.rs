//! Solving with the factor.

// What is not inlined into the function that pulp compiles for the processor at hand is compiled for the oldest one.
#![expect(clippy::inline_always)]

use faer::traits::pulp::{Simd, WithSimd};

use super::branch::Branch;
use super::fronts::Front;
use super::kernels::LANES;
use super::plan::Plan;

/// Replaces `x`, in the order of elimination, by the solution of LLᵀ x = b.
pub(super) struct Solve<'a> {
    pub plan: &'a Plan,
    pub branches: &'a [Branch],
    pub x: &'a mut [f64],
    /// As long as the highest panel: a front's unknowns as its panel has them.
    pub local: &'a mut [f64],
}

impl WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            plan,
            branches,
            x,
            local,
        } = self;
        let n = plan.fronts.list.len();
        let panel = |k: usize| {
            let place = plan.places[k];
            &branches[place.branch as usize].panels[place.panel..]
        };
        for k in 0..n {
            let front = &plan.fronts.list[k];
            let local = &mut local[..front.height()];
            local.fill(0.0);
            local[..front.pivots].copy_from_slice(&x[front.pivot_range()]);
            for first in (0..front.pivots).step_by(LANES) {
                Tile::new(front, panel(k), first).forward(simd, local);
            }
            x[front.pivot_range()].copy_from_slice(&local[..front.pivots]);
            for (v, value) in plan.below(front).zip(&local[front.padded()..]) {
                x[v] += value;
            }
        }
        for k in (0..n).rev() {
            let front = &plan.fronts.list[k];
            let local = &mut local[..front.height()];
            local.fill(0.0);
            local[..front.pivots].copy_from_slice(&x[front.pivot_range()]);
            for (v, value) in plan.below(front).zip(&mut local[front.padded()..]) {
                *value = x[v];
            }
            for first in (0..front.pivots).step_by(LANES).rev() {
                Tile::new(front, panel(k), first).backward(simd, local);
            }
            x[front.pivot_range()].copy_from_slice(&local[..front.pivots]);
        }
    }
}

/// Up to eight columns of a factored panel, whose diagonal holds reciprocals.
struct Tile<'a> {
    columns: &'a [f64],
    stride: usize,
    width: usize,
    /// The row of its first pivot.
    first: usize,
}

impl<'a> Tile<'a> {
    fn new(front: &Front, panel: &'a [f64], first: usize) -> Self {
        let stride = front.stride();
        Self {
            columns: &panel[first * stride..],
            stride,
            width: LANES.min(front.pivots - first),
            first,
        }
    }

    /// The rows of a column from the first pivot's on.
    #[inline(always)]
    fn column(&self, c: usize, height: usize) -> &'a [f64] {
        &self.columns[c * self.stride..][self.first..height]
    }

    /// Solves for its pivots and subtracts them from all rows below.
    #[inline(always)]
    fn forward<S: Simd>(&self, simd: S, local: &mut [f64]) {
        let height = local.len();
        let (own, below) = local[self.first..].split_at_mut(LANES);
        let mut factors = [simd.splat_f64s(0.0); LANES];
        // Columns that there are not read the first one's rows and count nothing.
        let mut columns = [&self.column(0, height)[LANES..]; LANES];
        for c in 0..self.width {
            let column = self.column(c, height);
            own[c] *= column[c];
            for r in c + 1..self.width {
                own[r] -= own[c] * column[r];
            }
            factors[c] = simd.splat_f64s(-own[c]);
            columns[c] = &column[LANES..];
        }
        let (targets, _) = S::as_mut_simd_f64s(below);
        for (i, target) in targets.iter_mut().enumerate() {
            let mut sum = *target;
            for c in 0..LANES {
                sum = simd.mul_add_e_f64s(vectors::<S>(columns[c])[i], factors[c], sum);
            }
            *target = sum;
        }
    }

    /// Subtracts all rows below from its pivots and solves for them.
    #[inline(always)]
    fn backward<S: Simd>(&self, simd: S, local: &mut [f64]) {
        let height = local.len();
        let (own, below) = local[self.first..].split_at_mut(LANES);
        let mut columns = [&self.column(0, height)[LANES..]; LANES];
        for c in 1..self.width {
            columns[c] = &self.column(c, height)[LANES..];
        }
        let mut sums = [simd.splat_f64s(0.0); LANES];
        for (i, &value) in vectors::<S>(below).iter().enumerate() {
            for c in 0..LANES {
                sums[c] = simd.mul_add_e_f64s(vectors::<S>(columns[c])[i], value, sums[c]);
            }
        }
        for c in (0..self.width).rev() {
            let column = self.column(c, height);
            let mut value = own[c] - simd.reduce_sum_f64s(sums[c]);
            for r in c + 1..self.width {
                value -= column[r] * own[r];
            }
            own[c] = value * column[c];
        }
    }
}

#[inline(always)]
fn vectors<S: Simd>(values: &[f64]) -> &[S::f64s] {
    S::as_simd_f64s(values).0
}

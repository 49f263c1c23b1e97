//! Forward and backward substitution with the factor.

// Only code inlined into the function that pulp compiles for the processor at hand uses its vectors; everything else is
// compiled for the oldest processor.
#![expect(clippy::inline_always)]

use faer::traits::pulp::{Simd, WithSimd};

use super::branch::Branch;
use super::fronts::Front;
use super::kernels::LANES;
use super::plan::Plan;

/// Solves Ly = b for the pivots of a branch; `others` are the branches that grow on it, which are done.
pub(super) struct Forward<'a> {
    pub plan: &'a Plan,
    pub branch: &'a mut Branch,
    pub others: &'a [Branch],
    /// Right-hand side in the order of the matrix.
    pub b: &'a [f64],
}

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { plan, others, .. } = self;
        let Branch {
            fronts,
            panels,
            vectors,
            ..
        } = self.branch;
        for &k in fronts.iter() {
            let (front, place) = plan.front(k);
            // Gather the right-hand side at the pivots and add the contributions of the children.
            let local = &mut vectors.local[..front.height()];
            local.fill(0.0);
            plan.gather(front, self.b, local);
            for (child, at) in plan.children(front) {
                let other = others.get(at.branch as usize);
                let below = other.map_or(&vectors.below, |other| &other.vectors.below);
                let below = &below[at.below..][..child.below];
                for run in &plan.fronts.runs[child.runs.clone()] {
                    let length = run.length as usize;
                    let target = &mut local[run.parent as usize..][..length];
                    for (t, s) in target.iter_mut().zip(&below[run.child as usize..]) {
                        *t += s;
                    }
                }
            }
            // Solve for the pivots, one tile after another.
            for first in (0..front.pivots).step_by(LANES) {
                SolveTile::new(front, &panels[place.panel..], first).forward(simd, local);
            }
            // Store the solution at the pivots and the contribution to the rows below.
            let (own, below) = local.split_at(front.padded());
            vectors.pivots[place.pivots..][..front.pivots].copy_from_slice(&own[..front.pivots]);
            vectors.below[place.below..][..front.below].copy_from_slice(&below[..front.below]);
        }
    }
}

/// Solves Lᵀx = y for the pivots of a branch, given the solution below them, and passes it on to the branches that grow
/// on it.
pub(super) struct Backward<'a> {
    pub plan: &'a Plan,
    pub branch: &'a mut Branch,
    pub others: &'a mut [Branch],
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { plan, others, .. } = self;
        let Branch {
            fronts,
            panels,
            vectors,
            ..
        } = self.branch;
        for &k in fronts.iter().rev() {
            let (front, place) = plan.front(k);
            // Load the result of the forward pass at the pivots and the solution in the rows below.
            let local = &mut vectors.local[..front.height()];
            local.fill(0.0);
            let pivots = &mut vectors.pivots[place.pivots..][..front.pivots];
            local[..front.pivots].copy_from_slice(pivots);
            local[front.padded()..][..front.below]
                .copy_from_slice(&vectors.below[place.below..][..front.below]);
            // Solve for the pivots, the last tile first.
            for first in (0..front.pivots).step_by(LANES).rev() {
                SolveTile::new(front, &panels[place.panel..], first).backward(simd, local);
            }
            // Store the solution, and pass it on to the rows below the children.
            pivots.copy_from_slice(&local[..front.pivots]);
            for (child, at) in plan.children(front) {
                let other = others.get_mut(at.branch as usize);
                let below = other.map_or(&mut vectors.below, |other| &mut other.vectors.below);
                let below = &mut below[at.below..][..child.below];
                for run in &plan.fronts.runs[child.runs.clone()] {
                    let length = run.length as usize;
                    below[run.child as usize..][..length]
                        .copy_from_slice(&local[run.parent as usize..][..length]);
                }
            }
        }
    }
}

/// Up to eight columns of a factored panel, whose diagonal holds reciprocals.
struct SolveTile<'a> {
    columns: &'a [f64],
    stride: usize,
    width: usize,
    /// Row of the first pivot.
    first: usize,
}

impl<'a> SolveTile<'a> {
    fn new(front: &Front, panel: &'a [f64], first: usize) -> Self {
        let stride = front.stride();
        Self {
            columns: &panel[first * stride..],
            stride,
            width: LANES.min(front.pivots - first),
            first,
        }
    }

    /// Returns the rows of a column from the first pivot's on.
    #[inline(always)]
    fn column(&self, c: usize, height: usize) -> &'a [f64] {
        &self.columns[c * self.stride..][self.first..height]
    }

    /// Solves for the pivots of the tile and subtracts their contribution from all rows below.
    #[inline(always)]
    fn forward<S: Simd>(&self, simd: S, local: &mut [f64]) {
        let height = local.len();
        let (own, below) = local[self.first..].split_at_mut(LANES);
        let mut factors = [simd.splat_f64s(0.0); LANES];
        // Missing columns read the rows of the first and are multiplied by 0.
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

    /// Subtracts the contribution of all rows below from the pivots of the tile and solves for them.
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

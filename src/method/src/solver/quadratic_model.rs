//! The quadratic model of an objective at a point: gradient, Hessian and its factorization.

use crate::energy::{Assembly, Term};
use crate::numerics::block::{BlockPattern, Entry, Slots};
use crate::numerics::cholesky::{NotPositiveDefinite, SymmetricPattern, Work};
use crate::numerics::linear_solver::{LinearSolver, MOST_BYTES};

/// E(x + d) ≈ E(x) + g·d + ½d·Hd; rows and columns of fixed vertices are those of a multiple of the identity.
pub(super) struct QuadraticModel {
    pattern: BlockPattern,
    /// The linear solver; `None` before its first use.
    system: Option<LinearSolver>,
    /// `true` if the system was analyzed for another pattern.
    is_stale: bool,
    /// `true` if the system has a factorization for the vertices that are fixed now.
    is_factored: bool,
    factorizations: usize,
    /// Number of symbolic analyses.
    analyses: usize,
    gradient: Vec<f64>,
    hessian: Vec<f64>,
    fixed: FixedUnknowns,
    /// Mean diagonal of the energy's Hessian, without constraints.
    mean_diagonal: f64,
    /// Shift that regularizes, as a share of the mean diagonal.
    least_shift: f64,
    /// Sum of all shifts.
    shift: f64,
}

/// Diagonal shift, as a share of the mean diagonal: regularizes the rigid motions, which nothing else holds. A larger
/// shift slows the softest modes, a smaller one leaves the rigid motions to rounding.
const FREE_SHIFT: f64 = 1e-7;

/// The least shift after a factorization that failed although held vertices leave no rigid motion: several times the
/// rounding of a diagonal entry. Until then there is none: elements that are `a` times as long as high are `a`² times
/// softer along than across, so a shift damps the steps of thin bodies. A sheet of aspect 10⁶ that is bent
/// (`tests/deform/thin.rs`) takes 15 iterations without one, 126 with 1e-15 and over 1,900 with 1e-13.
const LEAST_SHIFT: f64 = 1e-15;

/// Factor by which that shift grows with each failure, as the shift of the paper, and falls with each success.
const SHIFT_STEP: f64 = 10.0;

/// Rigid motions that the fixed vertices leave to a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RigidMotions {
    /// Some part of the body may move as a rigid body, at no change of energy.
    #[default]
    Free,
    /// None: every part has fixed vertices that are not on one point or, in space, on one line.
    Held,
}

impl QuadraticModel {
    /// Creates a model of zeros with this pattern.
    pub fn new(pattern: BlockPattern) -> Self {
        Self {
            system: None,
            is_stale: false,
            is_factored: false,
            factorizations: 0,
            analyses: 0,
            gradient: vec![0.0; pattern.scalar().n],
            hessian: vec![0.0; pattern.scalar().row_idx.len()],
            fixed: FixedUnknowns::default(),
            mean_diagonal: 0.0,
            least_shift: FREE_SHIFT,
            shift: 0.0,
            pattern,
        }
    }

    /// Fixes these vertices and no others.
    pub fn hold(&mut self, vertices: &[u32]) {
        self.fixed = FixedUnknowns::new(&self.pattern, vertices);
        self.is_factored = false;
    }

    /// Sets which rigid motions the fixed vertices leave.
    pub fn set_rigid_motions(&mut self, motions: RigidMotions) {
        self.least_shift = match motions {
            RigidMotions::Free => FREE_SHIFT,
            RigidMotions::Held => 0.0,
        };
    }

    /// Raises the shift after a factorization that failed, at most to that of free rigid motions; returns `false` if it
    /// is there already.
    pub fn regularize(&mut self) -> bool {
        let raised = (SHIFT_STEP * self.least_shift).clamp(LEAST_SHIFT, FREE_SHIFT);
        std::mem::replace(&mut self.least_shift, raised) < FREE_SHIFT
    }

    /// Lowers a shift that was raised.
    fn lower_shift(&mut self) {
        if self.least_shift < FREE_SHIFT {
            let lowered = self.least_shift / SHIFT_STEP;
            self.least_shift = if lowered < LEAST_SHIFT { 0.0 } else { lowered };
        }
    }

    /// Replaces the pattern by another one with the same number of unknowns and zeros as values. The last factorization
    /// still solves.
    pub fn exchange_pattern(&mut self, pattern: BlockPattern) {
        self.fixed = FixedUnknowns::new(&pattern, &self.fixed.vertices(pattern.dim()));
        self.hessian = vec![0.0; pattern.scalar().row_idx.len()];
        self.pattern = pattern;
        self.is_stale = true;
        self.is_factored = false;
    }

    /// Clears the model. The caller then adds the summands, measures, adds the constraints and finishes.
    pub fn clear(&mut self) {
        self.gradient.fill(0.0);
        self.hessian.fill(0.0);
        self.shift = 0.0;
    }

    /// Adds the derivatives of a term.
    pub fn add(&mut self, term: &dyn Term, slots: &Slots, x: &[f64], tau: f64) {
        let Self {
            pattern,
            gradient,
            hessian,
            ..
        } = self;
        term.add_derivatives(
            x,
            tau,
            &mut Assembly::new(pattern, slots, gradient, hessian),
        );
    }

    /// Clears the gradient but not the Hessian; summands are added by [`add_gradient`](Self::add_gradient).
    pub fn clear_gradient(&mut self) {
        self.gradient.fill(0.0);
    }

    /// Adds the gradient of a term, except at fixed vertices.
    pub fn add_gradient(&mut self, term: &dyn Term, slots: &Slots, x: &[f64]) {
        let mut assembly = Assembly::of_gradient(&self.pattern, slots, &mut self.gradient);
        term.add_derivatives(x, 1.0, &mut assembly);
        self.fixed.clear_gradient(&mut self.gradient);
    }

    /// Stores the mean diagonal of the sum so far as that of the energy.
    pub fn measure(&mut self) {
        let diagonal = self.pattern.diagonal();
        let sum: f64 = diagonal.iter().map(|&slot| self.hessian[slot]).sum();
        self.mean_diagonal = sum / diagonal.len().max(1) as f64;
    }

    /// Regularizes the Hessian and takes the fixed vertices out.
    pub fn finish(&mut self) {
        self.shift_diagonal(self.least_shift * self.mean_diagonal + f64::MIN_POSITIVE);
        let diagonal = self.stand_in();
        let (hessian, gradient) = (&mut self.hessian, &mut self.gradient);
        self.fixed.clear(&self.pattern, hessian, gradient, diagonal);
    }

    /// Returns the diagonal entry of fixed vertices.
    fn stand_in(&self) -> f64 {
        self.mean_diagonal.max(f64::MIN_POSITIVE)
    }

    /// Adds `shift` to every diagonal entry.
    pub fn shift_diagonal(&mut self, shift: f64) {
        for &slot in self.pattern.diagonal() {
            self.hessian[slot] += shift;
        }
        self.shift += shift;
    }

    /// Orders and analyzes the pattern and allocates the solver's memory, once. Returns the solver, the pattern and H.
    pub fn prepare(&mut self) -> (&mut LinearSolver, &SymmetricPattern, &[f64]) {
        let Self {
            system,
            pattern,
            hessian,
            analyses,
            ..
        } = self;
        let (scalar, block) = (pattern.scalar(), pattern.dim());
        (
            system.get_or_insert_with(|| {
                *analyses += 1;
                LinearSolver::within(scalar, block, MOST_BYTES)
            }),
            scalar,
            hessian,
        )
    }

    /// Returns whether a factorization of H survives changes of H; `false` if none fits into memory.
    pub fn keeps_factor(&mut self) -> bool {
        matches!(self.prepare().0, LinearSolver::Direct(_))
    }

    /// Prepares solving with H: factors it, if that fits into memory.
    pub fn factor(&mut self) -> Result<(), NotPositiveDefinite> {
        if std::mem::take(&mut self.is_stale) {
            self.system = None;
        }
        self.factorizations += 1;
        let (system, _, hessian) = self.prepare();
        let factored = system.prepare(hessian);
        self.is_factored = factored.is_ok();
        if self.is_factored {
            self.lower_shift();
        }
        factored
    }

    /// Returns whether there is a factorization, perhaps of another point, for the vertices that are fixed now.
    pub fn is_factored(&mut self) -> bool {
        self.is_factored && self.keeps_factor()
    }

    /// Returns the number of factorizations, failed attempts included.
    pub fn factorizations(&self) -> usize {
        self.factorizations
    }

    /// Solves with the matrix that was factored last; if none fits into memory, with H.
    pub fn solve(&mut self, x: &mut [f64]) -> Result<(), NotPositiveDefinite> {
        let (system, pattern, hessian) = self.prepare();
        system.solve(pattern, hessian, x)
    }

    /// Computes Hv.
    pub fn apply(&self, vector: &[f64], product: &mut [f64]) {
        (self.pattern.scalar()).multiply(&self.hessian, vector, product);
    }

    /// Solves Hd = −g and returns −½g·d.
    pub fn newton_direction(&mut self, direction: &mut [f64]) -> Result<f64, NotPositiveDefinite> {
        self.factor()?;
        for (d, g) in direction.iter_mut().zip(&self.gradient) {
            *d = -g;
        }
        self.solve(direction)?;
        let slope = dot(&self.gradient, direction);
        if slope <= 0.0 {
            Ok(-0.5 * slope)
        } else {
            Err(NotPositiveDefinite)
        }
    }

    /// Computes the response of all vertices to the moves of the fixed ones in `direction` and to a pull that is added
    /// to the right-hand side.
    pub fn follow(
        &mut self,
        direction: &mut [f64],
        add_pull: impl FnOnce(&mut [f64]),
    ) -> Result<(), NotPositiveDefinite> {
        self.fixed.take_moves(direction);
        add_pull(direction);
        self.solve(direction)?;
        self.fixed.put_moves(direction);
        Ok(())
    }

    /// Computes the Newton step plus the response of all vertices to the moves of the fixed ones in `direction`, in one
    /// solve. Returns the norm of its right-hand side.
    pub fn step_and_follow(&mut self, direction: &mut [f64]) -> Result<f64, NotPositiveDefinite> {
        self.fixed.take_moves(direction);
        for (d, g) in direction.iter_mut().zip(&self.gradient) {
            *d -= g;
        }
        let norm = dot(direction, direction).sqrt();
        self.solve(direction)?;
        self.fixed.put_moves(direction);
        Ok(norm)
    }

    /// Returns g·d + ½d·Hd, fixed vertices included.
    pub fn change(&self, direction: &[f64]) -> f64 {
        let cleared = self.fixed.model_change(self.stand_in(), direction);
        dot(&self.gradient, direction) + 0.5 * self.curvature(direction) + cleared
    }

    /// Returns d·Hd.
    pub fn curvature(&self, direction: &[f64]) -> f64 {
        let pattern = self.pattern.scalar();
        let mut quadratic = 0.0;
        for j in 0..pattern.n {
            for slot in pattern.col_ptr[j]..pattern.col_ptr[j + 1] {
                quadratic += self.hessian[slot] * form(direction, pattern.row_idx[slot], j);
            }
        }
        quadratic
    }

    pub fn pattern(&self) -> &BlockPattern {
        &self.pattern
    }

    pub fn gradient(&self) -> &[f64] {
        &self.gradient
    }

    pub fn hessian(&self) -> &[f64] {
        &self.hessian
    }

    pub fn analyses(&self) -> usize {
        self.analyses
    }

    pub fn work(&self) -> Option<Work> {
        self.system.as_ref().and_then(LinearSolver::work)
    }

    pub fn mean_diagonal(&self) -> f64 {
        self.mean_diagonal
    }

    pub fn shift(&self) -> f64 {
        self.shift
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

// Fixed vertices: their rows and columns of a linear system are taken out and kept.

/// The fixed unknowns, and the entries of their rows and columns before these were replaced by rows of the identity.
#[derive(Default)]
pub(super) struct FixedUnknowns {
    unknowns: Vec<usize>,
    entries: Vec<Entry>,
    values: Vec<f64>,
    gradient: Vec<f64>,
    couplings: Vec<Coupling>,
    moves: Vec<f64>,
}

/// An entry that couples a fixed unknown with a free one; all three are indices.
struct Coupling {
    entry: u32,
    /// Index among the fixed unknowns.
    fixed: u32,
    free: usize,
}

impl FixedUnknowns {
    /// Fixes these vertices and no others.
    pub fn new(pattern: &BlockPattern, vertices: &[u32]) -> Self {
        let dim = pattern.dim();
        let mut chosen = vec![false; pattern.scalar().n / dim];
        for &v in vertices {
            chosen[v as usize] = true;
        }
        let unknowns = vertices
            .iter()
            .flat_map(|&v| dim * v as usize..dim * (v as usize + 1));
        let unknowns: Vec<usize> = unknowns.collect();
        let entries = pattern.rows_and_columns(&chosen);
        Self {
            values: vec![0.0; entries.len()],
            gradient: Vec::with_capacity(unknowns.len()),
            couplings: couplings(&entries, &unknowns, pattern.scalar().n),
            moves: Vec::with_capacity(unknowns.len()),
            unknowns,
            entries,
        }
    }

    /// Returns the fixed vertices; each has `dim` unknowns.
    pub fn vertices(&self, dim: usize) -> Vec<u32> {
        let firsts = self.unknowns.iter().step_by(dim);
        firsts.map(|&i| (i / dim) as u32).collect()
    }

    /// Clears the gradient, and the rows and columns except for a diagonal of this size.
    pub fn clear(
        &mut self,
        pattern: &BlockPattern,
        hessian: &mut [f64],
        gradient: &mut [f64],
        diagonal: f64,
    ) {
        for (value, entry) in self.values.iter_mut().zip(&self.entries) {
            *value = std::mem::take(&mut hessian[entry.slot]);
        }
        self.gradient.clear();
        for &i in &self.unknowns {
            self.gradient.push(std::mem::take(&mut gradient[i]));
            hessian[pattern.diagonal()[i]] = diagonal;
        }
    }

    /// Clears a gradient that is assembled without a Hessian.
    pub fn clear_gradient(&self, gradient: &mut [f64]) {
        for &i in &self.unknowns {
            gradient[i] = 0.0;
        }
    }

    /// Takes the moves of the fixed unknowns out of `direction` and leaves their effect on the free ones: a right-hand
    /// side.
    pub fn take_moves(&mut self, direction: &mut [f64]) {
        self.moves.clear();
        self.moves
            .extend(self.unknowns.iter().map(|&i| direction[i]));
        direction.fill(0.0);
        for coupling in &self.couplings {
            let value = self.values[coupling.entry as usize];
            direction[coupling.free] -= value * self.moves[coupling.fixed as usize];
        }
    }

    /// Puts the moves that were taken out back into `direction`.
    pub fn put_moves(&self, direction: &mut [f64]) {
        for (&i, value) in self.unknowns.iter().zip(&self.moves) {
            direction[i] = *value;
        }
    }

    /// Returns the change of g·d + ½d·Hd through clearing: the cleared terms minus those of the diagonal in their
    /// place.
    pub fn model_change(&self, diagonal: f64, direction: &[f64]) -> f64 {
        let mut change = 0.0;
        for (&i, g) in self.unknowns.iter().zip(&self.gradient) {
            change += g * direction[i] - 0.5 * diagonal * direction[i] * direction[i];
        }
        for (value, entry) in self.values.iter().zip(&self.entries) {
            change += 0.5 * value * form(direction, entry.row, entry.column);
        }
        change
    }
}

/// Returns the entries that couple one fixed and one free unknown.
fn couplings(entries: &[Entry], unknowns: &[usize], n: usize) -> Vec<Coupling> {
    let mut place = vec![None; n];
    for (k, &i) in unknowns.iter().enumerate() {
        place[i] = Some(k as u32);
    }
    let coupling = |(entry, e): (u32, &Entry)| {
        let (fixed, free) = match (place[e.row], place[e.column]) {
            (Some(fixed), None) => (fixed, e.column),
            (None, Some(fixed)) => (fixed, e.row),
            _ => return None,
        };
        Some(Coupling { entry, fixed, free })
    };
    (0..).zip(entries).filter_map(coupling).collect()
}

/// Returns the factor of the stored entry (`row`, `column`) of a symmetric matrix in d·Hd.
fn form(direction: &[f64], row: usize, column: usize) -> f64 {
    let product = direction[row] * direction[column];
    if row == column {
        product
    } else {
        2.0 * product
    }
}

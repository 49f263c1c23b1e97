//! Fixed vertices: their rows and columns of a linear system are taken out and kept.

use crate::numerics::block::{BlockPattern, Entry};

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
pub(super) fn form(direction: &[f64], row: usize, column: usize) -> f64 {
    let product = direction[row] * direction[column];
    if row == column {
        product
    } else {
        2.0 * product
    }
}

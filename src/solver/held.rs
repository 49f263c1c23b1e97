//! Vertices that are held: their rows and columns of a linear system, taken out and kept.

use crate::numerics::block::{BlockPattern, Entry};

/// Which vertices are held, and what stood in their rows and columns before they were made those of the identity.
#[derive(Default)]
pub(super) struct Held {
    unknowns: Vec<usize>,
    entries: Vec<Entry>,
    values: Vec<f64>,
    gradient: Vec<f64>,
}

impl Held {
    /// These vertices, and only these.
    pub fn new(pattern: &BlockPattern, vertices: &[u32]) -> Self {
        let dim = pattern.dim();
        let mut chosen = vec![false; pattern.scalar().n / dim];
        for &v in vertices {
            chosen[v as usize] = true;
        }
        let unknowns = vertices
            .iter()
            .flat_map(|&v| dim * v as usize..dim * (v as usize + 1));
        let entries = pattern.rows_and_columns(&chosen);
        Self {
            values: vec![0.0; entries.len()],
            gradient: Vec::new(),
            unknowns: unknowns.collect(),
            entries,
        }
    }

    /// Clears rows and columns but for a diagonal of this size, and the gradient.
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

    /// Takes the moves of the held unknowns out of `direction`, and leaves in it what these moves do to the others: a right
    /// side to solve for.
    pub fn take_moves(&self, direction: &mut [f64]) -> Vec<f64> {
        let moves: Vec<f64> = self.unknowns.iter().map(|&i| direction[i]).collect();
        let mut of_held = vec![None; direction.len()];
        for (&i, &value) in self.unknowns.iter().zip(&moves) {
            of_held[i] = Some(value);
        }
        direction.fill(0.0);
        for (&value, entry) in self.values.iter().zip(&self.entries) {
            match (of_held[entry.row], of_held[entry.column]) {
                (Some(row), None) => direction[entry.column] -= value * row,
                (None, Some(column)) => direction[entry.row] -= value * column,
                _ => {}
            }
        }
        moves
    }

    /// Puts the moves of the held unknowns back.
    pub fn put_moves(&self, moves: &[f64], direction: &mut [f64]) {
        for (&i, value) in self.unknowns.iter().zip(moves) {
            direction[i] = *value;
        }
    }

    /// What was cleared of g·d + ½d·Hd, less what now stands in its place.
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

/// What a stored entry of a symmetric matrix is multiplied with in d·Hd.
pub(super) fn form(direction: &[f64], row: usize, column: usize) -> f64 {
    let product = direction[row] * direction[column];
    if row == column {
        product
    } else {
        2.0 * product
    }
}

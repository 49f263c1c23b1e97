//! The pattern of a matrix of D×D blocks, one for each vertex and each pair of vertices that share a stencil.

use super::cholesky::SymmetricPattern;
use super::square::Matrix;
use super::stencils::Stencils;

/// The lower triangle of such a matrix, entry by entry: unknowns `Dv` to `Dv + D − 1` belong to vertex `v`.
#[derive(Clone, Debug)]
pub struct BlockPattern {
    dim: usize,
    scalar: SymmetricPattern,
}

/// Places of the blocks of one term's pairs of vertices in the values of a [`BlockPattern`], in the order of
/// [`Stencils::pairs`]. Found once, so that adding a stencil's Hessian takes only additions at known places.
#[derive(Clone, Debug)]
pub struct Slots {
    /// First pair of each stencil.
    starts: Vec<u32>,
    pairs: Vec<PairSlot>,
}

/// Place of the block of two vertices: that of its first entry, and the distance between the columns of the smaller
/// vertex.
#[derive(Clone, Copy, Debug, Default)]
pub struct PairSlot {
    first: u32,
    stride: u32,
}

impl BlockPattern {
    /// Creates the pattern of `n_vertices` vertices with `dim` coordinates, 2 or 3, and the slots of each term's
    /// stencils.
    ///
    /// # Panics
    /// If a stencil names a vertex that does not exist.
    pub fn new(dim: usize, n_vertices: usize, terms: &[Stencils]) -> (Self, Vec<Slots>) {
        let (starts, neighbors) =
            larger_neighbors(n_vertices, || terms.iter().flat_map(Stencils::pairs));
        let scalar = scalar_pattern(dim, &starts, &neighbors);
        let slot = |(small, large): (u32, u32)| {
            let small = small as usize;
            let list = &neighbors[starts[small]..starts[small + 1]];
            let rank = list.partition_point(|&v| v < large);
            // The first column of a vertex starts with the rows of its own block.
            PairSlot {
                first: (scalar.col_ptr[dim * small] + dim + dim * rank) as u32,
                stride: (dim * list.len()) as u32,
            }
        };
        let slots = terms
            .iter()
            .map(|stencils| Slots::new(stencils, slot))
            .collect();
        (Self { dim, scalar }, slots)
    }

    /// Returns the slots of more stencils; `None` if a pair has no block in this pattern.
    pub fn slots(&self, stencils: &Stencils) -> Option<Slots> {
        let mut are_all_here = true;
        let slot = |(small, large): (u32, u32)| {
            let found = self.pair_slot(small as usize, large as usize);
            are_all_here &= found.is_some();
            found.unwrap_or_default()
        };
        let slots = Slots::new(stencils, slot);
        are_all_here.then_some(slots)
    }

    fn pair_slot(&self, small: usize, large: usize) -> Option<PairSlot> {
        let (dim, pattern) = (self.dim, &self.scalar);
        let column = *pattern.col_ptr.get(dim * small)?..*pattern.col_ptr.get(dim * small + 1)?;
        let others = column.start + dim..column.end;
        let rank = pattern.row_idx[others.clone()]
            .binary_search(&(dim * large))
            .ok()?;
        Some(PairSlot {
            first: (others.start + rank) as u32,
            stride: others.len() as u32,
        })
    }

    /// Returns the pattern entry by entry.
    pub fn scalar(&self) -> &SymmetricPattern {
        &self.scalar
    }

    /// Returns the number of coordinates per vertex.
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// Adds the symmetric block of one vertex; only its lower triangle is read.
    pub fn add_diagonal<const D: usize>(&self, values: &mut [f64], vertex: u32, block: &Matrix<D>) {
        for column in 0..D {
            let first = self.scalar.col_ptr[D * vertex as usize + column];
            for row in column..D {
                values[first + row - column] += block[row][column];
            }
        }
    }

    /// Adds the block of two vertices, its rows those of the larger.
    pub fn add_pair<const D: usize>(values: &mut [f64], slot: PairSlot, block: &Matrix<D>) {
        let mut first = slot.first as usize;
        for column in 0..D {
            for (row, value) in values[first..first + D].iter_mut().enumerate() {
                *value += block[row][column];
            }
            // A column's own block loses a row from one column to the next.
            first += slot.stride as usize + D - 1 - column;
        }
    }

    /// Adds a multiple of the identity to the block of one vertex.
    pub fn add_diagonal_identity(&self, values: &mut [f64], vertex: u32, share: f64) {
        let first = self.dim * vertex as usize;
        for &slot in &self.scalar.col_ptr[first..first + self.dim] {
            values[slot] += share;
        }
    }

    /// Adds a multiple of the identity to the block of two vertices.
    pub fn add_pair_identity(&self, values: &mut [f64], slot: PairSlot, share: f64) {
        let mut first = slot.first as usize;
        for column in 0..self.dim {
            values[first + column] += share;
            first += slot.stride as usize + self.dim - 1 - column;
        }
    }

    /// Returns the slots of the diagonal entries, one for each unknown.
    pub fn diagonal(&self) -> &[usize] {
        &self.scalar.col_ptr[..self.scalar.n]
    }

    /// Returns every slot in the rows and columns of the vertices for which `chosen` is true, including the diagonal,
    /// with its row and column.
    pub fn rows_and_columns(&self, chosen: &[bool]) -> Vec<Entry> {
        let pattern = &self.scalar;
        let chosen = |unknown: usize| chosen[unknown / self.dim];
        let entry = |column: usize, slot: usize| Entry {
            slot,
            row: pattern.row_idx[slot],
            column,
        };
        (0..pattern.n)
            .flat_map(|j| {
                (pattern.col_ptr[j]..pattern.col_ptr[j + 1]).map(move |slot| entry(j, slot))
            })
            .filter(|entry| chosen(entry.row) || chosen(entry.column))
            .collect()
    }
}

/// A stored entry of a symmetric matrix.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Place in the values.
    pub slot: usize,
    /// Row.
    pub row: usize,
    /// Column, at most the row.
    pub column: usize,
}

impl Slots {
    fn new(stencils: &Stencils, slot: impl FnMut((u32, u32)) -> PairSlot) -> Self {
        let mut starts = vec![0];
        for stencil in stencils.iter() {
            let n = stencil.len() as u32;
            starts.push(starts[starts.len() - 1] + n * n.saturating_sub(1) / 2);
        }
        Self {
            starts,
            pairs: stencils.pairs().map(slot).collect(),
        }
    }

    /// Returns the slots of a stencil's pairs of vertices.
    pub fn of(&self, stencil: usize) -> &[PairSlot] {
        &self.pairs[self.starts[stencil] as usize..self.starts[stencil + 1] as usize]
    }
}

/// Returns for each vertex its neighbors with a larger index, sorted: `neighbors[starts[v]..starts[v + 1]]`.
fn larger_neighbors<P: Iterator<Item = (u32, u32)>>(
    n_vertices: usize,
    pairs: impl Fn() -> P,
) -> (Vec<usize>, Vec<u32>) {
    // Count the pairs of each smaller vertex.
    let mut bucket_ends = vec![0; n_vertices + 1];
    for (small, _) in pairs() {
        bucket_ends[small as usize + 1] += 1;
    }
    for v in 0..n_vertices {
        bucket_ends[v + 1] += bucket_ends[v];
    }
    // Put the larger vertices into the buckets of the smaller ones.
    let mut buckets = vec![0; bucket_ends[n_vertices]];
    let mut next = bucket_ends.clone();
    for (small, large) in pairs() {
        assert!(
            (large as usize) < n_vertices,
            "a stencil names a vertex that there is not"
        );
        buckets[next[small as usize]] = large;
        next[small as usize] += 1;
    }
    // Sort each bucket and drop repetitions: stencils share pairs.
    let mut starts = vec![0];
    let mut neighbors = Vec::with_capacity(buckets.len());
    for v in 0..n_vertices {
        let bucket = &mut buckets[bucket_ends[v]..bucket_ends[v + 1]];
        bucket.sort_unstable();
        for &large in bucket.iter() {
            if neighbors[starts[v]..].last() != Some(&large) {
                neighbors.push(large);
            }
        }
        starts.push(neighbors.len());
    }
    (starts, neighbors)
}

fn scalar_pattern(dim: usize, starts: &[usize], neighbors: &[u32]) -> SymmetricPattern {
    let n_vertices = starts.len() - 1;
    let mut col_ptr = Vec::with_capacity(dim * n_vertices + 1);
    let mut row_idx = Vec::with_capacity(dim * dim * (n_vertices + neighbors.len()));
    col_ptr.push(0);
    for v in 0..n_vertices {
        for first_row in dim * v..dim * (v + 1) {
            row_idx.extend(first_row..dim * (v + 1));
            for &large in &neighbors[starts[v]..starts[v + 1]] {
                let large = dim * large as usize;
                row_idx.extend(large..large + dim);
            }
            col_ptr.push(row_idx.len());
        }
    }
    SymmetricPattern {
        n: dim * n_vertices,
        col_ptr,
        row_idx,
    }
}

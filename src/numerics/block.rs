//! The pattern of a matrix of 2×2 blocks, one for each vertex and each pair of vertices of a triangle.

use super::cholesky::SymmetricPattern;

/// Where the blocks of every triangle go in the value array of a [`SymmetricPattern`].
///
/// Unknowns `2v` and `2v + 1` belong to vertex `v`. The slots are found once, so that adding a triangle's Hessian is
/// twelve blocks' worth of plain additions at known places.
#[derive(Clone, Debug)]
pub struct BlockPattern {
    scalar: SymmetricPattern,
    pairs: Vec<[PairSlot; 3]>,
}

/// The place of the block of two vertices: of its first and its second column.
#[derive(Clone, Copy, Debug, Default)]
pub struct PairSlot {
    columns: [u32; 2],
}

impl BlockPattern {
    /// The pattern of `n_vertices` vertices and of triangles whose vertices are in increasing order.
    ///
    /// # Panics
    /// If a triangle names a vertex that there is not.
    pub fn new(n_vertices: usize, triangles: impl Iterator<Item = [u32; 3]> + Clone) -> Self {
        let (starts, neighbours) = larger_neighbours(n_vertices, triangles.clone());
        let scalar = scalar_pattern(&starts, &neighbours);
        let slot = |small: u32, large: u32| {
            let small = small as usize;
            let list = &neighbours[starts[small]..starts[small + 1]];
            let rank = list.partition_point(|&v| v < large);
            // The first column starts with the two rows of the diagonal block, the second with one.
            let columns = [
                scalar.col_ptr[2 * small] + 2 + 2 * rank,
                scalar.col_ptr[2 * small + 1] + 1 + 2 * rank,
            ];
            PairSlot {
                columns: columns.map(|slot| slot as u32),
            }
        };
        let pairs = triangles
            .map(|[a, b, c]| [slot(a, b), slot(a, c), slot(b, c)])
            .collect();
        Self { scalar, pairs }
    }

    /// The same pattern, entry by entry.
    pub fn scalar(&self) -> &SymmetricPattern {
        &self.scalar
    }

    /// The slots of a triangle's pairs of vertices: first and second, first and third, second and third.
    pub fn pairs(&self, triangle: usize) -> [PairSlot; 3] {
        self.pairs[triangle]
    }

    /// Adds the symmetric block `[h00, h10, h11]` of one vertex.
    pub fn add_diagonal(&self, values: &mut [f64], vertex: u32, block: [f64; 3]) {
        let first = self.scalar.col_ptr[2 * vertex as usize];
        values[first] += block[0];
        values[first + 1] += block[1];
        values[self.scalar.col_ptr[2 * vertex as usize + 1]] += block[2];
    }

    /// Adds the block of two vertices, its rows those of the larger: `block[column][row]`.
    pub fn add_pair(&self, values: &mut [f64], slot: PairSlot, block: [[f64; 2]; 2]) {
        for (column, slot) in block.iter().zip(slot.columns) {
            values[slot as usize] += column[0];
            values[slot as usize + 1] += column[1];
        }
    }

    /// The slots of the diagonal entries, one for each unknown.
    pub fn diagonal(&self) -> &[usize] {
        &self.scalar.col_ptr[..self.scalar.n]
    }

    /// Every slot in the rows and columns of the vertices for which `chosen` is true, the diagonal included.
    pub fn rows_and_columns(&self, chosen: &[bool]) -> Vec<usize> {
        let pattern = &self.scalar;
        (0..pattern.n)
            .flat_map(|j| {
                (pattern.col_ptr[j]..pattern.col_ptr[j + 1])
                    .filter(move |&slot| chosen[j / 2] || chosen[pattern.row_idx[slot] / 2])
            })
            .collect()
    }
}

/// For each vertex its neighbours with a larger index, sorted: `neighbours[starts[v]..starts[v + 1]]`.
fn larger_neighbours(
    n_vertices: usize,
    triangles: impl Iterator<Item = [u32; 3]> + Clone,
) -> (Vec<usize>, Vec<u32>) {
    let mut bucket_ends = vec![0; n_vertices + 1];
    for [a, b, _] in triangles.clone() {
        bucket_ends[a as usize + 1] += 2;
        bucket_ends[b as usize + 1] += 1;
    }
    for v in 0..n_vertices {
        bucket_ends[v + 1] += bucket_ends[v];
    }
    let mut buckets = vec![0; bucket_ends[n_vertices]];
    let mut next = bucket_ends.clone();
    for [a, b, c] in triangles {
        for (small, large) in [(a, b), (a, c), (b, c)] {
            buckets[next[small as usize]] = large;
            next[small as usize] += 1;
        }
    }
    let mut starts = vec![0];
    let mut neighbours = Vec::with_capacity(buckets.len());
    for v in 0..n_vertices {
        let bucket = &mut buckets[bucket_ends[v]..bucket_ends[v + 1]];
        bucket.sort_unstable();
        for &large in bucket.iter() {
            if neighbours[starts[v]..].last() != Some(&large) {
                neighbours.push(large);
            }
        }
        starts.push(neighbours.len());
    }
    (starts, neighbours)
}

fn scalar_pattern(starts: &[usize], neighbours: &[u32]) -> SymmetricPattern {
    let n_vertices = starts.len() - 1;
    let mut col_ptr = Vec::with_capacity(2 * n_vertices + 1);
    let mut row_idx = Vec::with_capacity(3 * n_vertices + 4 * neighbours.len());
    col_ptr.push(0);
    for v in 0..n_vertices {
        for first_row in [2 * v, 2 * v + 1] {
            row_idx.extend(first_row..2 * v + 2);
            for &large in &neighbours[starts[v]..starts[v + 1]] {
                row_idx.extend([2 * large as usize, 2 * large as usize + 1]);
            }
            col_ptr.push(row_idx.len());
        }
    }
    SymmetricPattern {
        n: 2 * n_vertices,
        col_ptr,
        row_idx,
    }
}

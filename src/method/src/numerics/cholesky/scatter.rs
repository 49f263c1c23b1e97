//! Places of the matrix entries in the fronts.

use super::fronts::{Front, Fronts};
use super::graph::Graph;
use super::pattern::SymmetricPattern;

/// The stored block of two coupled vertices, or of one, and its place in a panel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    /// First entry in the values.
    from: u32,
    /// Distance between the columns of its first vertex there, plus the entries lost at the diagonal.
    stride: u32,
    /// First entry in the panel.
    to: u32,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Diagonal,
    Straight,
    /// Block of two vertices, where the larger one is eliminated first.
    Transposed,
}

/// Blocks of every front's panel; those of the k-th are `blocks[starts[k]..starts[k + 1]]`.
pub(super) struct Scatter {
    starts: Vec<usize>,
    blocks: Vec<Block>,
    size: usize,
}

impl Scatter {
    /// Creates the places; `graph` and `reordered` are the pattern's graph in its own numbering and in that of the
    /// elimination.
    pub fn new(
        pattern: &SymmetricPattern,
        size: usize,
        graph: &Graph,
        reordered: &Graph,
        order: &[u32],
        fronts: &Fronts,
    ) -> Self {
        let mut scatter = Self {
            starts: vec![0],
            blocks: Vec::with_capacity(graph.n() + graph.neighbors().len() / 2),
            size,
        };
        for front in &fronts.list {
            let first = front.first / size;
            for j in first..first + front.pivots / size {
                let column = (j - first) * size;
                let own = order[j];
                scatter.blocks.push(Block {
                    from: pattern.col_ptr[size * own as usize] as u32,
                    stride: stride(graph, own, size),
                    to: (column * front.stride() + column) as u32,
                    kind: Kind::Diagonal,
                });
                for &i in reordered.of(j as u32).iter().filter(|&&i| i as usize > j) {
                    let row = front.row(i, size, &fronts.rows);
                    let to = column * front.stride() + row;
                    scatter.blocks.push(Block::of_pair(
                        pattern,
                        size,
                        graph,
                        [own, order[i as usize]],
                        to as u32,
                    ));
                }
            }
            scatter.starts.push(scatter.blocks.len());
        }
        scatter
    }

    /// Adds a front's share of the matrix to its panel.
    pub fn add(&self, front: usize, values: &[f64], panel: &mut [f64], panel_stride: usize) {
        let blocks = &self.blocks[self.starts[front]..self.starts[front + 1]];
        match self.size {
            1 => add_blocks::<1>(blocks, values, panel, panel_stride),
            2 => add_blocks::<2>(blocks, values, panel, panel_stride),
            _ => add_blocks::<3>(blocks, values, panel, panel_stride),
        }
    }
}

/// Returns the number of entries of a vertex's first column below its own block.
fn stride(graph: &Graph, vertex: u32, size: usize) -> u32 {
    let list = graph.of(vertex);
    (size * (list.len() - list.partition_point(|&w| w < vertex))) as u32
}

impl Block {
    /// Creates the block of a vertex that is eliminated and one that is eliminated later.
    fn of_pair(
        pattern: &SymmetricPattern,
        size: usize,
        graph: &Graph,
        [own, other]: [u32; 2],
        to: u32,
    ) -> Self {
        let (small, large) = (own.min(other), own.max(other));
        let list = graph.of(small);
        let rank = list.partition_point(|&w| w < large) - list.partition_point(|&w| w < small);
        Self {
            from: (pattern.col_ptr[size * small as usize] + size + size * rank) as u32,
            stride: stride(graph, small, size),
            to,
            kind: if own < other {
                Kind::Straight
            } else {
                Kind::Transposed
            },
        }
    }
}

impl Front {
    /// Returns the row of a vertex in the panel.
    fn row(&self, vertex: u32, size: usize, rows: &[u32]) -> usize {
        let unknown = size * vertex as usize;
        if unknown < self.first + self.pivots {
            unknown - self.first
        } else {
            self.padded() + size * rows[self.rows.clone()].partition_point(|&w| w < vertex)
        }
    }
}

fn add_blocks<const D: usize>(
    blocks: &[Block],
    values: &[f64],
    panel: &mut [f64],
    panel_stride: usize,
) {
    for block in blocks {
        let (mut from, to) = (block.from as usize, block.to as usize);
        for c in 0..D {
            match block.kind {
                Kind::Diagonal => {
                    for r in c..D {
                        panel[to + c * panel_stride + r] += values[from + r - c];
                    }
                    from += block.stride as usize + D - c;
                }
                Kind::Straight | Kind::Transposed => {
                    let straight = matches!(block.kind, Kind::Straight);
                    for r in 0..D {
                        let (row, column) = if straight { (r, c) } else { (c, r) };
                        panel[to + column * panel_stride + row] += values[from + r];
                    }
                    from += block.stride as usize + D - 1 - c;
                }
            }
        }
    }
}

//! Whether the boundary of a map keeps a distance from itself.

use static_aabb2d_index::StaticAABB2DIndexBuilder;

use crate::numerics::predicates::orient2d_sign;
use crate::numerics::vec2::{dot, squared_distance, sub};

/// Edges that less than so many times the distance lies between on their loop are not compared: that they are near says only that
/// edges are short.
const BETWEEN: f64 = 4.0;

/// Whether no two edges of the boundary loops of a map come nearer to each other than a part of its extent, but for those that
/// follow each other. O(n log n) for boundaries that do not lie in heaps.
pub fn keeps_apart(loops: &[Vec<u32>], uv: &[[f64; 2]], part: f64) -> bool {
    let edges: Vec<Edge> = (0..)
        .zip(loops)
        .flat_map(|(n, l)| edges(n, l, uv))
        .collect();
    let mut builder = StaticAABB2DIndexBuilder::new(edges.len());
    for edge in &edges {
        let [low, high] = edge.bounds();
        builder.add(low[0], low[1], high[0], high[1]);
    }
    let Ok(index) = builder.build() else {
        return false;
    };
    let Some(all) = index.bounds() else {
        return true;
    };
    let least = part * (all.max_x - all.min_x).max(all.max_y - all.min_y);
    edges.iter().enumerate().all(|(i, edge)| {
        let [[x, y], [right, top]] = edge.bounds();
        index
            .query_iter(x - least, y - least, right + least, top + least)
            .filter(|&j| j > i && edge.between(&edges[j]) > BETWEEN * least)
            .all(|j| !edge.is_near(&edges[j], least))
    })
}

/// An edge of a boundary loop.
struct Edge {
    ends: [[f64; 2]; 2],
    number_of_loop: usize,
    length_of_loop: f64,
    /// The length of the loop up to its ends.
    at: [f64; 2],
}

/// The edges of a loop in its order.
fn edges(number_of_loop: usize, vertices: &[u32], uv: &[[f64; 2]]) -> Vec<Edge> {
    let mut length_of_loop = 0.0;
    let after = vertices.iter().cycle().skip(1);
    let mut edges: Vec<Edge> = (vertices.iter().zip(after))
        .map(|(&v, &w)| {
            let ends = [v, w].map(|v| uv[v as usize]);
            let along = sub(ends[1], ends[0]);
            let begin = length_of_loop;
            length_of_loop += dot(along, along).sqrt();
            Edge {
                ends,
                number_of_loop,
                length_of_loop,
                at: [begin, length_of_loop],
            }
        })
        .collect();
    for edge in &mut edges {
        edge.length_of_loop = length_of_loop;
    }
    edges
}

impl Edge {
    /// Smallest and greatest coordinates.
    fn bounds(&self) -> [[f64; 2]; 2] {
        let [a, b] = self.ends;
        [f64::min, f64::max].map(|of: fn(f64, f64) -> f64| [0, 1].map(|k| of(a[k], b[k])))
    }

    /// The length of the loop between this and a later edge, on the shorter way; infinite between loops.
    fn between(&self, later: &Self) -> f64 {
        if self.number_of_loop != later.number_of_loop {
            return f64::INFINITY;
        }
        let around = self.at[0] + self.length_of_loop - later.at[1];
        (later.at[0] - self.at[1]).min(around)
    }

    fn is_near(&self, other: &Self, distance: f64) -> bool {
        let sides = |[a, b]: [[f64; 2]; 2], of: [[f64; 2]; 2]| of.map(|p| orient2d_sign(a, b, p));
        let crosses = |[a, b]: [i8; 2]| a * b < 0;
        if crosses(sides(self.ends, other.ends)) && crosses(sides(other.ends, self.ends)) {
            return true;
        }
        let nearest = |ends: [[f64; 2]; 2], of: [[f64; 2]; 2]| {
            of.map(|p| squared_distance(p, ends))
                .into_iter()
                .fold(f64::INFINITY, f64::min)
        };
        let squared = nearest(self.ends, other.ends).min(nearest(other.ends, self.ends));
        squared < distance * distance
    }
}

//! Closed polygons that keep a distance from themselves and each other.

use super::box_index::BoxIndex;
use super::segments::{Segment, segment_distance};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of, widened};
use unwrapd_method::numerics::vec2::{dot, sub};

/// Least path between two edges along their polygon, as a multiple of the distance, for them to be compared: nearer
/// ones are close only because edges are short.
const BETWEEN: f64 = 4.0;

/// Returns whether no two edges of closed polygons, except consecutive ones, come nearer to each other than the share
/// `part` of the extent of all. O(n log n) unless the edges lie in heaps.
pub fn keep_apart(polygons: &[Vec<[f64; 2]>], part: f64) -> bool {
    let edges: Vec<PlaneEdge> = (polygons.iter().enumerate())
        .flat_map(|(polygon, vertices)| edges(polygon, vertices))
        .collect();
    let boxes: Vec<Bounds> = edges.iter().map(|edge| bounds_of(&edge.ends)).collect();
    let [low, high] = bounds_of(polygons.concat().as_slice());
    let least = part * (high[0] - low[0]).max(high[1] - low[1]);
    let index = BoxIndex::new(&boxes);
    (edges.iter().zip(0..)).all(|(edge, i)| {
        let mut is_near = false;
        index.meeting(&widened(boxes[i as usize], least), |j| {
            let other = &edges[j as usize];
            is_near |= j > i
                && edge.way_to(other) > BETWEEN * least
                && segment_distance(edge.ends, other.ends) < least;
        });
        !is_near
    })
}

struct PlaneEdge {
    ends: Segment,
    polygon: usize,
    /// Arc length of the polygon at each end.
    at: [f64; 2],
    length: f64,
}

impl PlaneEdge {
    /// Returns the length of the shorter path along the polygon to a later edge; infinite to another polygon.
    fn way_to(&self, later: &Self) -> f64 {
        if self.polygon != later.polygon {
            return f64::INFINITY;
        }
        let around = self.at[0] + self.length - later.at[1];
        (later.at[0] - self.at[1]).min(around)
    }
}

/// Returns the edges of a closed polygon.
fn edges(polygon: usize, vertices: &[[f64; 2]]) -> Vec<PlaneEdge> {
    let after = vertices.iter().cycle().skip(1);
    let ends: Vec<Segment> = vertices.iter().zip(after).map(|(&p, &q)| [p, q]).collect();
    let mut at = vec![0.0];
    for &[p, q] in &ends {
        let along = sub(q, p);
        at.push(at[at.len() - 1] + dot(along, along).sqrt());
    }
    (ends.iter().zip(at.windows(2)))
        .map(|(&ends, of_ends)| PlaneEdge {
            ends,
            polygon,
            at: [of_ends[0], of_ends[1]],
            length: at[at.len() - 1],
        })
        .collect()
}

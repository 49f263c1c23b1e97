//! Closed polygons.

use super::box_index::{BoxIndex, Visit, search_budget};
use super::segments::{Segment, meet, turns_back};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of};
use unwrapd_method::numerics::vec2::doubled_area;

/// Returns twice the signed area of a closed polygon, rounded.
pub fn doubled_polygon_area(polygon: &[[f64; 2]]) -> f64 {
    let after = polygon.iter().skip(1);
    let edges = polygon.iter().zip(after);
    edges.map(|(&p, &q)| doubled_area(polygon[0], p, q)).sum()
}

/// Returns a vertex near which closed polygons cross or touch themselves or each other, exactly; the first vertex of
/// the first such edge.
pub fn meeting_point(polygons: &[Vec<[f64; 2]>]) -> Option<[f64; 2]> {
    let (mut edges, mut next): (Vec<Segment>, Vec<u32>) = (Vec::new(), Vec::new());
    for polygon in polygons {
        let (first, n) = (edges.len(), polygon.len());
        edges.extend((0..n).map(|k| [polygon[k], polygon[(k + 1) % n]]));
        next.extend((0..n).map(|k| (first + (k + 1) % n) as u32));
    }
    let boxes: Vec<Bounds> = edges.iter().map(|edge| bounds_of(edge)).collect();
    let mut found: Option<u32> = None;
    let visit = BoxIndex::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
        let [a, b] = [i, j].map(|k| edges[k as usize]);
        let do_meet = if next[i as usize] == j {
            turns_back(a, b)
        } else if next[j as usize] == i {
            turns_back(b, a)
        } else {
            meet(a, b)
        };
        if do_meet {
            found = Some(found.unwrap_or(u32::MAX).min(i).min(j));
        }
    });
    // Only edges that lie in heaps exhaust the search; they would have to meet.
    let first = found.or((visit == Visit::Truncated).then_some(0));
    first.map(|edge| edges[edge as usize][0])
}

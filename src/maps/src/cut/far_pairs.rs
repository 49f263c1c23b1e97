//! Pairs of vertices that are far apart.

use super::Sheet;
use super::distances::{Neighbors, distances};

/// Most vertices whose farthest vertices are searched.
const MOST_ENDS: usize = 5;

/// Returns at most `most` different pairs of vertices, the second the farthest from the first; `is_end` holds for both.
///
/// The first vertices lie as far from each other as possible, and the first pair is approximately the farthest of all.
/// The result does not depend on the numbers of the vertices, except for ties. From: Gonzalez 1985, Clustering to
/// Minimize the Maximum Intercluster Distance.
pub fn far_pairs(
    sheet: &Sheet,
    neighbors: &Neighbors,
    length: &impl Fn(u32) -> f64,
    is_end: &impl Fn(u32) -> bool,
    most: usize,
) -> Vec<[u32; 2]> {
    let from = |v: u32| distances(sheet, neighbors, [v], length).distance;
    let farthest = |distances: &[f64]| {
        let ends = (0u32..).zip(distances);
        let ends = ends.filter(|&(v, d)| d.is_finite() && is_end(v));
        let farthest = ends.max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(&a.0)));
        farthest.map(|(v, _)| v)
    };
    let mut nearest = vec![f64::INFINITY; sheet.positions.len()];
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    let mut next = (sheet.outermost(is_end)).and_then(|start| farthest(&from(start)));
    for _ in 0..MOST_ENDS {
        let Some(a) = next.filter(|_| pairs.len() < most) else {
            break;
        };
        let from_a = from(a);
        if let Some(b) = farthest(&from_a)
            && !pairs.contains(&[a, b])
            && !pairs.contains(&[b, a])
        {
            pairs.push([a, b]);
        }
        for (nearest, from_a) in nearest.iter_mut().zip(from_a) {
            *nearest = nearest.min(from_a);
        }
        next = farthest(&nearest);
    }
    pairs
}

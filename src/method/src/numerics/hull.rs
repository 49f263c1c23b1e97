//! Convex hulls in the plane.

use super::vec2::doubled_area;

/// Returns the corners of the convex hull of points, counter-clockwise; an empty list if all points are equal.
///
/// From: Andrew 1979 (monotone chain).
pub fn convex_hull(points: impl IntoIterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut sorted: Vec<[f64; 2]> = points.into_iter().collect();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    let mut hull: Vec<[f64; 2]> = Vec::new();
    for _ in 0..2 {
        let start = hull.len();
        for &p in &sorted {
            while hull.len() >= start + 2
                && doubled_area(hull[hull.len() - 2], hull[hull.len() - 1], p) <= 0.0
            {
                hull.pop();
            }
            hull.push(p);
        }
        hull.pop();
        sorted.reverse();
    }
    hull
}

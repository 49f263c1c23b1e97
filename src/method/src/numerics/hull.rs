//! Convex hulls in the plane.

use super::vec2::{doubled_area, sub};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

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

/// Rectangle around a convex hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enclosure {
    /// Its area.
    pub area: f64,
    /// Angle of its longer side, in radians, counter-clockwise.
    pub angle: f64,
}

impl Enclosure {
    fn of_area(area: f64) -> Self {
        Self { area, angle: 0.0 }
    }
}

/// Returns the smallest rectangle around a convex hull; of area 0 for a point.
///
/// One of its sides lies on an edge of the hull. O(n log n). From: Freeman, Shapira 1975.
pub fn smallest_rectangle(hull: &[[f64; 2]]) -> Enclosure {
    if hull.len() < 2 {
        return Enclosure::of_area(0.0);
    }
    let mut smallest = Enclosure::of_area(f64::INFINITY);
    let corners = Corners::of(hull);
    for &angle in &corners.edge_angles {
        let [width, height] = [angle, angle + FRAC_PI_2].map(|angle| {
            let (sin, cos) = angle.sin_cos();
            let [x, y] = corners.across(angle);
            x * cos + y * sin
        });
        if width * height < smallest.area {
            smallest = Enclosure {
                area: width * height,
                angle: if width < height {
                    angle + FRAC_PI_2
                } else {
                    angle
                },
            };
        }
    }
    smallest
}

/// Returns the smallest page around a convex hull, at any angle: a rectangle whose sides are as 1 to `aspect`, which is at least 1. Its
/// area is 0 for a point.
///
/// Between the angles at which an edge of the hull lies along a side, width and height turn about fixed corners, so the smallest
/// page has an edge along a side, or the hull fills it both ways. O(n log n).
pub fn smallest_page(hull: &[[f64; 2]], aspect: f64) -> Enclosure {
    if hull.len() < 2 {
        return Enclosure::of_area(0.0);
    }
    let mut smallest = Enclosure::of_area(f64::INFINITY);
    let corners = Corners::of(hull);
    let root = aspect.sqrt();
    // Side of the square that is left when the page is squeezed to one of the same area.
    let side = |angle: f64, across: [[f64; 2]; 2]| {
        let (sin, cos) = angle.sin_cos();
        let [[a, b], [c, d]] = across;
        let [width, height] = [a * cos + b * sin, d * cos - c * sin];
        (width * root).max(height / root)
    };
    let mut angles: Vec<f64> = (corners.edge_angles.iter())
        .map(|angle| angle.rem_euclid(FRAC_PI_2))
        .collect();
    angles.sort_by(f64::total_cmp);
    angles.dedup();
    let ends = angles
        .iter()
        .skip(1)
        .copied()
        .chain([angles[0] + FRAC_PI_2]);
    for (&from, to) in angles.iter().zip(ends) {
        for quarter in [0.0, FRAC_PI_2] {
            let [from, to] = [from + quarter, to + quarter];
            let middle = f64::midpoint(from, to);
            let across = [corners.across(middle), corners.across(middle + FRAC_PI_2)];
            let [[a, b], [c, d]] = across;
            let even = (d / root - a * root).atan2(b * root + c / root);
            let turned = from + (even - from).rem_euclid(PI);
            for angle in [from, turned.min(to)] {
                let area = side(angle, across).powi(2);
                if area < smallest.area {
                    // The shorter side lies along the angle.
                    let angle = angle + FRAC_PI_2;
                    smallest = Enclosure { area, angle };
                }
            }
        }
    }
    smallest
}

/// Corners of a convex hull by direction.
struct Corners<'a> {
    hull: &'a [[f64; 2]],
    /// Angle of the edge from each corner to the next, ascending within one turn from the first.
    edge_angles: Vec<f64>,
}

impl<'a> Corners<'a> {
    fn of(hull: &'a [[f64; 2]]) -> Self {
        let next = hull.iter().cycle().skip(1);
        let angles = hull.iter().zip(next).map(|(&p, &q)| {
            let [x, y] = sub(q, p);
            y.atan2(x)
        });
        let mut edge_angles: Vec<f64> = angles.collect();
        let first = edge_angles[0];
        for angle in &mut edge_angles {
            *angle = first + (*angle - first).rem_euclid(TAU);
        }
        Self { hull, edge_angles }
    }

    /// Returns the corner farthest along a direction.
    fn farthest(&self, angle: f64) -> [f64; 2] {
        // The edges before it turn less than a quarter turn beyond the direction, the edges after it more.
        let first = self.edge_angles[0];
        let along = first + (angle + FRAC_PI_2 - first).rem_euclid(TAU);
        let after = self.edge_angles.partition_point(|&edge| edge <= along);
        self.hull[after % self.hull.len()]
    }

    /// Returns the vector between the corners farthest apart along a direction.
    fn across(&self, angle: f64) -> [f64; 2] {
        sub(self.farthest(angle), self.farthest(angle + PI))
    }
}

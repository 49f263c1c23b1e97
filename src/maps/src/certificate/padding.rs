//! Exact judgment of the distances between charts.

use std::collections::BTreeSet;

use super::NAMED;
use super::boundary::{BoundarySegment, ChartBoundary};
use super::box_tree::BoxVisit;
use super::claims::Padding;
use super::fixed::{Fixed, UNIT_BITS, cross, difference, dot, fixed, is_exact, product};
use crate::mesh::Resolution;
use serde::Serialize;

/// Coordinates from here on are not judged: cross products of 2¹⁰ · 2⁴⁰ units reach 2¹⁰³, and their products with the
/// resolution must fit 128 bits.
const LIMIT: f64 = 1024.0;

/// Verdict on the requested distance between charts, decided in integers.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct PaddingVerdict {
    /// The requested distance, in texels.
    pub asked_texels: u32,
    /// The texture of the unit square.
    pub resolution: Resolution,
    /// `true` if it is proven that no two charts are closer. Coordinates of 1024 or more are not judged.
    pub kept: bool,
    /// The smallest distance between two charts in texels, rounded. Null if there is only one chart, or the
    /// search stopped at its limit.
    pub reached_texels: Option<f64>,
    /// Pairs of charts that are closer.
    pub pairs_too_close: usize,
    /// The first few pairs of faces at which two charts are too close.
    pub offending_faces: Vec<[u32; 2]>,
}

/// Judges the distances between the charts that `boundary` encloses, along each axis in its texels.
pub(super) fn judge_padding(boundary: &ChartBoundary, padding: Padding) -> PaddingVerdict {
    let mut verdict = PaddingVerdict {
        asked_texels: padding.texels,
        resolution: padding.resolution,
        kept: false,
        reached_texels: None,
        pairs_too_close: 0,
        offending_faces: Vec::new(),
    };
    // The longer side is a whole number of times the shorter: no coordinate is rounded.
    let side = padding.resolution.shorter();
    let halvings = padding.resolution.halvings();
    let longest = halvings[0].max(halvings[1]);
    let boundary = &boundary.scaled(halvings.map(|times| f64::from(1_u32 << (longest - times))));
    let points = || boundary.edges.iter().flat_map(|edge| edge.uvs);
    if points().flatten().any(|x| x.abs() >= LIMIT) {
        return verdict;
    }
    // Find the pairs of charts that are too close.
    let bound = PaddingBound::new(padding.texels, side, points().all(is_exact));
    let distance = f64::from(padding.texels) / f64::from(side);
    let mut too_close = BTreeSet::new();
    // A little more than half of the distance on each side, so that rounding misses no pair.
    let visit = boundary.near_pairs(0.5 * distance * (1.0 + 1e-9) + 1e-12, |a, b| {
        let pair = [a.chart.min(b.chart), a.chart.max(b.chart)];
        if a.chart != b.chart
            && !too_close.contains(&pair)
            && bound.exceeds(fixed_segment(a.uvs), fixed_segment(b.uvs))
        {
            too_close.insert(pair);
            if verdict.offending_faces.len() < NAMED {
                verdict.offending_faces.push([a.face, b.face]);
            }
        }
    });
    verdict.pairs_too_close = too_close.len();
    verdict.kept = too_close.is_empty() && visit == BoxVisit::Complete;
    // Measure the smallest distance for the report.
    let (gap, complete) = boundary.closest();
    verdict.reached_texels =
        (complete == BoxVisit::Complete && gap.is_finite()).then(|| gap * f64::from(side));
    verdict
}

fn fixed_segment(segment: BoundarySegment) -> [Fixed; 2] {
    segment.map(fixed)
}

/// A distance of `length / resolution` units.
struct PaddingBound {
    length: u128,
    resolution: u128,
}

impl PaddingBound {
    /// Creates the bound. Truncation moves each coordinate by less than a unit, and two points by less than three
    /// relative to each other: the bound is enlarged by that, so that a doubt is never resolved in favor of the map.
    fn new(texels: u32, resolution: u32, is_exact: bool) -> Self {
        let resolution = u128::from(resolution);
        let doubt = if is_exact { 0 } else { 3 * resolution };
        Self {
            length: (u128::from(texels) << UNIT_BITS) + doubt,
            resolution,
        }
    }

    /// Returns whether two segments are nearer than the bound, or meet.
    fn exceeds(&self, a: [Fixed; 2], b: [Fixed; 2]) -> bool {
        meet(a, b)
            || a.iter().any(|&p| self.exceeds_point(p, b))
            || b.iter().any(|&p| self.exceeds_point(p, a))
    }

    fn exceeds_point(&self, p: Fixed, [a, b]: [Fixed; 2]) -> bool {
        let (along, to) = (difference(b, a), difference(p, a));
        let (foot, length_squared) = (dot(along, to), dot(along, along));
        let near = if foot <= 0 {
            to
        } else if foot >= length_squared {
            difference(p, b)
        } else {
            // (|cross| / |along|)² < (length / resolution)²
            let height = cross(along, to).unsigned_abs() * self.resolution;
            let bound = product(self.length * self.length, length_squared.unsigned_abs());
            return product(height, height) < bound;
        };
        let square = dot(near, near).unsigned_abs();
        product(square, self.resolution * self.resolution) < [0, self.length * self.length]
    }
}

/// Returns whether two segments have a common point; collinear ones, whose ends would be near, are left to the
/// distances of ends.
fn meet([a, b]: [Fixed; 2], [c, d]: [Fixed; 2]) -> bool {
    let side = |p: Fixed, q: Fixed, r: Fixed| cross(difference(q, p), difference(r, p)).signum();
    let (of_c, of_d) = (side(a, b, c), side(a, b, d));
    let (of_a, of_b) = (side(c, d, a), side(c, d, b));
    of_c * of_d <= 0 && of_a * of_b <= 0 && [of_a, of_b, of_c, of_d] != [0; 4]
}

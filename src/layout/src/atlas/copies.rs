//! Charts of equal shape, up to rotation.
//!
//! Shapes are compared by moments of their outlines. In polar coordinates about the centroid of the outline, the k-th moment is the
//! mean of rᵏ e^(ikφ) along it. The first moment, which would be 0, is weighted with r². A rotation by δ multiplies the k-th moment
//! by e^(ikδ). The first strong moment gives the angle of a shape up to a k-th of a turn, and the others choose among these angles,
//! unless the shape is symmetric. Rotated back by this angle, all copies have the same moments. Mirrored copies have the conjugate
//! moments: they are another shape.
use std::collections::BTreeMap;
use std::f64::consts::TAU;

use unwrapd_maps::plane::Segment;

/// Number of moments. The last one gives the angle of an octagon.
const MOMENTS: usize = 8;
/// Largest difference between copies: relative for lengths and radii, absolute for moments at a radius of 1. Equal parts of
/// machines stay well below.
const EQUAL: f64 = 1e-4;
/// Smallest size of the strongest moment of a shape that is not round.
const ROUND: f64 = 0.01;
/// Smallest size of the moment that gives the angle, as a share of the strongest.
const STRONG: f64 = 0.5;
/// Direction along which the sum of the moments is largest for the chosen angle, in radians: one that few symmetries have.
const GENERIC: f64 = 0.7;
/// Points and weights of the four-point Gauss–Legendre quadrature on the unit interval, exact for polynomials up to degree seven.
const POINTS: [[f64; 2]; 4] = [
    [0.069_431_844_202_973_71, 0.173_927_422_568_726_93],
    [0.330_009_478_207_571_87, 0.326_072_577_431_273_07],
    [0.669_990_521_792_428_1, 0.326_072_577_431_273_07],
    [0.930_568_155_797_026_3, 0.173_927_422_568_726_93],
];

/// Moments of an outline, and its angle.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moments {
    length: f64,
    /// Root mean square distance of the outline from its centroid.
    radius: f64,
    /// Moments of the shape rotated back by `angle`, at a radius of 1.
    values: [[f64; 2]; MOMENTS],
    /// Angle in radians, counter-clockwise.
    pub angle: f64,
}

impl Moments {
    /// Computes the moments of an outline that consists of these edges; O(n).
    pub(super) fn new(edges: &[Segment]) -> Self {
        let length: f64 = edges
            .iter()
            .map(|[p, q]| (q[0] - p[0]).hypot(q[1] - p[1]))
            .sum();
        if !length.is_normal() {
            return Self::default();
        }
        let sum = |of: &dyn Fn([f64; 2]) -> [f64; 2]| {
            let mut sum = [0.0; 2];
            for [p, q] in edges {
                let along = (q[0] - p[0]).hypot(q[1] - p[1]) / length;
                for [t, weight] in POINTS {
                    let value = of([0, 1].map(|k| p[k] + t * (q[k] - p[k])));
                    sum = [0, 1].map(|k| sum[k] + weight * along * value[k]);
                }
            }
            sum
        };
        let middle = sum(&|p| p);
        let from_middle = |p: [f64; 2]| [p[0] - middle[0], p[1] - middle[1]];
        let squared = |[x, y]: [f64; 2]| x * x + y * y;
        let radius = sum(&|p| [squared(from_middle(p)), 0.0])[0].sqrt();
        if !radius.is_normal() {
            return Self::default();
        }
        let mut moments = [[0.0; 2]; MOMENTS];
        for (k, moment) in moments.iter_mut().enumerate() {
            *moment = sum(&|p| {
                let z = from_middle(p).map(|x| x / radius);
                let power = (0..k).fold(z, |power, _| product(power, z));
                let weight = if k == 0 { squared(z) } else { 1.0 };
                power.map(|x| weight * x)
            });
        }
        let angle = angle(&moments);
        Self {
            length,
            radius,
            values: turned_back(&moments, angle),
            angle,
        }
    }

    fn is_like(&self, other: &Self) -> bool {
        let is_near = |a: f64, b: f64| (a - b).abs() <= EQUAL * a.abs().max(b.abs());
        let values = self.values.iter().zip(&other.values);
        is_near(self.length, other.length)
            && is_near(self.radius, other.radius)
            && values
                .flat_map(|(a, b)| [0, 1].map(|k| (a[k] - b[k]).abs()))
                .all(|by| by <= EQUAL)
    }
}

/// Returns the angle of a shape with these moments; 0 if it is round.
fn angle(moments: &[[f64; 2]; MOMENTS]) -> f64 {
    let size = |[x, y]: &[f64; 2]| x.hypot(*y);
    let strongest = moments.iter().map(size).fold(0.0, f64::max);
    let is_strong = |(_, moment): &(u32, &[f64; 2])| size(moment) >= STRONG * strongest;
    let strong = (1..).zip(moments).find(is_strong);
    let Some((k, [x, y])) = strong.filter(|_| strongest > ROUND) else {
        return 0.0;
    };
    let candidates = (0..k).map(|turn| (y.atan2(*x) + TAU * f64::from(turn)) / f64::from(k));
    let (sin, cos) = GENERIC.sin_cos();
    let score = |angle: f64| {
        let back = turned_back(moments, angle);
        back.iter().map(|[x, y]| cos * x + sin * y).sum::<f64>()
    };
    let best = candidates.max_by(|&a, &b| score(a).total_cmp(&score(b)));
    best.unwrap_or(0.0)
}

/// Returns the moments of the shape rotated clockwise by an angle.
fn turned_back(moments: &[[f64; 2]; MOMENTS], angle: f64) -> [[f64; 2]; MOMENTS] {
    let mut turned = *moments;
    for (k, moment) in (1..).zip(&mut turned) {
        let (sin, cos) = (-f64::from(k) * angle).sin_cos();
        *moment = product(*moment, [cos, sin]);
    }
    turned
}

fn product([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a * c - b * d, a * d + b * c]
}

/// Returns for each shape the first shape that it is a copy of, possibly itself, and its angle relative to that shape, in radians.
pub(super) fn copies(shapes: &[Moments]) -> Vec<(usize, f64)> {
    // First shapes of their kinds, by the logarithm of the length in steps of the tolerance.
    let mut firsts: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
    let step = |length: f64| (length.ln() / EQUAL).floor() as i64;
    let mut found = Vec::with_capacity(shapes.len());
    for (i, shape) in shapes.iter().enumerate() {
        if shape.radius == 0.0 {
            found.push((i, 0.0));
            continue;
        }
        let step = step(shape.length);
        let near = firsts
            .range(step - 1..=step + 1)
            .flat_map(|(_, of_step)| of_step);
        if let Some(first) = near.copied().filter(|&j| shape.is_like(&shapes[j])).min() {
            let turned = (shape.angle - shapes[first].angle).rem_euclid(TAU);
            found.push((first, turned));
        } else {
            firsts.entry(step).or_default().push(i);
            found.push((i, 0.0));
        }
    }
    found
}

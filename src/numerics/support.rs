//! Convex hulls known by their extent in a few directions.

use std::f64::consts::TAU;

/// Directions, evenly spread. The hull of a circle comes out 0.3 % too large.
const N: usize = 32;

/// How far a set of points reaches in each of 32 directions: a convex hull whose union with another costs 32 comparisons.
#[derive(Clone, Debug, PartialEq)]
pub struct Support([f64; N]);

impl Support {
    /// Of no points.
    pub const EMPTY: Self = Self([f64::NEG_INFINITY; N]);

    /// Of one more point.
    pub fn add(&mut self, p: [f64; 2], directions: &Directions) {
        for (reach, d) in self.0.iter_mut().zip(&directions.0) {
            *reach = reach.max(p[0] * d[0] + p[1] * d[1]);
        }
    }

    /// Of the points of both.
    pub fn unite(&mut self, other: &Self) {
        for (reach, r) in self.0.iter_mut().zip(&other.0) {
            *reach = reach.max(*r);
        }
    }

    /// The area of the polygon that the reaches bound; 0 of no points.
    ///
    /// Each of its edges touches the hull. The edge between two neighbours is as long as they and its own reach say:
    /// (h₋ + h₊ − 2 h cos δ) / sin δ, with δ the angle between directions.
    pub fn area(&self) -> f64 {
        if self.0[0] == f64::NEG_INFINITY {
            return 0.0;
        }
        let (sin, cos) = (TAU / N as f64).sin_cos();
        let edge = |i: usize| {
            let (before, h, after) = (self.0[(i + N - 1) % N], self.0[i], self.0[(i + 1) % N]);
            h * (before + after - 2.0 * h * cos) / sin
        };
        (0..N).map(edge).sum::<f64>() / 2.0
    }
}

/// The directions of every [`Support`].
#[derive(Clone, Debug)]
pub struct Directions([[f64; 2]; N]);

impl Default for Directions {
    fn default() -> Self {
        Self(std::array::from_fn(|i| {
            let (sin, cos) = (TAU * i as f64 / N as f64).sin_cos();
            [cos, sin]
        }))
    }
}

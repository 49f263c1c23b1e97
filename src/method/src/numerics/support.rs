//! Convex hulls represented by their extent in a few directions.

use std::f64::consts::TAU;
use std::sync::LazyLock;

/// Number of directions, evenly spread. The hull of a circle comes out 0.3 % too large: 32/π · tan(π/32) = 1.003.
const N: usize = 32;

/// Support function of a point set in 32 directions: a convex hull whose union with another costs 32 comparisons.
#[derive(Clone, Debug, PartialEq)]
pub struct Support([f64; N]);

impl Support {
    /// The hull of no points.
    pub const EMPTY: Self = Self([f64::NEG_INFINITY; N]);

    /// Adds a point.
    pub fn add(&mut self, p: [f64; 2], directions: &Directions) {
        for (reach, d) in self.0.iter_mut().zip(&directions.0) {
            *reach = reach.max(p[0] * d[0] + p[1] * d[1]);
        }
    }

    /// Adds the points of the other.
    pub fn unite(&mut self, other: &Self) {
        for (reach, &r) in self.0.iter_mut().zip(&other.0) {
            // One instruction, where `max` looks for what is not a number.
            *reach = if r > *reach { r } else { *reach };
        }
    }

    /// Returns the area of the polygon bounded by the 32 directions; 0 without points.
    ///
    /// Each of its edges touches the hull. The length of an edge follows from its own reach h and those of its
    /// neighbors: (h₋ + h₊ − 2 h cos δ) / sin δ, with δ the angle between directions.
    pub fn area(&self) -> f64 {
        if self.0[0] == f64::NEG_INFINITY {
            return 0.0;
        }
        let (sin, cos) = (TAU / N as f64).sin_cos();
        (0..N)
            .map(|i: usize| {
                let (before, h, after) = (self.0[(i + N - 1) % N], self.0[i], self.0[(i + 1) % N]);
                h * (before + after - 2.0 * h * cos) / sin
            })
            .sum::<f64>()
            / 2.0
    }

    /// Returns the area of the smallest square around the polygon among those at 32 angles; 0 without points. Around a
    /// square it comes out up to a fifth too large.
    pub fn square(&self) -> f64 {
        if self.0[0] == f64::NEG_INFINITY {
            return 0.0;
        }
        self.sides().fold(f64::INFINITY, f64::min).powi(2)
    }

    /// Returns the sides of squares around the polygon, at 32 angles.
    fn sides(&self) -> impl Iterator<Item = f64> {
        let between = &*BETWEEN;
        (0..N / 4).flat_map(move |i| {
            between.iter().map(move |weights| {
                // Between two directions the farthest point is where their two bounds meet.
                let reach = |quarter: usize| {
                    let j = i + quarter * N / 4;
                    weights[0] * self.0[j % N] + weights[1] * self.0[(j + 1) % N]
                };
                (reach(0) + reach(2)).max(reach(1) + reach(3))
            })
        })
    }

    /// Returns the area of the hull plus twice the excess of its smallest enclosing square over `square`: the room that
    /// the points take in an atlas of that area. Other charts partly fill the gaps of a hull, but nothing makes up for
    /// a chart too long for the square.
    pub fn room(&self, square: f64) -> f64 {
        let fits = self.sides().any(|side| side.powi(2) <= square);
        let excess = if fits { 0.0 } else { self.square() - square };
        self.area() + 2.0 * excess.max(0.0)
    }
}

/// Weights of the reaches in two neighboring directions, for some angles between them.
static BETWEEN: LazyLock<[[f64; 2]; 4]> = LazyLock::new(|| {
    let step = TAU / N as f64;
    [0.0, 0.25, 0.5, 0.75].map(|share| [1.0 - share, share].map(|x| (x * step).sin() / step.sin()))
});

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

//! The square in which an outline is processed.

use super::OutlineError;
use unwrapd_method::numerics::bounds::bounds_of;

/// Steps of the grid of boundary vertices along the side of the frame.
const STEPS: f64 = (1_u64 << 36) as f64;
/// Upper limit of coordinates: products of two stay finite.
const LIMIT: f64 = 1e100;

/// A square around an outline, to be moved to [1, 2]²: no coordinate there is too small or too large for exact
/// predicates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    low: [f64; 2],
    /// A power of two.
    pub side: f64,
}

impl Frame {
    pub fn of(loops: &[Vec<[f64; 2]>]) -> Result<Self, OutlineError> {
        let boxes: Vec<[f64; 2]> = loops.iter().flat_map(|l| bounds_of(l)).collect();
        let [low, high] = bounds_of(&boxes);
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        if !low.iter().chain(&high).all(|x| x.abs() < LIMIT) || extent <= 1.0 / LIMIT {
            return Err(if loops.is_empty() {
                OutlineError::Empty
            } else {
                OutlineError::TooFine
            });
        }
        // A little larger, as rounding may move vertices out.
        let side = (extent * (1.0 + 2.0 / STEPS)).log2().ceil().exp2();
        let step = side / STEPS;
        Ok(Self {
            low: low.map(|x| (x / step - 0.5).floor() * step),
            side,
        })
    }

    /// Returns a closed polygon on the grid, without vertices that equal the next. Far from the origin, where
    /// floating-point numbers are sparser than the grid, it is not rounded.
    pub fn polygon(&self, mut vertices: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        let step = self.side / STEPS;
        for p in &mut vertices {
            *p = p.map(|x| (x / step).round() * step);
        }
        vertices.dedup();
        while vertices.len() > 1 && vertices.first() == vertices.last() {
            vertices.pop();
        }
        vertices
    }

    /// Maps a rounded point into [1, 2]², without further rounding.
    pub fn enter(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| 1.0 + (p[k] - self.low[k]) / self.side)
    }

    /// Maps a point of [1, 2]² back.
    pub fn leave(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.low[k] + (p[k] - 1.0) * self.side)
    }
}

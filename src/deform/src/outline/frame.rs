//! The box in which an outline is worked on.

use super::OutlineError;
use unwrapd_method::numerics::bounds::bounds_of;

/// Steps of the grid of boundary vertices along the side of the frame.
const STEPS: f64 = (1_u64 << 36) as f64;
/// Coordinates are smaller than this.
const LIMIT: f64 = 1e100;

/// A square around an outline, to be moved to [1, 2]²: no coordinate there is too small or too large for exact predicates.
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

    /// A closed polygon on the grid, without vertices that are equal to the next. Far from the origin, where numbers lie wider apart
    /// than the grid, it is not rounded.
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

    /// A rounded point in [1, 2]², without a further rounding.
    pub fn enter(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| 1.0 + (p[k] - self.low[k]) / self.side)
    }

    /// A point of [1, 2]² where it belongs.
    pub fn leave(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.low[k] + (p[k] - 1.0) * self.side)
    }
}

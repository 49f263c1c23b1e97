//! Slits cut into a chart where it would be distorted most.

use super::predictor::Predictor;
use super::slits::Slits;
use crate::charts::Chart;
use unwrapd_method::numerics::vec3::distance;

/// Vertices for which one more slit may be planned at once, far from the goal: with a large chart a factorization costs more than
/// a slit that is a little less well chosen.
const VERTICES_PER_SLIT: usize = 5_000;

/// A scale whose logarithm is less than this is 1 but for rounding.
const LEAST: f64 = 1e-6;

/// A chart whose slits are planned as the predictor says.
pub struct Predicted {
    /// The chart with its slits.
    pub slits: Slits,
    predictor: Predictor,
    log_scale: Vec<f64>,
    /// What the predictor says of the chart with these slits, see [`Predictor::excess`].
    pub excess: f64,
    /// The chart's area.
    pub area: f64,
}

impl Predicted {
    /// No slit yet.
    pub fn new(chart: Chart) -> Self {
        let slits = Slits::new(chart);
        let (triangles, positions) = slits.mesh();
        let mut predictor = Predictor::new(positions, triangles);
        let log_scale = predictor.log_scale(&slits.is_seam());
        Self {
            excess: predictor.excess(&log_scale),
            area: predictor.area(),
            slits,
            predictor,
            log_scale,
        }
    }

    /// Slits the chart from the nearest seam to the vertex whose scale differs most from that of the boundary, or else from a
    /// hole; false if there is neither. With `is_far` also to the next such vertices, as long as they lie farther from the
    /// slits that are new than these are long. One factorization.
    pub fn cut(&mut self, is_far: bool) -> bool {
        let most = if is_far {
            1 + self.log_scale.len() / VERTICES_PER_SLIT
        } else {
            1
        };
        // The tips of the slits and their lengths.
        let mut new: Vec<([f64; 3], f64)> = Vec::new();
        for _ in 0..most {
            let Some(tip) = self.worst_vertex(&new) else {
                break;
            };
            let Some(length) = self.slits.slit_to(tip) else {
                break;
            };
            let place = self.slits.mesh().1[tip as usize];
            new.push((place, length));
            new.extend(self.slits.image(place).map(|image| (image, length)));
        }
        if new.is_empty() && (self.slits.is_cut() || !self.slits.slit_from_largest_hole()) {
            return false;
        }
        self.predict();
        true
    }

    /// Slits the chart along lines, each from the seam that it leads to; false if none can be drawn. One factorization.
    pub fn cut_along(&mut self, lines: &[Vec<[f64; 3]>]) -> bool {
        let n_before = self.slits.lines.len();
        for line in lines {
            self.slits.slit_along(line);
        }
        let is_cut = self.slits.lines.len() > n_before;
        if is_cut {
            self.predict();
        }
        is_cut
    }

    fn predict(&mut self) {
        self.log_scale = self.predictor.log_scale(&self.slits.is_seam());
        self.excess = self.predictor.excess(&self.log_scale);
    }

    /// The vertex off the seams whose scale is farthest from 1, not near the new slits.
    fn worst_vertex(&self, new: &[([f64; 3], f64)]) -> Option<u32> {
        let (_, positions) = self.slits.mesh();
        let is_seam = self.slits.is_seam();
        let is_near = |v: usize| {
            new.iter()
                .any(|&(tip, length)| distance(positions[v], tip) < length)
        };
        (0u32..)
            .zip(&self.log_scale)
            .filter(|&(v, &u)| u.abs() > LEAST && !is_seam[v as usize] && !is_near(v as usize))
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()).then(b.0.cmp(&a.0)))
            .map(|(v, _)| v)
    }
}

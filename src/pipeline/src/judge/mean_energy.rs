//! Mean energy of a set of faces.

use unwrapd_maps::measure::FaceDistortion;
use unwrapd_method::numerics::vec3::{area_vector, norm};

/// Mean of symmetric Dirichlet energies weighted by area. Degenerate faces and negligible needles do not count.
#[derive(Clone, Copy, Default)]
pub(super) struct MeanEnergy {
    area: f64,
    sum: f64,
    pub greatest_stretch: f64,
}

impl MeanEnergy {
    pub fn add(&mut self, [a, b, c]: [[f64; 3]; 3], face: &FaceDistortion) {
        if face.counts && !face.degenerate {
            let area = norm(area_vector(a, b, c));
            self.area += area;
            self.sum += area * face.symmetric_dirichlet;
            self.greatest_stretch = self.greatest_stretch.max(face.stretch);
        }
    }

    pub fn mean(&self) -> Option<f64> {
        (self.area > 0.0).then(|| self.sum / self.area)
    }
}

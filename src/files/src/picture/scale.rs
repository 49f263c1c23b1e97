//! Color scale of a heat map.
use super::color::{self, NO_VALUE, Rgb};
use super::panel::Panel;
use serde::{Deserialize, Serialize};
use unwrapd_maps::measure::FaceDistortion;

/// Distortion shown in a heat map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum HeatmapMeasure {
    /// σ₁/σ₂, ideal 1.
    #[default]
    Conformal,
    /// max(σ₁σ₂, 1/σ₁σ₂), ideal 1.
    Area,
    /// σ₁² + σ₂² + σ₁⁻² + σ₂⁻², ideal 4.
    SymmetricDirichlet,
}

impl HeatmapMeasure {
    /// Returns the value of a face; infinite for one without area.
    pub(super) fn value(self, face: &FaceDistortion) -> f64 {
        match self {
            Self::Conformal => face.conformal,
            Self::Area => face.area,
            Self::SymmetricDirichlet => face.symmetric_dirichlet,
        }
    }

    /// Returns the value of an isometry.
    pub(super) fn ideal(self) -> f64 {
        match self {
            Self::Conformal | Self::Area => 1.0,
            Self::SymmetricDirichlet => 4.0,
        }
    }

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Conformal => "conformal distortion",
            Self::Area => "area distortion",
            Self::SymmetricDirichlet => "symmetric dirichlet",
        }
    }
}

/// Color scale: logarithmic from the ideal value to `greatest`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    pub ideal: f64,
    pub greatest: f64,
}

/// Possible ends of scales, as multiples of the ideal value.
const ENDS: [f64; 12] = [
    1.2, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0, 1e3, 1e4, 1e6,
];

impl Scale {
    /// Chooses the shortest scale that contains 99 % of the drawn area.
    pub fn new(panels: &[Panel], measure: HeatmapMeasure) -> Self {
        let mut values: Vec<(f64, f64)> = panels
            .iter()
            .flat_map(|panel| panel.distortion.iter().zip(panel.uvs))
            .map(|(face, uvs)| (measure.value(face), uv_area(uvs)))
            .filter(|(value, area)| value.is_finite() && area.is_finite())
            .collect();
        values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let total: f64 = values.iter().map(|v| v.1).sum();
        let mut below = 0.0;
        let most = values.iter().find(|(_, area)| {
            below += area;
            below >= 0.99 * total
        });
        let ideal = measure.ideal();
        let most = most.map_or(1.0, |v| v.0 / ideal);
        let end = ENDS.iter().find(|&&end| end >= most);
        let greatest = ideal * end.copied().unwrap_or(ENDS[ENDS.len() - 1]);
        Self { ideal, greatest }
    }

    /// Returns the position of a value on the scale, in [0, 1].
    pub fn position(&self, value: f64) -> f64 {
        ((value / self.ideal).ln() / (self.greatest / self.ideal).ln()).clamp(0.0, 1.0)
    }

    pub fn color(&self, value: f64) -> Rgb {
        if value.is_finite() {
            color::heat(self.position(value))
        } else {
            NO_VALUE
        }
    }
}

fn uv_area([a, b, c]: &[[f64; 2]; 3]) -> f64 {
    0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
}

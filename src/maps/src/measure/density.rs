//! Texels per length, chart against chart.

use super::faces::FaceMeasures;
use super::quantile::Weighted;
use crate::certificate::UvTopology;
use serde::Serialize;

/// Texel density of the charts, against what is intended where charts have weights: √(UV area / surface area) of a chart over that of the whole; ideal 1 throughout. Weighted by
/// surface area.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Density {
    /// 95th over 5th percentile.
    pub density_p95_over_p5: Option<f64>,
    /// Smallest.
    pub density_min: Option<f64>,
    /// Greatest.
    pub density_max: Option<f64>,
    /// Standard deviation over mean.
    pub density_cv: Option<f64>,
}

impl Density {
    pub(super) fn new(topology: &UvTopology, faces: &FaceMeasures) -> Density {
        let has_area = |f: usize| !faces.degenerate_3d[f] && topology.orientation[f] != 0;
        if !(0..topology.faces.len()).any(has_area) {
            return Density::default();
        }
        // Collect the density of each chart, weighted by its surface area.
        let scale = faces.area_scale().sqrt();
        let densities: Vec<(f64, f64)> = faces
            .charts
            .iter()
            .filter(|chart| chart.is_real() && chart.area_3d > 0.0)
            .map(|chart| {
                let density = (chart.area_uv / chart.area_intended.max(1e-300)).sqrt() * scale;
                (density, chart.area_3d)
            })
            .collect();
        // Compute mean and variance, then percentiles.
        let weight: f64 = densities.iter().map(|(_, w)| w).sum();
        let mean = densities.iter().map(|(d, w)| d * w).sum::<f64>() / weight;
        let variance = densities
            .iter()
            .map(|(d, w)| (d - mean).powi(2) * w)
            .sum::<f64>()
            / weight;
        let sorted = Weighted::new(densities);
        let spread = |low: f64, high: f64| (low != 0.0).then(|| high / low);
        Density {
            density_p95_over_p5: sorted
                .quantile(0.05)
                .zip(sorted.quantile(0.95))
                .and_then(|(low, high)| spread(low, high)),
            density_min: sorted.min(),
            density_max: sorted.max(),
            density_cv: sorted.min().map(|_| variance.sqrt() / mean),
        }
    }
}

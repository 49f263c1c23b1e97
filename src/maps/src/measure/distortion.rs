//! Distortion: deviation of the map from an isometry.

use super::faces::{FaceMeasures, dot, face_points, sub};
use super::validity::flipped;
use crate::certificate::UvTopology;
use crate::mesh::CornerUvs;
use serde::Serialize;

/// Distortion over all faces that have area in 3D and in UV, after scaling UVs so that total areas agree; null when there is no such
/// face. Needles, faces whose height is below 1e-4 of their longest side, do not count unless they have more than .1 % of the
/// surface area. Stretch is that of Sander et al. 2001.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Distortion {
    /// Root mean square stretch of the map from UV to the surface; ideal 1.
    #[serde(rename = "L2_stretch")]
    pub l2_stretch: Option<f64>,
    /// Greatest stretch of that map, max 1/σ₂; ideal 1.
    #[serde(rename = "Linf_stretch")]
    pub linf_stretch: Option<f64>,
    /// σ₁/σ₂, mean; ideal 1.
    pub conformal_mean: Option<f64>,
    /// σ₁/σ₂, 99th percentile.
    pub conformal_p99: Option<f64>,
    /// σ₁/σ₂, greatest.
    pub conformal_max: Option<f64>,
    /// max(σ₁σ₂, 1/σ₁σ₂), mean; ideal 1.
    pub area_dist_mean: Option<f64>,
    /// max(σ₁σ₂, 1/σ₁σ₂), 99th percentile.
    pub area_dist_p99: Option<f64>,
    /// max(σ₁σ₂, 1/σ₁σ₂), greatest.
    pub area_dist_max: Option<f64>,
    /// σ₁² + σ₂² + σ₁⁻² + σ₂⁻², mean; ideal 4.
    pub sym_dirichlet_mean: Option<f64>,
    /// Symmetric Dirichlet, 99th percentile.
    pub sym_dirichlet_p99: Option<f64>,
    /// Symmetric Dirichlet, greatest.
    pub sym_dirichlet_max: Option<f64>,
    /// Symmetric Dirichlet, median.
    pub sym_dirichlet_median: Option<f64>,
    /// max(σ₁, 1/σ₂), 99th percentile; ideal 1.
    pub stretch_p99: Option<f64>,
    /// (σ₁−1)² + (σ₂−1)², mean; ideal 0.
    pub arap_mean: Option<f64>,
    /// Needles.
    pub needles: usize,
    /// Their part of the surface area.
    pub needles_area_frac: f64,
}

/// Distortion of one face; the definitions are those of [`Distortion`].
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct FaceDistortion {
    /// σ₁/σ₂; infinite for a degenerate face, as are the next three.
    pub conformal: f64,
    /// max(σ₁σ₂, 1/σ₁σ₂).
    pub area: f64,
    /// σ₁² + σ₂² + σ₁⁻² + σ₂⁻².
    pub symmetric_dirichlet: f64,
    /// max(σ₁, 1/σ₂).
    pub stretch: f64,
    /// `true` if the face is oriented against its chart.
    pub flipped: bool,
    /// `true` if the face has no area in 3D or in UV.
    pub degenerate: bool,
    /// `true` if the face counts for [`Distortion`]: `false` for needles that have a negligible area.
    pub counts: bool,
}

/// Returns the distortion of every face, for pictures; `weights` as in [`MeasureOptions`](super::MeasureOptions).
pub fn face_distortion(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    uvs: &[CornerUvs],
    weights: Option<&[f64]>,
) -> Vec<FaceDistortion> {
    let topology = UvTopology::new(positions, triangles, uvs);
    let faces = FaceMeasures::new(&topology, weights);
    let of_face = |(face, flipped): (usize, bool)| {
        let values = Stretch::of_face(&topology, &faces, face);
        FaceDistortion {
            conformal: values.map_or(f64::INFINITY, |v| v.conformal()),
            area: values.map_or(f64::INFINITY, |v| v.area()),
            symmetric_dirichlet: values.map_or(f64::INFINITY, |v| v.symmetric_dirichlet()),
            stretch: values.map_or(f64::INFINITY, |v| v.greatest()),
            flipped,
            degenerate: values.is_none(),
            counts: faces.counts(face),
        }
    };
    flipped(&topology)
        .into_iter()
        .enumerate()
        .map(of_face)
        .collect()
}

impl Distortion {
    pub(super) fn new(topology: &UvTopology, faces: &FaceMeasures) -> Distortion {
        let (needles, needles_area_frac) = (
            faces.needle.iter().filter(|needle| **needle).count(),
            faces.needle_share(),
        );
        // Stretch of the faces that count, weighted by area.
        let measured: Vec<(Stretch, f64)> = (0..topology.faces.len())
            .filter(|&face| faces.counts(face))
            .filter_map(|f| Some((Stretch::of_face(topology, faces, f)?, faces.area_3d[f])))
            .collect();
        if measured.is_empty() {
            return Distortion {
                needles,
                needles_area_frac,
                ..Distortion::default()
            };
        }
        let weight: f64 = measured.iter().map(|(_, w)| w).sum();
        let mean = |of: fn(&Stretch) -> f64| {
            Some(
                measured
                    .iter()
                    .map(|(s, w)| w / weight * of(s))
                    .sum::<f64>(),
            )
        };
        // Percentiles.
        let sorted = |of: fn(&Stretch) -> f64| {
            Weighted::new(measured.iter().map(|(s, w)| (of(s), *w)).collect())
        };
        let conformal = sorted(Stretch::conformal);
        let area = sorted(Stretch::area);
        let dirichlet = sorted(Stretch::symmetric_dirichlet);
        Distortion {
            l2_stretch: mean(Stretch::squared_inverse).map(|sum| (0.5 * sum).sqrt()),
            linf_stretch: measured
                .iter()
                .map(|(s, _)| 1.0 / s.sigma[1])
                .reduce(f64::max),
            conformal_mean: mean(Stretch::conformal),
            conformal_p99: conformal.quantile(0.99),
            conformal_max: conformal.max(),
            area_dist_mean: mean(Stretch::area),
            area_dist_p99: area.quantile(0.99),
            area_dist_max: area.max(),
            sym_dirichlet_mean: mean(Stretch::symmetric_dirichlet),
            sym_dirichlet_p99: dirichlet.quantile(0.99),
            sym_dirichlet_max: dirichlet.max(),
            sym_dirichlet_median: dirichlet.quantile(0.5),
            stretch_p99: sorted(Stretch::greatest).quantile(0.99),
            arap_mean: mean(Stretch::arap),
            needles,
            needles_area_frac,
        }
    }
}

/// The singular values of a face's scaled map from the surface to UV, and quantities derived from them.
#[derive(Clone, Copy)]
struct Stretch {
    /// σ₁ ≥ σ₂ ≥ 0.
    sigma: [f64; 2],
    /// σ₁² + σ₂².
    squares: f64,
    /// σ₁σ₂.
    determinant: f64,
}

impl Stretch {
    /// Computes the stretch of a face; `None` for a face without area in 3D or in UV.
    fn of_face(topology: &UvTopology, faces: &FaceMeasures, face: usize) -> Option<Stretch> {
        if faces.degenerate_3d[face] || topology.orientation[face] == 0 {
            return None;
        }
        let scale = faces.area_scale().sqrt() / faces.weight(face);
        let [a, b, c] = face_points(topology, face);
        let (e1, e2) = (sub(b, a), sub(c, a));
        // The face in its plane: (0, 0), (x1, 0), (x2, y2).
        let x1 = dot(e1, e1).sqrt();
        let x2 = dot(e1, e2) / x1;
        let y2 = 2.0 * faces.area_3d[face] / x1;
        let [p, q, r] = topology.uvs[face];
        let column_1 = [0, 1].map(|k| (q[k] - p[k]) * scale / x1);
        let column_2 = [0, 1].map(|k| ((r[k] - p[k]) * scale - column_1[k] * x2) / y2);
        let squared = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
        let (e, g) = (squared(column_1), squared(column_2));
        let f = column_1[0] * column_2[0] + column_1[1] * column_2[1];
        let determinant = (column_1[0] * column_2[1] - column_1[1] * column_2[0])
            .abs()
            .max(1e-300);
        let greater = (0.5 * (e + g + (e - g).hypot(2.0 * f))).sqrt();
        Some(Stretch {
            sigma: [greater, determinant / greater],
            squares: e + g,
            determinant,
        })
    }

    fn conformal(&self) -> f64 {
        self.sigma[0] / self.sigma[1]
    }

    fn area(&self) -> f64 {
        self.determinant.max(1.0 / self.determinant)
    }

    fn symmetric_dirichlet(&self) -> f64 {
        self.squares + self.squared_inverse()
    }

    /// Returns σ₁⁻² + σ₂⁻².
    fn squared_inverse(&self) -> f64 {
        self.squares / (self.determinant * self.determinant)
    }

    fn greatest(&self) -> f64 {
        self.sigma[0].max(1.0 / self.sigma[1])
    }

    fn arap(&self) -> f64 {
        (self.sigma[0] - 1.0).powi(2) + (self.sigma[1] - 1.0).powi(2)
    }
}

// Texels per length, chart against chart.

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
        if !(0..topology.faces.len())
            .any(|f: usize| !faces.degenerate_3d[f] && topology.orientation[f] != 0)
        {
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

// Weighted quantiles.

/// Values with weights, sorted.
struct Weighted {
    values: Vec<f64>,
    /// Sum of the weights up to each value.
    cumulated: Vec<f64>,
}

impl Weighted {
    pub fn new(mut pairs: Vec<(f64, f64)>) -> Weighted {
        // Shares are summed, not weights: where half of twelve equal weights is asked for, rounding decides between the
        // sixth and the seventh value, and so it decides as in other programs that normalize first.
        let total: f64 = pairs.iter().map(|pair| pair.1).sum();
        pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut sum = 0.0;
        let cumulated = pairs.iter().map(|(_, weight)| {
            sum += weight / total;
            sum
        });
        Weighted {
            cumulated: cumulated.collect(),
            values: pairs.iter().map(|p| p.0).collect(),
        }
    }

    /// Returns the smallest value at which the cumulated weight reaches the share `q` of the total.
    pub fn quantile(&self, q: f64) -> Option<f64> {
        let wanted = q * self.cumulated.last()?;
        let index = self.cumulated.partition_point(|&c| c < wanted);
        Some(self.values[index.min(self.values.len() - 1)])
    }

    pub fn min(&self) -> Option<f64> {
        self.values.first().copied()
    }

    pub fn max(&self) -> Option<f64> {
        self.values.last().copied()
    }
}

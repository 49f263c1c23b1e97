//! What a result is worth, in the figures by which it is accepted.

use serde::{Deserialize, Serialize};

use unwrapd_pipeline::Report;

/// What a result is worth, as far as its kind says.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Worth {
    /// Whether everything requested is proven.
    pub certified: Option<bool>,
    /// Charts of all atlases.
    pub charts: Option<u64>,
    /// Mean symmetric Dirichlet energy of the worst atlas; an isometry has 4.
    pub distortion: Option<f64>,
    /// 99th percentile of the stretch of the worst atlas; an isometry has 1.
    pub stretch: Option<f64>,
}

impl Worth {
    /// That of a result of which nothing is known but whether it is proven.
    pub fn proven(certified: bool) -> Self {
        Self {
            certified: Some(certified),
            ..Self::default()
        }
    }

    /// That of an atlas.
    pub fn of(report: &Report) -> Self {
        let measures = || report.groups.iter().map(|group| &group.measures);
        let worst = |figures: Vec<Option<f64>>| figures.into_iter().flatten().reduce(f64::max);
        Self {
            certified: Some(report.certified),
            charts: Some(measures().map(|of| of.seams.charts as u64).sum()),
            distortion: worst(
                measures()
                    .map(|of| of.distortion.sym_dirichlet_mean)
                    .collect(),
            ),
            stretch: worst(measures().map(|of| of.distortion.stretch_p99).collect()),
        }
    }
}

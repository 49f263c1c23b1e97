//! Quality figures of an atlas.

use unwrapd_api::Quality;
use unwrapd_pipeline::Report;

/// Returns the quality figures of an atlas from its report.
pub fn quality_of(report: &Report) -> Quality {
    let measures = || report.groups.iter().map(|group| &group.measures);
    let worst = |figures: Vec<Option<f64>>| figures.into_iter().flatten().reduce(f64::max);
    Quality {
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

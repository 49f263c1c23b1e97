//! Report on the distortion bound of an atlas and on its worst chart.

use serde::Serialize;

use super::group_uvs::GroupUvs;
use super::mean_energy::MeanEnergy;
use super::smoothed_distortion::smoothed_distortion;
use unwrapd_layout::charts::{Bound, Bounded};
use unwrapd_maps::certificate::chart_ids;
use unwrapd_maps::measure::{Distortion, face_distortion};
use unwrapd_maps::mesh::CornerUvs;

/// A bound on the distortion of an atlas, and what was reached.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct BoundReport {
    /// The largest mean symmetric Dirichlet energy that was asked for.
    pub max_distortion: f64,
    /// The bound on the 99th percentile of the stretch, weighted by area, that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_stretch: Option<f64>,
    /// The mean symmetric Dirichlet energy of the written bytes, `sym_dirichlet_mean`.
    pub distortion: Option<f64>,
    /// The stretch of the written bytes, `stretch_p99`.
    pub stretch: Option<f64>,
    /// The mean symmetric Dirichlet energy of the written map and its surface, both smoothed; absent unless that is bounded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smoothed_distortion: Option<f64>,
    /// Surface that is bounded: the surface as it is, or the smoothed one where it is rough and neither bound was
    /// requested.
    pub of: Bounded,
    /// `true` if that surface keeps both bounds.
    pub kept: bool,
    /// The most charts that were asked for; bounds on the distortion yield to it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_charts: Option<u32>,
    /// The most distorted chart, where a bound is missed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst_chart: Option<WorstChart>,
}

/// The chart with the largest mean symmetric Dirichlet energy.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct WorstChart {
    /// Its number, in the order of the first faces of charts.
    pub chart: u32,
    /// Its mean symmetric Dirichlet energy.
    pub distortion: f64,
    /// The greatest stretch of a triangle of it.
    pub stretch: f64,
}

/// Returns the uniform stretch of a map with this symmetric Dirichlet energy E, in percent: the s > 0 with 2(1+s)² +
/// 2(1+s)⁻² = E.
pub fn stretch_percent(energy: f64) -> f64 {
    let energy = energy.max(4.0);
    let squared = (energy + (energy * energy - 16.0).sqrt()) / 4.0;
    100.0 * (squared.sqrt() - 1.0)
}

impl BoundReport {
    pub(crate) fn new(
        bound: &Bound,
        max_charts: Option<u32>,
        measured: &Distortion,
        uvs: &GroupUvs,
        aspect: f64,
    ) -> Self {
        let keeps = |most: Option<f64>, measured: Option<f64>| {
            most.zip(measured)
                .is_none_or(|(most, measured)| measured <= most)
        };
        // Compare the surface; if it misses a bound, compare the smoothed one, where that is bounded.
        let surface_keeps = keeps(Some(bound.mean), measured.sym_dirichlet_mean)
            && keeps(bound.stretch, measured.stretch_p99);
        let smoothed_distortion = match bound.of {
            Bounded::Smoothed if !surface_keeps => smoothed_distortion(uvs, aspect),
            _ => None,
        };
        let kept =
            surface_keeps || smoothed_distortion.is_some_and(|smoothed| smoothed <= bound.mean);
        Self {
            of: match smoothed_distortion {
                Some(_) => Bounded::Smoothed,
                None => Bounded::Surface,
            },
            smoothed_distortion,
            max_distortion: bound.mean,
            max_stretch: bound.stretch,
            distortion: measured.sym_dirichlet_mean,
            stretch: measured.stretch_p99,
            kept,
            max_charts,
            worst_chart: if kept {
                None
            } else {
                WorstChart::of(uvs, aspect)
            },
        }
    }

    /// Describes which bounds are missed, by how much, and where it is worst.
    pub(crate) fn shortfall(&self) -> String {
        // List the bounds that are missed.
        let mut parts = Vec::new();
        if let Some(reached) = (self.smoothed_distortion.or(self.distortion))
            .filter(|&reached| reached > self.max_distortion)
        {
            let [percent, most] = [reached, self.max_distortion].map(stretch_percent);
            let of = match self.of {
                Bounded::Surface => "",
                Bounded::Smoothed => " of the smoothed surface",
            };
            parts.push(format!(
                "mean stretch {percent:.1} %{of} exceeds the bound of {most:.1} % (symmetric Dirichlet {reached:.4}, bound {})",
                self.max_distortion
            ));
        }
        if let (Some(most), Some(reached)) = (self.max_stretch, self.stretch)
            && reached > most
        {
            let [percent, asked] = [reached, most].map(|stretch| 100.0 * (stretch - 1.0));
            parts.push(format!(
                "the 99th percentile of the stretch, {percent:.1} %, exceeds the bound of {asked:.1} %"
            ));
        }
        // Add the worst chart, and the number of charts to which the bounds yielded.
        let worst = self.worst_chart.map(|worst| {
            let percent = stretch_percent(worst.distortion);
            let WorstChart {
                chart, distortion, ..
            } = worst;
            format!("; the worst is chart {chart} with {percent:.1} % ({distortion:.4})")
        });
        let yielding = self.max_charts.map(|most| {
            let plural = if most == 1 { "" } else { "s" };
            format!("; bounds on the distortion yield to that of {most} chart{plural}")
        });
        let [worst, yielding] = [worst, yielding].map(Option::unwrap_or_default);
        format!("{}{worst}{yielding}", parts.join(", "))
    }
}

impl BoundReport {
    /// Returns a caveat if only the smoothed surface keeps the bound.
    pub(crate) fn caveat(&self) -> Option<String> {
        let smoothed = self.smoothed_distortion.filter(|_| self.kept)?;
        let [own, smoothed] = [self.distortion?, smoothed].map(stretch_percent);
        Some(format!(
            "the surface is rough: its mean stretch is {own:.1} %, that of the smoothed surface {smoothed:.1} %, which keeps the bound; \
             `max_distortion` bounds the surface itself"
        ))
    }
}

impl WorstChart {
    fn of(group: &GroupUvs, aspect: f64) -> Option<Self> {
        let (positions, triangles) = (&group.positions, &group.triangles);
        let scaled = |face: &CornerUvs| face.map(|[u, v]| [u * aspect, v]);
        let uvs: Vec<CornerUvs> = group.uvs.iter().map(scaled).collect();
        let faces = face_distortion(positions, triangles, &uvs, group.weights.as_deref());
        let mut charts: Vec<MeanEnergy> = Vec::new();
        for ((triangle, face), chart) in triangles
            .iter()
            .zip(&faces)
            .zip(chart_ids(positions, triangles, &group.uvs))
        {
            charts.resize(charts.len().max(chart as usize + 1), MeanEnergy::default());
            charts[chart as usize].add(triangle.map(|v| positions[v as usize]), face);
        }
        let of_chart = |(chart, sum): (u32, &MeanEnergy)| {
            Some(Self {
                chart,
                distortion: sum.mean()?,
                stretch: sum.greatest_stretch,
            })
        };
        let charts = (0..).zip(&charts).filter_map(of_chart);
        charts.max_by(|a, b| a.distortion.total_cmp(&b.distortion))
    }
}

//! Report on the distortion bound of an atlas and on its worst chart.

use super::group_uvs::GroupUvs;
use serde::Serialize;
use unwrapd_layout::charts::{Bound, Bounded, smoothed_where_rough};
use unwrapd_maps::certificate::chart_ids;
use unwrapd_maps::measure::{Distortion, FaceDistortion, face_distortion};
use unwrapd_maps::mesh::{CornerUvs, Surface};
use unwrapd_method::numerics::vec3::{area_vector, norm};

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
        let uvs: Vec<CornerUvs> = group
            .uvs
            .iter()
            .map(|face: &CornerUvs| face.map(|[u, v]| [u * aspect, v]))
            .collect();
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

// Mean energy of a set of faces.

/// Mean of symmetric Dirichlet energies weighted by area. Degenerate faces and negligible needles do not count.
#[derive(Clone, Copy, Default)]
struct MeanEnergy {
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

// Distortion of the map of a rough surface without the noise of both.

/// Returns the mean symmetric Dirichlet energy of the smoothed map of the smoothed surface; `None` if the surface is
/// not rough. Leaves out faces at chart borders, which have neighbors on one side only.
fn smoothed_distortion(group: &GroupUvs, aspect: f64) -> Option<f64> {
    let surface = Surface::new(&group.positions, &group.triangles).ok()?;
    let smooth = smoothed_where_rough(&surface)?;
    let charts = charts_in_the_plane(&surface, group, aspect)?;
    let is_on_border = charts.is_on_border();
    let places = charts.smoothed(&is_on_border);
    let uvs: Vec<CornerUvs> = charts
        .triangles
        .iter()
        .map(|t| t.map(|v: u32| [0, 1].map(|k| places[v as usize][k])))
        .collect();
    let weights = group.weights.as_ref();
    let weights = weights.map(|of| surface.faces.iter().map(|&f| of[f as usize]).collect());
    let weights: Option<Vec<f64>> = weights;
    let faces = face_distortion(
        &smooth.positions,
        &smooth.triangles,
        &uvs,
        weights.as_deref(),
    );
    let mut sum = MeanEnergy::default();
    for (t, face) in faces.iter().enumerate() {
        if !charts.triangles[t]
            .iter()
            .any(|&v| is_on_border[v as usize])
        {
            sum.add(smooth.corners(t), face);
        }
    }
    sum.mean()
}

/// Returns the charts of a surface as surfaces in the plane, with the same triangles; `None` if a face is degenerate
/// there.
fn charts_in_the_plane(surface: &Surface, group: &GroupUvs, aspect: f64) -> Option<Surface> {
    let of_faces = surface.faces.iter().flat_map(|&f| group.uvs[f as usize]);
    let places: Vec<[f64; 3]> = of_faces.map(|[u, v]| [u * aspect, v, 0.0]).collect();
    let corners: Vec<[u32; 3]> = (0..surface.faces.len() as u32)
        .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
        .collect();
    let charts = Surface::new(&places, &corners).ok()?;
    (charts.triangles.len() == corners.len()).then_some(charts)
}

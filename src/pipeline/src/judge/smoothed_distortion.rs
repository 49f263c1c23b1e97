//! Distortion of the map of a rough surface without the noise of both.

use super::group_uvs::GroupUvs;
use super::mean_energy::MeanEnergy;
use unwrapd_layout::charts::smoothed_where_rough;
use unwrapd_maps::measure::face_distortion;
use unwrapd_maps::mesh::{CornerUvs, Surface};

/// Returns the mean symmetric Dirichlet energy of the smoothed map of the smoothed surface; `None` if the surface is
/// not rough. Leaves out faces at chart borders, which have neighbors on one side only.
pub(super) fn smoothed_distortion(group: &GroupUvs, aspect: f64) -> Option<f64> {
    let surface = Surface::new(&group.positions, &group.triangles).ok()?;
    let smooth = smoothed_where_rough(&surface)?;
    let charts = charts_in_the_plane(&surface, group, aspect)?;
    let is_on_border = charts.is_on_border();
    let places = charts.smoothed(&is_on_border);
    let place = |v: u32| [0, 1].map(|k| places[v as usize][k]);
    let uvs: Vec<CornerUvs> = charts.triangles.iter().map(|t| t.map(place)).collect();
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

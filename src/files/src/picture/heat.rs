//! The heat map of each face's distortion.
use super::legend;
use super::panel::{Panel, Style, sheet};
use super::raster::Mode;
use super::scale::{HeatmapMeasure, Scale};
use unwrapd_maps::mesh::VAxis;

/// Draws a PNG of the faces in the colors of their distortion, with a legend below; flipped faces are yellow.
///
/// All panels share one scale. `size` as in [`layout_png`](super::layout_png); the legend is added to it.
pub fn heatmap_png(panels: &[Panel], measure: HeatmapMeasure, size: u32, v_axis: VAxis) -> Vec<u8> {
    let scale = Scale::new(panels, measure);
    let color = |panel: &Panel, face: usize| {
        let value = panel.distortion.get(face).map(|d| measure.value(d));
        scale.color(value.unwrap_or(f64::INFINITY))
    };
    let style = Style {
        color: &color,
        mode: Mode::OnTop,
    };
    let drawn = sheet(panels, size, v_axis, &style);
    let faces = || panels.iter().flat_map(|panel| panel.distortion);
    let exceptions = legend::Exceptions {
        flipped: faces().any(|face| face.flipped),
        no_value: faces().any(|face| !measure.value(face).is_finite()),
    };
    legend::below(&drawn, measure.title(), &scale, &exceptions).png()
}

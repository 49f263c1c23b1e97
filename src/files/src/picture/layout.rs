//! The layout: places of the charts.
use super::color;
use super::panel::{Panel, Style, sheet};
use super::raster::Mode;
use unwrapd_maps::mesh::VAxis;

/// Draws a PNG of the charts, each in its own color; overlaps are red and flipped faces yellow.
///
/// `size` is the side in pixels, at least 64 and at most 4096; several panels make a sheet of up to twice that width.
pub fn layout_png(panels: &[Panel], size: u32, v_axis: VAxis) -> Vec<u8> {
    let style = Style {
        color: &|panel, face| color::chart(panel.charts.get(face).copied().unwrap_or(0)),
        mode: Mode::Counted,
    };
    sheet(panels, size, v_axis, &style).png()
}

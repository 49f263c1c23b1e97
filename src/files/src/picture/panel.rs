//! One group of faces drawn in its square, and several of them on a sheet.

use super::canvas::{self, Canvas, FLIPPED, INK, Rgb, StrokeLines};
use super::raster::{CoverageMode, Raster};
use unwrapd_maps::measure::FaceDistortion;
use unwrapd_maps::mesh::{CornerUvs, VAxis};

/// Faces that share one UV space.
#[derive(Debug, Clone, Copy)]
pub struct Panel<'a> {
    /// Name, written above the square if there are several panels.
    pub name: &'a str,
    /// UVs of each face.
    pub uvs: &'a [CornerUvs],
    /// Chart of each face.
    pub charts: &'a [u32],
    /// Distortion of each face.
    pub distortion: &'a [FaceDistortion],
}

/// Smallest and largest side of a picture in pixels.
const SIDES: std::ops::RangeInclusive<u32> = 64..=4096;
/// Most panels on a sheet; a note tells how many are left out.
const MOST_PANELS: usize = 36;
/// Free share of a bounding square at each side.
const FRAME_MARGIN: f64 = 0.02;

/// Returns the thickness of chart borders, in pixels, in a picture with a side of `pixels`.
fn border_thickness(pixels: usize) -> f64 {
    1.4 * (pixels as f64 / 1024.0).clamp(0.75, 2.0)
}

/// The square of UV space that is drawn: the unit square if it contains all UVs, else the bounding square.
#[derive(Clone, Copy)]
struct PanelFrame {
    origin: [f64; 2],
    side: f64,
    is_unit: bool,
}

impl PanelFrame {
    fn new(uvs: &[CornerUvs]) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for uv in uvs.iter().filter(|face| is_finite(face)).flatten() {
            for axis in 0..2 {
                low[axis] = low[axis].min(uv[axis]);
                high[axis] = high[axis].max(uv[axis]);
            }
        }
        let inside = low.iter().all(|&x| x >= -1e-6) && high.iter().all(|&x| x <= 1.0 + 1e-6);
        let side = (high[0] - low[0]).max(high[1] - low[1]);
        if inside || !side.is_finite() || side <= 0.0 {
            let origin = [0.0; 2];
            return Self {
                origin,
                side: 1.0,
                is_unit: true,
            };
        }
        // Centered, with room for the borders.
        let full = side * (1.0 + 2.0 * FRAME_MARGIN);
        Self {
            origin: [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]) - 0.5 * full),
            side: full,
            is_unit: false,
        }
    }

    /// Returns the position of a UV in a picture with a side of `pixels`, row 0 at the top.
    fn pixel(&self, uv: [f64; 2], pixels: usize, v_axis: VAxis) -> [f64; 2] {
        let [x, y] = [0, 1].map(|axis| (uv[axis] - self.origin[axis]) / self.side);
        let y = match v_axis {
            VAxis::Up => 1.0 - y,
            VAxis::Down => y,
        };
        [x * pixels as f64, y * pixels as f64]
    }
}

fn is_finite(face: &CornerUvs) -> bool {
    face.as_flattened().iter().all(|x| x.is_finite())
}

/// Drawing style of panels.
pub(super) struct Style<'a> {
    /// Color of a face that is not flipped, by its index.
    pub color: &'a dyn Fn(&Panel, usize) -> Rgb,
    /// Treatment of overlaps of such faces.
    pub mode: CoverageMode,
}

/// Draws a panel in a square.
fn square(panel: &Panel, pixels: usize, v_axis: VAxis, style: &Style) -> Canvas {
    let frame = PanelFrame::new(panel.uvs);
    let place = |face: &CornerUvs| face.map(|uv| frame.pixel(uv, pixels, v_axis));
    // Fill the faces, flipped ones last so that they are seen.
    let mut raster = Raster::new(pixels);
    let is_flipped = |face: usize| panel.distortion.get(face).is_some_and(|d| d.flipped);
    for flipped in [false, true] {
        for (index, face) in panel.uvs.iter().enumerate() {
            if flipped != is_flipped(index) || !is_finite(face) {
                continue;
            }
            let corners = place(face);
            let (color, mode) = if flipped {
                (FLIPPED, CoverageMode::OnTop)
            } else {
                ((style.color)(panel, index), style.mode)
            };
            raster.fill(corners, color, edge_opacity(&corners), mode);
        }
    }
    let mut canvas = raster.canvas();
    // Draw the borders of charts.
    let mut borders = StrokeLines::new(&canvas);
    for [a, b] in border_edges(panel.uvs) {
        let [a, b] = [a, b].map(|uv| frame.pixel(uv, pixels, v_axis));
        borders.segment(a, b, border_thickness(pixels));
    }
    canvas.ink(&borders, INK, 0.9);
    // Draw the unit square if UVs leave it.
    if !frame.is_unit {
        let mut unit = StrokeLines::new(&canvas);
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let corners = corners.map(|uv| frame.pixel(uv, pixels, v_axis));
        for k in 0..4 {
            unit.segment(corners[k], corners[(k + 1) % 4], 1.0);
        }
        canvas.ink(&unit, INK, 0.4);
    }
    canvas
}

/// Returns the opacity of the edges of a face; they fade out where faces are too small to tell them apart.
fn edge_opacity(corners: &[[f64; 2]; 3]) -> f32 {
    let [a, b, c] = corners;
    let doubled_area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs();
    // Side of an equilateral triangle of this area is about 1.5 times this.
    let size = doubled_area.sqrt();
    (0.05 * (size - 3.0)).clamp(0.0, 0.38) as f32
}

/// Returns the borders of charts: edges whose two ends no other face has.
///
/// Compared by hash: with 64 bits two of a million edges collide once in a million pictures, and then a border is
/// missing.
fn border_edges(uvs: &[CornerUvs]) -> Vec<[[f64; 2]; 2]> {
    let edge = |corner: usize| {
        let face = &uvs[corner / 3];
        [face[corner % 3], face[(corner + 1) % 3]]
    };
    let mut hashes: Vec<(u64, u32)> = (0..3 * uvs.len())
        .filter(|corner| is_finite(&uvs[corner / 3]))
        .map(|corner| (edge_hash(edge(corner)), corner as u32))
        .collect();
    hashes.sort_unstable();
    hashes
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|same| same.len() == 1)
        .map(|same| edge(same[0].1 as usize))
        .collect()
}

fn edge_hash(ends: [[f64; 2]; 2]) -> u64 {
    // splitmix64 (Steele, Lea, Flood 2014), fed with both coordinates; the sum forgets the direction of the edge.
    let mix = |x: u64| {
        let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^ (x >> 31)
    };
    let point =
        |uv: [f64; 2]| mix(mix((uv[0] + 0.0).to_bits()) ^ (uv[1] + 0.0).to_bits().rotate_left(17));
    mix(point(ends[0]).wrapping_add(point(ends[1])))
}

/// Draws panels side by side under their names; a single panel is drawn alone.
pub(super) fn sheet(panels: &[Panel], size: u32, v_axis: VAxis, style: &Style) -> Canvas {
    let size = size.clamp(*SIDES.start(), *SIDES.end()) as usize;
    if let [panel] = panels {
        return square(panel, size, v_axis, style);
    }
    // Size and grid of the sheet.
    let shown = panels.len().min(MOST_PANELS);
    let columns = (1..=MOST_PANELS).find(|c| c * c >= shown).unwrap_or(1);
    let rows = shown.div_ceil(columns).max(1);
    let margin = (size / 64).max(4);
    let letters = (size as f64 / 64.0).max(8.0);
    let title = (2.2 * letters) as usize;
    let sheet_width = (2 * size).min(*SIDES.end() as usize).max(size);
    let pixels = (sheet_width / columns)
        .min(size)
        .saturating_sub(margin)
        .max(32);
    let cell = [pixels + margin, pixels + title + margin];
    let note = if shown < panels.len() { title } else { 0 };
    // Panels with frames.
    let mut canvas = Canvas::new(columns * cell[0] + margin, rows * cell[1] + note + margin);
    for (k, panel) in panels.iter().take(shown).enumerate() {
        let (column, row) = (
            margin + k % columns * cell[0],
            k / columns * cell[1] + title,
        );
        canvas.fill(
            column - 1..column + pixels + 1,
            row - 1..row + pixels + 1,
            [224, 226, 230],
        );
        let drawn = square(panel, pixels, v_axis, style);
        canvas.place(&drawn, column, row);
    }
    // Names, and a note on panels that are left out.
    let mut titles = StrokeLines::new(&canvas);
    for (k, panel) in panels.iter().take(shown).enumerate() {
        let (column, row) = (margin + k % columns * cell[0], k / columns * cell[1]);
        let y = row as f64 + 0.5 * (title as f64 - letters);
        canvas::write(&mut titles, panel.name, column as f64, y, letters);
    }
    if note > 0 {
        let left_out = format!("+ {} more", panels.len() - shown);
        let y = (rows * cell[1]) as f64 + 0.5 * letters;
        canvas::write(&mut titles, &left_out, margin as f64, y, letters);
    }
    canvas.ink(&titles, INK, 1.0);
    canvas
}

// The layout: places of the charts.

/// Draws a PNG of the charts, each in its own color; overlaps are red and flipped faces yellow.
///
/// `size` is the side in pixels, at least 64 and at most 4096; several panels make a sheet of up to twice that width.
pub fn layout_png(panels: &[Panel], size: u32, v_axis: VAxis) -> Vec<u8> {
    let style = Style {
        color: &|panel, face| canvas::chart(panel.charts.get(face).copied().unwrap_or(0)),
        mode: CoverageMode::Counted,
    };
    sheet(panels, size, v_axis, &style).png()
}

//! The heat map of each face's distortion.

use super::canvas::{self, Canvas, FLIPPED, INK, NO_VALUE, Rgb, StrokeLines};
use super::panel::{Panel, Style, sheet};
use super::raster::CoverageMode;
use serde::{Deserialize, Serialize};
use unwrapd_maps::measure::FaceDistortion;
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
        mode: CoverageMode::OnTop,
    };
    let drawn = sheet(panels, size, v_axis, &style);
    let faces = || panels.iter().flat_map(|panel| panel.distortion);
    let exceptions = Exceptions {
        flipped: faces().any(|face| face.flipped),
        no_value: faces().any(|face| !measure.value(face).is_finite()),
    };
    below(&drawn, measure.title(), &scale, &exceptions).png()
}

// The strip below a heat map: title, scale with numbers, and colors outside the scale.

/// Colors outside the scale that occur in the picture.
struct Exceptions {
    pub flipped: bool,
    pub no_value: bool,
}

/// Numbers at possible ticks, as multiples of the ideal value.
const TICKS: [f64; 19] = [
    1.0, 1.05, 1.1, 1.2, 1.35, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0, 5.0, 10.0, 20.0, 50.0, 100.0, 1e3,
    1e4, 1e6,
];

/// Returns the picture with its legend below it: title, scale and exceptions in one line, or in two if it is narrow.
fn below(drawn: &Canvas, title: &str, scale: &Scale, exceptions: &Exceptions) -> Canvas {
    let letters = (drawn.width as f64 / 80.0).clamp(6.0, 16.0);
    let narrow = drawn.width < 640;
    let line = if narrow { 2.0 * letters } else { 0.0 };
    let strip = (4.2 * letters + line) as usize;
    let mut canvas = Canvas::new(drawn.width, drawn.height + strip);
    canvas.place(drawn, 0, 0);
    let margin = letters.round();
    let top = drawn.height as f64 + margin;
    let mut ink = StrokeLines::new(&canvas);
    canvas::write(&mut ink, title, margin, top, letters);
    let right = swatches(&mut canvas, &mut ink, exceptions, [margin, top], letters);
    let bar = if narrow {
        [2.0 * margin, canvas.width as f64 - 3.0 * margin]
    } else {
        let left = margin + canvas::width(title, letters) + 2.0 * margin;
        [left, (right - 2.0 * margin).max(left + 1.0)]
    };
    let top = top + line;
    for column in bar[0] as usize..bar[1] as usize {
        let t = (column as f64 - bar[0]) / (bar[1] - bar[0]);
        let rows = top as usize..(top + letters) as usize;
        canvas.fill(column..column + 1, rows, canvas::heat(t));
    }
    ticks(&mut ink, scale, bar, top + letters, letters);
    canvas.ink(&ink, INK, 1.0);
    canvas
}

/// Draws ticks and numbers, from the right end of the bar, leaving out those without room.
fn ticks(ink: &mut StrokeLines, scale: &Scale, bar: [f64; 2], y: f64, letters: f64) {
    let mut free = f64::INFINITY;
    for tick in TICKS.iter().rev().map(|tick| tick * scale.ideal) {
        if tick > scale.greatest * (1.0 + 1e-9) {
            continue;
        }
        let x = bar[0] + scale.position(tick) * (bar[1] - bar[0]);
        // The last number stands for everything beyond it, too.
        let at_end = tick >= scale.greatest * (1.0 - 1e-9);
        let number = if at_end {
            format!("≥{tick}")
        } else {
            format!("{tick:.4}")
        };
        let number = if number.contains('.') {
            number
                .trim_end_matches('0')
                .trim_end_matches('.')
                .to_owned()
        } else {
            number
        };
        // Leave out a number that would touch the one to its right or the one at the left end.
        let half = 0.5 * canvas::width(&number, letters);
        if x + half + letters > free
            || (tick > scale.ideal && x - half - letters < bar[0] + letters)
        {
            continue;
        }
        free = x - half;
        ink.segment([x, y + 1.0], [x, y + 0.4 * letters], 1.0);
        canvas::write(ink, &number, x - half, y + 0.8 * letters, letters);
    }
}

/// Draws colored squares with their meaning at the right; returns the left end.
fn swatches(
    canvas: &mut Canvas,
    ink: &mut StrokeLines,
    exceptions: &Exceptions,
    [margin, top]: [f64; 2],
    letters: f64,
) -> f64 {
    let mut right = canvas.width as f64 - margin;
    let kinds: [(bool, &str, Rgb); 2] = [
        (exceptions.no_value, "no area", NO_VALUE),
        (exceptions.flipped, "flipped", FLIPPED),
    ];
    for (_, label, color) in kinds.into_iter().filter(|kind| kind.0) {
        let left = right - canvas::width(label, letters);
        canvas::write(ink, label, left, top, letters);
        let square = left - 1.6 * letters;
        let rows = top as usize..(top + letters) as usize;
        canvas.fill(square as usize..(square + letters) as usize, rows, color);
        right = square - 1.5 * margin;
    }
    right
}

// Color scale of a heat map.

/// Distortion shown in a heat map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum HeatmapMeasure {
    /// σ₁/σ₂, ideal 1.
    #[default]
    Conformal,
    /// max(σ₁σ₂, 1/σ₁σ₂), ideal 1.
    Area,
    /// σ₁² + σ₂² + σ₁⁻² + σ₂⁻², ideal 4.
    SymmetricDirichlet,
}

impl HeatmapMeasure {
    /// Returns the value of a face; infinite for one without area.
    pub(super) fn value(self, face: &FaceDistortion) -> f64 {
        match self {
            Self::Conformal => face.conformal,
            Self::Area => face.area,
            Self::SymmetricDirichlet => face.symmetric_dirichlet,
        }
    }

    /// Returns the value of an isometry.
    fn ideal(self) -> f64 {
        match self {
            Self::Conformal | Self::Area => 1.0,
            Self::SymmetricDirichlet => 4.0,
        }
    }

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Conformal => "conformal distortion",
            Self::Area => "area distortion",
            Self::SymmetricDirichlet => "symmetric dirichlet",
        }
    }
}

/// Color scale: logarithmic from the ideal value to `greatest`.
#[derive(Debug, Clone, Copy)]
struct Scale {
    pub ideal: f64,
    pub greatest: f64,
}

/// Possible ends of scales, as multiples of the ideal value.
const ENDS: [f64; 12] = [
    1.2, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0, 1e3, 1e4, 1e6,
];

impl Scale {
    /// Chooses the shortest scale that contains 99 % of the drawn area.
    pub fn new(panels: &[Panel], measure: HeatmapMeasure) -> Self {
        let mut values: Vec<(f64, f64)> = panels
            .iter()
            .flat_map(|panel| panel.distortion.iter().zip(panel.uvs))
            .map(|(face, uvs)| (measure.value(face), uv_area(uvs)))
            .filter(|(value, area)| value.is_finite() && area.is_finite())
            .collect();
        values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let total: f64 = values.iter().map(|v| v.1).sum();
        let mut below = 0.0;
        let most = values.iter().find(|(_, area)| {
            below += area;
            below >= 0.99 * total
        });
        let ideal = measure.ideal();
        let most = most.map_or(1.0, |v| v.0 / ideal);
        let end = ENDS.iter().find(|&&end| end >= most);
        let greatest = ideal * end.copied().unwrap_or(ENDS[ENDS.len() - 1]);
        Self { ideal, greatest }
    }

    /// Returns the position of a value on the scale, in [0, 1].
    pub fn position(&self, value: f64) -> f64 {
        ((value / self.ideal).ln() / (self.greatest / self.ideal).ln()).clamp(0.0, 1.0)
    }

    pub fn color(&self, value: f64) -> Rgb {
        if value.is_finite() {
            canvas::heat(self.position(value))
        } else {
            NO_VALUE
        }
    }
}

fn uv_area([a, b, c]: &[[f64; 2]; 3]) -> f64 {
    0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
}

//! Filling of triangles on a grid of samples, one or several per pixel.

use super::canvas::{BACKGROUND, Canvas, INK, OVERLAP, Rgb, mix};
use std::ops::Range;

/// Steps of a corner's coordinates per sample: 8 bits, the subpixel precision of graphics hardware.
const STEPS: i64 = 256;
/// Largest coordinate of corners after clamping, in samples: 2²⁸ steps, so that products of two differences fit 58
/// bits.
const FARTHEST: f64 = (1 << 20) as f64;
/// Most samples along a side; bounds the memory of a picture to 67 MB.
const MOST_SAMPLES: usize = 4096;
/// Thickness of the line between two faces, in pixels.
const EDGE_PIXELS: f64 = 0.8;

/// A square of samples.
pub(super) struct Raster {
    side: usize,
    per_pixel: usize,
    colors: Vec<Rgb>,
    /// Number of faces that cover each sample; stops at 2.
    layers: Vec<u8>,
}

/// Treatment of samples that are covered already.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum CoverageMode {
    /// Shows an overlap.
    Counted,
    /// Draws over everything.
    OnTop,
}

impl Raster {
    /// Creates the samples of a picture of `pixels` by `pixels`.
    pub fn new(pixels: usize) -> Self {
        let per_pixel = (MOST_SAMPLES / pixels.max(1)).clamp(1, 3);
        let side = pixels * per_pixel;
        Self {
            side,
            per_pixel,
            colors: vec![BACKGROUND; side * side],
            layers: vec![0; side * side],
        }
    }

    /// Fills a triangle given in pixels. Its edges are drawn with the given opacity; each face draws its half.
    pub fn fill(
        &mut self,
        corners: [[f64; 2]; 3],
        color: Rgb,
        edge_opacity: f32,
        mode: CoverageMode,
    ) {
        let fixed = steps(corners.map(|p| p.map(|x| x * self.per_pixel as f64)));
        let edges = TriangleEdges::new(&fixed);
        let reach = 0.5 * EDGE_PIXELS * self.per_pixel as f64;
        for (row, columns) in spans(fixed, [self.side; 2]) {
            let distances = edges.of_row(row);
            // Most samples are far from all edges.
            let far = if edge_opacity > 0.0 {
                distances.farther(&columns, reach + 0.5)
            } else {
                columns.clone()
            };
            for column in (columns.start..far.start).chain(far.end..columns.end) {
                let cover = (reach - distances.at(column) + 0.5).clamp(0.0, 1.0) as f32;
                let shown = mix(color, INK, cover * edge_opacity);
                self.set(row, column..column + 1, shown, mode);
            }
            self.set(row, far, color, mode);
        }
    }

    /// Colors some samples of a row.
    fn set(&mut self, row: usize, columns: Range<usize>, color: Rgb, mode: CoverageMode) {
        let samples = row * self.side + columns.start..row * self.side + columns.end;
        let over = match mode {
            CoverageMode::Counted => mix(color, OVERLAP, 0.85),
            CoverageMode::OnTop => color,
        };
        let layers = self.layers[samples.clone()].iter_mut();
        for (layers, shown) in layers.zip(&mut self.colors[samples]) {
            *shown = if *layers > 0 { over } else { color };
            *layers = (*layers + 1).min(2);
        }
    }

    /// Averages the samples of each pixel.
    pub fn canvas(&self) -> Canvas {
        let pixels = self.side / self.per_pixel;
        let mut canvas = Canvas::new(pixels, pixels);
        let n = (self.per_pixel * self.per_pixel) as u32;
        for (row, line) in canvas.pixels.chunks_mut(pixels.max(1)).enumerate() {
            for (column, pixel) in line.iter_mut().enumerate() {
                let mut sum = [0_u32; 3];
                for y in 0..self.per_pixel {
                    let start = (row * self.per_pixel + y) * self.side + column * self.per_pixel;
                    for color in &self.colors[start..start + self.per_pixel] {
                        for (sum, &channel) in sum.iter_mut().zip(color) {
                            *sum += u32::from(channel);
                        }
                    }
                }
                *pixel = sum.map(|s| ((s + n / 2) / n) as u8);
            }
        }
        canvas
    }
}

/// Rounds corners given in samples to steps.
pub(crate) fn steps(corners: [[f64; 2]; 3]) -> [[i64; 2]; 3] {
    corners.map(|p| p.map(|x| (x.clamp(-FARTHEST, FARTHEST) * STEPS as f64).round() as i64))
}

/// Iterates over the samples inside a triangle, row by row, on a grid of `size` columns and rows. Half open, so that a
/// sample on a common edge belongs to one of two triangles.
pub(crate) fn spans(
    mut corners: [[i64; 2]; 3],
    size: [usize; 2],
) -> impl Iterator<Item = (usize, Range<usize>)> {
    corners.sort_unstable_by_key(|p| p[1]);
    let [low, middle, high] = corners;
    rows(low[1], high[1], size[1]).map(move |row| {
        let y = row as i64 * STEPS + STEPS / 2;
        let short = if y < middle[1] {
            [low, middle]
        } else {
            [middle, high]
        };
        let ends = [
            first_sample(low, high, y),
            first_sample(short[0], short[1], y),
        ];
        let [a, b] = ends.map(|x| x.clamp(0, size[0] as i64) as usize);
        (row, a.min(b)..a.max(b))
    })
}

/// Returns the rows of samples at or above `low` and below `high`.
fn rows(low: i64, high: i64, side: usize) -> Range<usize> {
    let first = |y: i64| (y + STEPS / 2 - 1).div_euclid(STEPS).clamp(0, side as i64) as usize;
    first(low)..first(high)
}

/// Returns the first sample of row `y` at or to the right of an edge whose ends are in increasing order of y: exact,
/// and equal for both faces of the edge.
fn first_sample(a: [i64; 2], b: [i64; 2], y: i64) -> i64 {
    let height = (b[1] - a[1]).max(1);
    let x_times_height = a[0] * height + (b[0] - a[0]) * (y - a[1]);
    let center = STEPS / 2 * height;
    let step = STEPS * height;
    // The smallest c with c·STEPS + STEPS/2 ≥ x.
    (x_times_height - center + step - 1).div_euclid(step)
}

/// Distances to the three lines of a triangle's edges.
struct TriangleEdges {
    /// Point and unit normal of each edge.
    lines: [([f64; 2], [f64; 2]); 3],
}

impl TriangleEdges {
    fn new(corners: &[[i64; 2]; 3]) -> Self {
        let lines = [0, 1, 2].map(|k| {
            let a = corners[k].map(|x| x as f64);
            let b = corners[(k + 1) % 3].map(|x| x as f64);
            let d = [b[0] - a[0], b[1] - a[1]];
            let length = d[0].hypot(d[1]).max(1.0);
            (a, [-d[1] / length, d[0] / length])
        });
        Self { lines }
    }

    /// Returns the distances along a row of samples.
    fn of_row(&self, row: usize) -> RowDistances {
        let step = STEPS as f64;
        let y = (row as f64 + 0.5) * step;
        let lines = self.lines.map(|(a, n)| {
            let at_first = (0.5 * step - a[0]) * n[0] + (y - a[1]) * n[1];
            (at_first / step, n[0])
        });
        RowDistances { lines }
    }
}

/// Signed distances to three lines along a row of samples, in samples.
struct RowDistances {
    /// Distance of the first sample, and the step to each further one, per line.
    lines: [(f64, f64); 3],
}

impl RowDistances {
    /// Returns the distance of a sample inside to the nearest edge.
    fn at(&self, column: usize) -> f64 {
        let column = column as f64;
        let distances = self
            .lines
            .map(|(first, step)| (first + column * step).abs());
        distances[0].min(distances[1]).min(distances[2])
    }

    /// Returns samples, among some inside, that are at least `least` from all edges; may miss some of them.
    fn farther(&self, columns: &Range<usize>, least: f64) -> Range<usize> {
        let middle = usize::midpoint(columns.start, columns.end) as f64;
        let (mut low, mut high) = (columns.start as f64, columns.end as f64);
        for (first, step) in self.lines {
            let side = (first + middle * step).signum();
            let (first, step) = (side * first, side * step);
            let crossing = (least - first) / step;
            // Spare one sample, so that rounding does not decide.
            if step > 0.0 {
                low = low.max(crossing.ceil() + 1.0);
            } else if step < 0.0 {
                high = high.min(crossing.floor() - 1.0);
            } else if first < least {
                high = low;
            }
        }
        if low < high {
            low as usize..high as usize
        } else {
            columns.end..columns.end
        }
    }
}

//! Pixels: blending, lines, copying, and the final PNG.

use super::image::png;
use image::ExtendedColorType;

/// A picture, row 0 at the top.
pub(super) struct Canvas {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<Rgb>,
}

impl Canvas {
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            pixels: vec![BACKGROUND; width * height],
        }
    }

    /// Fills the pixels of a rectangle, clipped at the borders.
    pub fn fill(
        &mut self,
        columns: std::ops::Range<usize>,
        rows: std::ops::Range<usize>,
        color: Rgb,
    ) {
        for row in rows.start..rows.end.min(self.height) {
            for column in columns.start..columns.end.min(self.width) {
                self.pixels[row * self.width + column] = color;
            }
        }
    }

    /// Copies `other` with its upper left corner to `(column, row)`; it must fit.
    pub fn place(&mut self, other: &Canvas, column: usize, row: usize) {
        for (k, line) in other.pixels.chunks(other.width.max(1)).enumerate() {
            let start = (row + k) * self.width + column;
            self.pixels[start..start + line.len()].copy_from_slice(line);
        }
    }

    /// Blends the lines of a mask over the picture.
    pub fn ink(&mut self, lines: &StrokeLines, color: Rgb, opacity: f32) {
        for (pixel, &coverage) in self.pixels.iter_mut().zip(&lines.coverage) {
            if coverage > 0 {
                *pixel = mix(*pixel, color, f32::from(coverage) / 255.0 * opacity);
            }
        }
    }

    /// Returns the PNG file.
    pub fn png(&self) -> Vec<u8> {
        let bytes = self.pixels.as_flattened();
        png(bytes, self.width, self.height, ExtendedColorType::Rgb8)
    }
}

/// Coverage of each pixel by lines; where lines meet it is their maximum, not their sum.
pub(super) struct StrokeLines {
    width: usize,
    height: usize,
    coverage: Vec<u8>,
}

impl StrokeLines {
    pub fn new(canvas: &Canvas) -> Self {
        Self {
            width: canvas.width,
            height: canvas.height,
            coverage: vec![0; canvas.width * canvas.height],
        }
    }

    /// Draws a segment with round ends; coordinates are in pixels, and pixel (0, 0) has its center at (0.5, 0.5).
    pub fn segment(&mut self, a: [f64; 2], b: [f64; 2], thickness: f64) {
        let reach = 0.5 * thickness + 0.5;
        let d = [b[0] - a[0], b[1] - a[1]];
        let length_squared = d[0] * d[0] + d[1] * d[1];
        let rows = span(a[1].min(b[1]) - reach, a[1].max(b[1]) + reach, self.height);
        for row in rows {
            let y = row as f64 + 0.5;
            for column in self.columns_near(a, d, y, reach) {
                let p = [column as f64 + 0.5 - a[0], y - a[1]];
                let t = if length_squared > 0.0 {
                    ((p[0] * d[0] + p[1] * d[1]) / length_squared).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let distance = (p[0] - t * d[0]).hypot(p[1] - t * d[1]);
                let covered =
                    ((reach - distance).clamp(0.0, 1.0) * thickness.min(1.0) * 255.0) as u8;
                let pixel = &mut self.coverage[row * self.width + column];
                *pixel = covered.max(*pixel);
            }
        }
    }

    /// Returns the columns of row `y` that the part of the segment near that row can touch.
    fn columns_near(&self, a: [f64; 2], d: [f64; 2], y: f64, reach: f64) -> std::ops::Range<usize> {
        let at = |y: f64| (((y - a[1]) / d[1]).clamp(0.0, 1.0)) * d[0] + a[0];
        let (from, to) = if d[1].abs() > 1e-9 {
            (at(y - reach), at(y + reach))
        } else {
            (a[0], a[0] + d[0])
        };
        span(from.min(to) - reach, from.max(to) + reach, self.width)
    }
}

/// Returns the pixels, of `n`, that an interval touches.
fn span(from: f64, to: f64, n: usize) -> std::ops::Range<usize> {
    let end = (to.ceil().max(0.0) as usize).min(n);
    (from.floor().max(0.0) as usize).min(end)..end
}

// Stroke letters and digits for titles and legends.

/// Height of capital letters and digits, in units of the strokes.
const UNITS: f64 = 6.0;
/// Space between two letters, in units of the strokes.
const GAP: f64 = 2.0;

/// Returns the polylines of a letter, separated by blanks; each point is two digits, x to the right and y down from the
/// top line. The base line is y = 6. Capitals are drawn as small letters, unknown characters as a box.
#[rustfmt::skip]
fn strokes(letter: char) -> &'static str {
    match letter.to_ascii_lowercase() {
        ' ' => "",
        '0' => "103041453616050110", '1' => "112026 1636", '2' => "01103041420646",
        '3' => "011030414233 13334445361605", '4' => "36300444", '5' => "40000312324345361605",
        '6' => "413010010516364544331304", '7' => "004016", '8' => "13020110304142331304051636454433",
        '9' => "051636454130100102133342",
        '.' => "0606", '-' => "0333", '+' => "0343 2125", '/' => "0640", '_' => "0747", ':' => "0303 0606",
        '≥' => "014305 0747",
        'a' => "12324346 441405163645", 'b' => "0006 0312324345361605", 'c' => "4332120305163645",
        'd' => "4046 4332120305163645", 'e' => "04444332120305163645", 'f' => "30201116 0232",
        'g' => "4247381807 4332120305163645", 'h' => "0006 0312324346", 'i' => "0206 0000", 'j' => "121708 1010",
        'k' => "0006 3205 1436", 'l' => "000516", 'm' => "0206 03122326 23324346", 'n' => "0206 0312324346",
        'o' => "123243453616050312", 'p' => "0208 0312324345361605", 'q' => "4248 4332120305163645",
        'r' => "0206 03122232", 's' => "43321203143445361605", 't' => "10152636 0232", 'u' => "0205163645 4246",
        'v' => "022642", 'w' => "0216243642", 'x' => "0246 4206", 'y' => "0226 4218", 'z' => "02420646",
        _ => "0040460600",
    }
}

fn points(polyline: &str) -> impl Iterator<Item = [f64; 2]> {
    let digit = |b: u8| f64::from(b.saturating_sub(b'0'));
    polyline
        .as_bytes()
        .chunks_exact(2)
        .map(move |p| [digit(p[0]), digit(p[1])])
}

fn letter_width(letter: char) -> f64 {
    let widest = strokes(letter).split(' ').flat_map(points).map(|p| p[0]);
    widest.fold(if letter == ' ' { 1.0 } else { 0.0 }, f64::max)
}

/// Returns the width of a line of text whose digits are `height` pixels high.
pub(super) fn width(text: &str, height: f64) -> f64 {
    let units: f64 = text.chars().map(|letter| letter_width(letter) + GAP).sum();
    (units - GAP).max(0.0) * height / UNITS
}

/// Writes a line of text; `(x, y)` is the upper left corner, in pixels.
pub(super) fn write(lines: &mut StrokeLines, text: &str, x: f64, y: f64, height: f64) {
    let unit = height / UNITS;
    let mut left = x;
    for letter in text.chars() {
        for polyline in strokes(letter).split(' ') {
            let points: Vec<[f64; 2]> = points(polyline)
                .map(|p: [f64; 2]| [left + p[0] * unit, y + p[1] * unit])
                .collect();
            for pair in points.windows(2) {
                lines.segment(pair[0], pair[1], (0.14 * height).max(1.2));
            }
        }
        left += (letter_width(letter) + GAP) * unit;
    }
}

// Colors, chosen and mixed in Oklab, where equal steps look equal (Ottosson 2020).

/// Red, green and blue as in a PNG.
pub(super) type Rgb = [u8; 3];

pub(super) const BACKGROUND: Rgb = [255, 255, 255];
/// Color of lines and letters.
pub(super) const INK: Rgb = [38, 42, 51];
/// Color of flipped faces, as in the figures of the literature.
pub(super) const FLIPPED: Rgb = [255, 214, 10];
/// Color of places that are covered more than once.
pub(super) const OVERLAP: Rgb = [222, 38, 44];
/// Color of faces without a value.
pub(super) const NO_VALUE: Rgb = [176, 176, 176];

/// Returns the muted fill of a chart: similar lightness, hues spread by the golden angle so that neighbors in number
/// differ.
pub(super) fn chart(id: u32) -> Rgb {
    // (√5 − 1)/2 of a turn: the golden angle, the other way around.
    const GOLDEN_TURN: f64 = 0.618_033_988_749_894_9;
    let turn = (0.58 + GOLDEN_TURN * f64::from(id)).fract();
    let lightness = [0.84, 0.78, 0.88][id as usize % 3];
    let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
    rgb([lightness, 0.075 * cos, 0.075 * sin])
}

/// Returns the color of a heat map: pale for no distortion, dark for the largest; `t` in [0, 1].
///
/// Lightness falls evenly from 0.95 to 0.28 while the hue turns from sand over coral to plum; without yellow, which is
/// for flipped faces.
pub(super) fn heat(t: f64) -> Rgb {
    const STOPS: [[f64; 3]; 5] = [
        [0.950, 0.002, 0.012],
        [0.800, 0.055, 0.065],
        [0.640, 0.140, 0.075],
        [0.460, 0.150, 0.000],
        [0.280, 0.090, -0.060],
    ];
    let at = t.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let stop = (at as usize).min(STOPS.len() - 2);
    let part = at - stop as f64;
    rgb([0, 1, 2].map(|k| STOPS[stop][k] * (1.0 - part) + STOPS[stop + 1][k] * part))
}

/// Blends `over` onto `under` with the given opacity in [0, 1].
pub(super) fn mix(under: Rgb, over: Rgb, opacity: f32) -> Rgb {
    let channel = |k: usize| {
        let (u, o) = (f32::from(under[k]), f32::from(over[k]));
        (u + (o - u) * opacity + 0.5) as u8
    };
    [channel(0), channel(1), channel(2)]
}

/// Converts Oklab to sRGB.
fn rgb([lightness, a, b]: [f64; 3]) -> Rgb {
    let l = (lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let m = (lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let s = (lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b).powi(3);
    let linear = [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
    ];
    linear.map(|x| {
        let x = x.clamp(0.0, 1.0);
        let encoded = if x <= 0.003_130_8 {
            12.92 * x
        } else {
            1.055 * x.powf(1.0 / 2.4) - 0.055
        };
        (encoded * 255.0 + 0.5) as u8
    })
}

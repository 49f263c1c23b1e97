//! Colors, chosen and mixed in Oklab, where equal steps look equal (Ottosson 2020).

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

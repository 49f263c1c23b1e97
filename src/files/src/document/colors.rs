//! Colors of vertices: sRGB in PLY and OBJ, linear in glTF.

/// Red, green, blue and alpha, linear.
pub(super) type Color = [f32; 4];

/// The neutral color.
pub(super) const WHITE: Color = [1.0; 4];

/// Converts sRGB to linear light, clamped to the unit interval; alpha is not converted.
pub(super) fn from_srgb([r, g, b, a]: [f64; 4]) -> Color {
    let linear = |x: f64| {
        let x = x.clamp(0.0, 1.0);
        if x <= 0.040_45 {
            x / 12.92
        } else {
            ((x + 0.055) / 1.055).powf(2.4)
        }
    };
    [linear(r), linear(g), linear(b), a.clamp(0.0, 1.0)].map(|x| x as f32)
}

/// Converts a color to sRGB, without its alpha.
pub(super) fn to_srgb([r, g, b, _]: Color) -> [f64; 3] {
    [r, g, b].map(|x| {
        let x = f64::from(x).clamp(0.0, 1.0);
        if x <= 0.003_130_8 {
            12.92 * x
        } else {
            1.055 * x.powf(1.0 / 2.4) - 0.055
        }
    })
}

/// Returns the color of three or four linear numbers.
pub(super) fn from_linear(channels: &[f64]) -> Color {
    std::array::from_fn(|k| channels.get(k).map_or(1.0, |x| x.clamp(0.0, 1.0) as f32))
}

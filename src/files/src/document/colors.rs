//! Colors of vertices: PLY and OBJ have them in sRGB, glTF linear.

/// Red, green, blue and alpha, linear.
pub(super) type Color = [f32; 4];

/// What shows nothing of itself.
pub(super) const WHITE: Color = [1.0; 4];

/// Red, green, blue and alpha in the unit interval, alpha as it is.
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

/// The color without its alpha, in sRGB.
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

/// The color of three or four linear numbers.
pub(super) fn from_linear(channels: &[f64]) -> Color {
    std::array::from_fn(|k| channels.get(k).map_or(1.0, |x| x.clamp(0.0, 1.0) as f32))
}

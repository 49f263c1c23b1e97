//! Texels as numbers that can be averaged.

use std::sync::LazyLock;

use crate::document::Encoding;

/// Conversion of sRGB codes, as defined in IEC 61966-2-1, to linear light.
static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|code| {
        let c = code as f64 / 255.0;
        let linear = if c <= 0.04045 {
            c / 12.92
        } else {
            ((c + 0.055) / 1.055).powf(2.4)
        };
        linear as f32
    })
});

/// Decodes a texel: colors in linear light, data unchanged, directions in [−1, 1]. The fourth channel is always data.
pub(super) fn decoded([r, g, b, a]: [u8; 4], encoding: Encoding) -> [f32; 4] {
    let part = |code: u8| f32::from(code) / 255.0;
    let channel = |code: u8| match encoding {
        Encoding::Color => LINEAR[code as usize],
        Encoding::Data => part(code),
        Encoding::Normal => 2.0 * part(code) - 1.0,
    };
    [channel(r), channel(g), channel(b), part(a)]
}

/// Encodes values as the nearest texel.
pub(super) fn encoded([r, g, b, a]: [f32; 4], encoding: Encoding) -> [u8; 4] {
    let code = |part: f32| (part.clamp(0.0, 1.0) * 255.0).round() as u8;
    let channel = |value: f32| match encoding {
        Encoding::Color => code(srgb(value)),
        Encoding::Data => code(value),
        Encoding::Normal => code(0.5 * value + 0.5),
    };
    [channel(r), channel(g), channel(b), code(a)]
}

fn srgb(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

//! What a longer search for a full layout is good for.

use unwrapd::certificate::{Claims, certify};
use unwrapd::charts::Cut;
use unwrapd::pipeline::{Cutting, Layout, PackingMode, Settings, Unobserved, unwrap};

use crate::random::Random;

/// Plane stars that do not touch, each of so many corners: one chart each.
fn stars(corners: &[u32]) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    let mut random = Random::new(7);
    for (place, &n) in (0_u8..).zip(corners) {
        let first = positions.len() as u32;
        let size = 0.4 + random.next();
        positions.push([0.0, 0.0, f32::from(place)]);
        for corner in 0..n {
            let radius = size * (0.3 + 0.7 * random.next());
            let (sin, cos) = (f64::from(corner) * std::f64::consts::TAU / f64::from(n)).sin_cos();
            positions.push([
                (radius * cos) as f32,
                (radius * sin) as f32,
                f32::from(place),
            ]);
            triangles.push([first, first + 1 + corner, first + 1 + (corner + 1) % n]);
        }
    }
    (positions, triangles)
}

#[test]
fn tight_packing_fills_more_than_fast() {
    let (positions, triangles) = stars(&[5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]);
    let exact: Vec<[f64; 3]> = positions.iter().map(|p| p.map(f64::from)).collect();
    let [fast, tight] = [PackingMode::Fast, PackingMode::Tight].map(|packing| {
        let settings = Settings {
            cutting: Cutting {
                cut: Cut::Disk,
                ..Cutting::default()
            },
            layout: Layout {
                packing,
                ..Layout::default()
            },
            ..Settings::default()
        };
        let unwrapped = unwrap(&positions, &triangles, &settings, &Unobserved).expect("stars");
        let uvs = unwrapped.corner_uvs();
        let certificate = certify(&exact, &triangles, &uvs, &Claims::default());
        assert!(certificate.is_bijective(), "{packing:?}: {certificate:?}");
        unwrapped.scale
    });
    assert!(tight > 1.001 * fast, "{fast} {tight}");
}

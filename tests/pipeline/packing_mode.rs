//! What a longer search for a full layout is good for, and one where there are many charts.

use unwrapd_layout::charts::Cut;
use unwrapd_maps::certificate::{Claims, certify};
use unwrapd_pipeline::{Cutting, Layout, PackingMode, Settings, Unobserved, unwrap};

use crate::random::Random;
use crate::zoo::voxels;

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

/// Crosses of creased arms, each larger than the last, which lies below it.
fn crosses(n: u32) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    const WIDTH: f64 = 0.2;
    const QUADS: u32 = 6;
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for cross in 0..n {
        let (first, size) = (positions.len() as u32, 1.0 + f64::from(cross) / 200.0);
        let mut place = |x: f64, y: f64, crease: u32| {
            let z = f64::from(cross) + 0.05 * f64::from(crease % 2);
            positions.push([size * x, size * y, z].map(|x| x as f32));
        };
        for quarter in 0..4 {
            let (sin, cos) = (f64::from(quarter) * std::f64::consts::FRAC_PI_2).sin_cos();
            for i in 0..=QUADS {
                let along = WIDTH / 2.0 + f64::from(i) / f64::from(QUADS);
                for across in [-WIDTH / 2.0, WIDTH / 2.0] {
                    place(cos * along - sin * across, sin * along + cos * across, i);
                }
            }
        }
        let arm = 2 * (QUADS + 1);
        let corner = |quarter: u32| first + quarter * arm;
        triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t: [u32; 3]| t.map(corner)));
        triangles.extend((0..4 * QUADS).flat_map(|i| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| corner(i / QUADS) + 2 * (i % QUADS) + k);
            [[a, d, b], [a, c, d]]
        }));
    }
    (positions, triangles)
}

#[test]
fn a_hundred_crosses_are_cut_until_they_fill_the_page() {
    let (positions, triangles) = crosses(100);
    let [whole, cut] = [1e6, 0.1].map(|seam_weight| {
        let settings = Settings {
            cutting: Cutting {
                seam_weight,
                ..Cutting::default()
            },
            ..Settings::default()
        };
        unwrap(&positions, &triangles, &settings, &Unobserved).expect("crosses")
    });
    assert!(cut.charts.len() > whole.charts.len());
    let exact: Vec<[f64; 3]> = positions.iter().map(|p| p.map(f64::from)).collect();
    let certificate = certify(&exact, &triangles, &cut.corner_uvs(), &Claims::default());
    assert!(certificate.is_bijective(), "{certificate:?}");
    assert!(
        cut.scale > 1.1 * whole.scale,
        "{} {}",
        whole.scale,
        cut.scale
    );
}

#[test]
fn a_cube_becomes_two_charts_whatever_the_order_of_its_faces() {
    let mut cube = voxels(&[[0, 0, 0]]);
    let settings = Settings::default();
    for _ in 0..cube.triangles.len() {
        cube.triangles.rotate_left(1);
        let unwrapped =
            unwrap(&cube.positions, &cube.triangles, &settings, &Unobserved).expect("a cube");
        // More would not fill more: a square holds six smaller ones only where it would hold nine.
        assert_eq!(unwrapped.charts.len(), 2);
        let fill = 6.0 * unwrapped.scale * unwrapped.scale;
        assert!((0.65..2.0 / 3.0).contains(&fill), "{fill}");
    }
}

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

#[test]
fn bars_and_combs_are_cut_until_they_fill_the_page() {
    let bar: Vec<[i32; 3]> = (0..12).map(|x| [x, 0, 0]).collect();
    let tooth = |x: i32| (0..if x % 2 == 0 { 4 } else { 1 }).map(move |z| [x, 0, z]);
    let comb: Vec<[i32; 3]> = (0..9).flat_map(tooth).collect();
    for cells in [bar, comb] {
        let mesh = voxels(&cells);
        let [whole, cut] = [1e6, 0.1].map(|seam_weight| {
            let settings = Settings {
                cutting: Cutting {
                    seam_weight,
                    ..Cutting::default()
                },
                ..Settings::default()
            };
            unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved).expect("a mesh")
        });
        assert!(cut.charts.len() > whole.charts.len());
        let exact: Vec<[f64; 3]> = mesh.positions.iter().map(|p| p.map(f64::from)).collect();
        let certificate = certify(
            &exact,
            &mesh.triangles,
            &cut.corner_uvs(),
            &Claims::default(),
        );
        assert!(certificate.is_bijective(), "{certificate:?}");
        assert!(
            cut.scale > 1.05 * whole.scale,
            "{} {}",
            whole.scale,
            cut.scale
        );
    }
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

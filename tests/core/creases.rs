//! Hard surfaces, cut along their creases.

use crate::zoo::{self, Mesh};
use unwrapd::certificate::{Claims, certify};
use unwrapd::charts::{Bound, MappedChart, Symmetry, Unobserved, charts_under_bound};
use unwrapd::embed::Options;
use unwrapd::energy::EnergyKind;
use unwrapd::mesh::Surface;
use unwrapd::numerics::vec3::distance;

fn mesh(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh {
        positions,
        triangles,
        ..Mesh::default()
    }
}

fn unfolded(mesh: &Mesh) -> Vec<MappedChart> {
    let surface = Surface::new(&mesh.positions, &mesh.triangles).expect("a usable mesh");
    let options = Options {
        energy: EnergyKind::SymmetricDirichlet,
        ..Options::default()
    };
    let bound = Bound {
        mean: 4.1,
        stretch: None,
    };
    charts_under_bound(&surface, &bound, &options, Symmetry::Auto, &Unobserved)
}

/// For each side of a triangle its length in the map over that on the surface.
fn edge_ratios(map: &MappedChart) -> Vec<f64> {
    let sides = (map.chart.disk.triangles.iter()).flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let ratio = |side: [u32; 2]| {
        let [p, q] = side.map(|v| map.chart.positions[v as usize]);
        let [[x, y], [z, w]] = side.map(|v| map.embedding.uv[v as usize]);
        (z - x).hypot(w - y) / distance(p, q)
    };
    sides.map(ratio).collect()
}

/// Every edge of a chart is as long in its map as on the surface, and the judge finds neither flips nor overlaps.
#[track_caller]
fn assert_unfolded(charts: &[MappedChart]) {
    for map in charts {
        for ratio in edge_ratios(map) {
            assert!((ratio - 1.0).abs() < 1e-4, "{ratio}");
        }
        let (chart, embedding) = (&map.chart, &map.embedding);
        let uv = |v: u32| embedding.uv[v as usize];
        let corners: Vec<_> = (chart.disk.triangles.iter())
            .map(|triangle| triangle.map(uv))
            .collect();
        let certificate = certify(
            &chart.positions,
            &chart.disk.triangles,
            &corners,
            &Claims::default(),
        );
        assert!(certificate.is_valid(), "{certificate:?}");
    }
}

/// A prism with `n` sides, closed by two discs.
fn cylinder(n: u32, height: f32) -> Mesh {
    let at = |i: u32, z: f32| {
        let angle = std::f32::consts::TAU * i as f32 / n as f32;
        [angle.cos(), angle.sin(), z]
    };
    let rings = (0..n)
        .map(|i| at(i, 0.0))
        .chain((0..n).map(|i| at(i, height)));
    let mut triangles = Vec::new();
    for i in 0..n {
        let j = (i + 1) % n;
        triangles.extend([[i, j, n + j], [i, n + j, n + i]]);
    }
    for i in 1..n - 1 {
        triangles.extend([[0, i + 1, i], [n, n + i, n + i + 1]]);
    }
    mesh(rings.collect(), triangles)
}

#[test]
fn a_cube_becomes_a_cross() {
    let charts = unfolded(&zoo::voxels(&[[0, 0, 0]]));
    assert_eq!(charts.len(), 1);
    assert_unfolded(&charts);
}

#[test]
fn a_cylinder_becomes_a_rectangle_and_two_discs() {
    for n in [16, 64] {
        let charts = unfolded(&cylinder(n, 3.0));
        assert_unfolded(&charts);
        let mut sizes: Vec<usize> = charts
            .iter()
            .map(|c| c.chart.disk.triangles.len())
            .collect();
        sizes.sort_unstable();
        let disc = n as usize - 2;
        assert_eq!(sizes, [disc, disc, 2 * n as usize]);
    }
}

#[test]
fn a_bent_sheet_becomes_its_blank() {
    // Two plates and the quarter of a cylinder between them.
    let (n, radius, length) = (8_u16, 0.5_f32, 2.0_f32);
    let mut profile = vec![[-length, 0.0]];
    profile.extend((0..=n).map(|i| {
        let angle = std::f32::consts::FRAC_PI_2 * f32::from(i) / f32::from(n);
        [radius * angle.sin(), radius * (1.0 - angle.cos())]
    }));
    profile.push([radius, radius + length]);
    let rows = profile.len() as u32;
    let positions = (profile.iter().map(|&[x, z]| [x, 0.0, z]))
        .chain(profile.iter().map(|&[x, z]| [x, 1.0, z]))
        .collect();
    let triangles = (0..rows - 1)
        .flat_map(|i| [[i, i + 1, rows + i + 1], [i, rows + i + 1, rows + i]])
        .collect();
    let charts = unfolded(&mesh(positions, triangles));
    assert_eq!(charts.len(), 1);
    assert_unfolded(&charts);
}

#[test]
fn walls_of_many_steps_are_not_stretched() {
    let staircase: Vec<[i32; 3]> = (0..5)
        .flat_map(|x| (0..=x).map(move |z| [x, 0, z]))
        .collect();
    let charts = unfolded(&zoo::voxels(&staircase));
    assert_unfolded(&charts);
    assert!(charts.len() <= 3, "{} charts", charts.len());
}

#[test]
fn what_is_round_is_not_taken_to_be_hard() {
    let charts = unfolded(&zoo::sphere(24, 12));
    let stretch = (charts.iter().flat_map(edge_ratios)).fold(1.0, f64::max);
    assert!(stretch > 1.01, "a sphere cannot be unfolded");
}

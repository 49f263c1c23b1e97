//! Hard surfaces, cut along their creases.

use std::sync::Arc;

use crate::zoo::{self, Mesh};
use std::collections::BTreeMap;
use unwrapd_layout::charts::{
    Bound, Bounded, MappedChart, Symmetry, Unobserved, charts_under_bound,
};
use unwrapd_maps::certificate::{Claims, certify};
use unwrapd_maps::embed::Options;
use unwrapd_maps::mesh::Surface;
use unwrapd_method::energy::SymmetricDirichlet;
use unwrapd_method::numerics::vec3::{area_vector, distance, dot, unit};

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
        density: Arc::new(SymmetricDirichlet),
        ..Options::default()
    };
    let bound = Bound {
        mean: 4.1,
        stretch: None,
        of: Bounded::Surface,
    };
    charts_under_bound(&surface, &bound, 1.0, &options, Symmetry::Auto, &Unobserved)
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

/// An edge by the places of its ends.
type Place = [[i64; 3]; 2];

/// The seams of charts of a closed surface, with the normals of the faces beside each.
fn seams(charts: &[MappedChart]) -> BTreeMap<Place, Vec<[f64; 3]>> {
    let mut seams: BTreeMap<Place, Vec<[f64; 3]>> = BTreeMap::new();
    for MappedChart { chart, .. } in charts {
        let mut sides: BTreeMap<[u32; 2], Vec<[f64; 3]>> = BTreeMap::new();
        for &[a, b, c] in &chart.disk.triangles {
            let [p, q, r] = [a, b, c].map(|v| chart.positions[v as usize]);
            for [v, w] in [[a, b], [b, c], [c, a]] {
                let edge = sides.entry([v.min(w), v.max(w)]).or_default();
                edge.push(unit(area_vector(p, q, r)));
            }
        }
        for (ends, normals) in sides.into_iter().filter(|(_, normals)| normals.len() == 1) {
            let place = |v: u32| chart.positions[v as usize].map(|x| (1e4 * x).round() as i64);
            let mut ends = ends.map(place);
            ends.sort_unstable();
            seams.entry(ends).or_default().extend(normals);
        }
    }
    seams
}

/// No seam runs between two faces of a plane.
#[track_caller]
fn assert_planes_whole(charts: &[MappedChart]) {
    for (edge, normals) in seams(charts) {
        if let [a, b] = normals[..] {
            assert!(dot(a, b) < 0.999_85, "{edge:?}");
        }
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
    assert_planes_whole(&charts);
    // Of twelve edges five hold the six sides together.
    assert_eq!(seams(&charts).len(), 7);
    // A cross has four squares in a row and three in the other: it fills six of twelve.
    let uv = &charts[0].embedding.uv;
    let along = |direction: [f64; 2]| {
        let places = uv.iter().map(|p| p[0] * direction[0] + p[1] * direction[1]);
        let (low, high) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        high - low
    };
    let [a, b, _] = charts[0].chart.disk.triangles[0].map(|v| uv[v as usize]);
    let [x, y] = [b[0] - a[0], b[1] - a[1]];
    let turns = [[x, y], [x + y, y - x]].map(|[x, y]| [x / x.hypot(y), y / x.hypot(y)]);
    let boxes = turns.map(|[x, y]| along([x, y]) * along([-y, x]));
    let smallest = boxes[0].min(boxes[1]);
    assert!((smallest - 12.0).abs() < 1e-3, "{smallest}");
}

#[test]
fn both_sides_of_a_plane_are_cut_alike() {
    // An angle bar with unequal arms is its own mirror image only in the plane y = 1/2.
    let charts = unfolded(&zoo::voxels(&[[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 0, 1]]));
    assert_unfolded(&charts);
    assert_planes_whole(&charts);
    let seams = seams(&charts);
    for edge in seams.keys() {
        let mut image = edge.map(|[x, y, z]| [x, 10_000 - y, z]);
        image.sort_unstable();
        assert!(seams.contains_key(&image), "{edge:?}");
    }
}

/// A cylinder whose wall has `n` sides, with a floor, and half a sphere of `m` rings on top.
fn domed_cylinder(n: u32, m: u32, height: f32) -> Mesh {
    let at = |i: u32, radius: f32, z: f32| {
        let angle = std::f32::consts::TAU * i as f32 / n as f32;
        [radius * angle.cos(), radius * angle.sin(), z]
    };
    let mut positions: Vec<[f32; 3]> = (0..n).map(|i| at(i, 1.0, -height)).collect();
    for j in 0..m {
        let (z, radius) = (std::f32::consts::FRAC_PI_2 * j as f32 / m as f32).sin_cos();
        positions.extend((0..n).map(|i| at(i, radius, z)));
    }
    let pole = positions.len() as u32;
    positions.push([0.0, 0.0, 1.0]);
    let mut triangles: Vec<[u32; 3]> = (1..n - 1).map(|i| [0, i + 1, i]).collect();
    for i in 0..n {
        let j = (i + 1) % n;
        for ring in 0..m {
            let (low, high) = (n * ring, n * (ring + 1));
            triangles.extend([[low + i, low + j, high + j], [low + i, high + j, high + i]]);
        }
        triangles.push([n * m + i, n * m + j, pole]);
    }
    mesh(positions, triangles)
}

#[test]
fn planes_beside_what_is_round_stay_whole_and_unstretched() {
    let charts = unfolded(&domed_cylinder(32, 8, 3.0));
    assert_planes_whole(&charts);
    let (mut of_planes, mut of_dome) = (1.0_f64, 1.0_f64);
    for map in &charts {
        let faces = map.chart.disk.triangles.iter();
        for (triangle, ratios) in faces.zip(edge_ratios(map).as_chunks::<3>().0) {
            let highest = triangle.map(|v| map.chart.positions[v as usize][2]);
            let is_flat = highest.into_iter().all(|z| z < 1e-6);
            let most = if is_flat {
                &mut of_planes
            } else {
                &mut of_dome
            };
            *most = ratios
                .iter()
                .fold(*most, |most, ratio| most.max(ratio.max(1.0 / ratio)));
        }
    }
    assert!(of_planes < 1.05, "{of_planes}");
    assert!(of_dome > 1.05, "{of_dome}");
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

/// Asserts that some charts are few and stretched, as those of a round surface are.
#[track_caller]
fn assert_round(charts: &[MappedChart], most: usize) {
    assert!(charts.len() <= most, "{} charts", charts.len());
    let stretch = (charts.iter().flat_map(edge_ratios)).fold(1.0, f64::max);
    assert!(stretch > 1.01, "it cannot be unfolded");
}

#[test]
fn what_is_round_is_not_taken_to_be_hard() {
    for (n, m, most) in [(24, 12, 13), (16, 7, 9), (8, 7, 6), (8, 5, 8), (10, 5, 9)] {
        assert_round(&unfolded(&zoo::sphere(n, m)), most);
    }
    for (n, m) in [(16, 8), (12, 8), (8, 8)] {
        assert_round(&unfolded(&zoo::torus(n, m)), 8);
    }
}

/// A shallow dome over a square of `n` × `n` squares.
fn dome(n: u32) -> Mesh {
    let mut dome = zoo::grid(n, n);
    for [x, y, z] in &mut dome.positions {
        [*x, *y] = [*x, *y].map(|at| at / n as f32 - 0.5);
        *z = -0.25 * (*x * *x + *y * *y);
    }
    dome
}

#[test]
fn what_is_round_is_not_taken_to_be_hard_however_fine_it_is() {
    assert_round(&unfolded(&dome(120)), 1);
}

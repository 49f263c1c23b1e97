//! The search for where to cut.

use crate::zoo::{self, Mesh};
use std::f32::consts::{PI, TAU};
use std::sync::Arc;
use unwrapd_layout::charts::{
    Bound, Bounded, Cut, Folds, MappedChart, Symmetry, Unobserved, charts, map_chart, seam_length,
};
use unwrapd_layout::search::{
    CutProblem, SearchEffort, Terms, charts_at_cones, charts_through, from_charts, from_surface,
    maps_at_cones_under_bound,
};
use unwrapd_maps::certificate::{Claims, certify};
use unwrapd_maps::embed::Options;
use unwrapd_maps::mesh::{Surface, canonical_order};
use unwrapd_method::energy::SymmetricDirichlet;
use unwrapd_method::numerics::square::{Square, times};
use unwrapd_method::numerics::vec2::{doubled_area, sub};
use unwrapd_method::numerics::vec3::distance;

fn options() -> Options {
    Options {
        density: Arc::new(SymmetricDirichlet),
        ..Options::default()
    }
}

fn bound(mean: f64) -> Bound {
    Bound {
        mean,
        stretch: None,
        of: Bounded::Surface,
    }
}

fn surface(mesh: &Mesh) -> Surface {
    Surface::new(&mesh.positions, &mesh.triangles).expect("a usable mesh")
}

/// Terms without a limit, by which the fill of the page does not count.
fn unbounded() -> Terms {
    Terms {
        fill_weight: 0.0,
        ..Terms::default()
    }
}

/// Charts of a mesh, checked.
fn divided(mesh: &Mesh, mean: f64) -> Vec<MappedChart> {
    let surface = surface(mesh);
    let (charts, _) = from_surface(
        &CutProblem::new(&surface, &bound(mean), &Unobserved),
        &unbounded(),
        &options(),
        Symmetry::Auto,
        &Unobserved,
    );
    check(&surface, &charts);
    charts
}

/// Mapped charts whose normals lie within a cone: more than are needed.
fn cut(surface: &Surface) -> Vec<MappedChart> {
    (charts(surface, Cut::Fast).into_iter())
        .flat_map(|chart| map_chart(chart, &options(), Folds::Cut, &Unobserved))
        .collect()
}

/// Every face is in one chart, and no map has flips or overlaps.
fn check(surface: &Surface, charts: &[MappedChart]) {
    let mut faces: Vec<u32> = (charts.iter())
        .flat_map(|map| map.chart.corners.iter().map(|corners| corners[0] / 3))
        .collect();
    faces.sort_unstable();
    let all: Vec<u32> = (0..surface.triangles.len() as u32).collect();
    assert_eq!(faces, all, "each face is in one chart");
    for map in charts {
        let triangles = &map.chart.disk.triangles;
        let corners: Vec<[[f64; 2]; 3]> = (triangles.iter())
            .map(|triangle| triangle.map(|v| map.embedding.uv[v as usize]))
            .collect();
        let certificate = certify(
            &map.chart.positions,
            triangles,
            &corners,
            &Claims::default(),
        );
        assert!(certificate.is_valid(), "{certificate:?}");
    }
}

/// Seam length over the root of the area.
fn seam(charts: &[MappedChart]) -> f64 {
    let area: f64 = charts.iter().map(MappedChart::surface_area).sum();
    seam_length(charts) / area.sqrt()
}

/// Mean symmetric Dirichlet energy.
fn energy(charts: &[MappedChart]) -> f64 {
    let (mut sum, mut area) = (0.0, 0.0);
    for map in charts {
        let rest =
            unwrapd_maps::embed::rest_shapes(&map.chart.positions, &map.chart.disk.triangles);
        let unit = rest.scale * rest.scale;
        for (triangle, shape) in map.chart.disk.triangles.iter().zip(&rest.shapes) {
            let [a, b, c] = triangle.map(|v| map.embedding.uv[v as usize].map(|x| x / rest.scale));
            let (first, last) = (sub(b, a), sub(c, a));
            let sides = [[first[0], last[0]], [first[1], last[1]]];
            let det = doubled_area(a, b, c) / (2.0 * shape.size);
            let [s, t] = times(&sides, &shape.inverse).singular_values(det);
            sum += unit * shape.weight * (s * s + t * t + 1.0 / (s * s) + 1.0 / (t * t));
            area += unit * shape.weight;
        }
    }
    sum / area
}

/// A tube of radius 1 along a quarter of a circle of radius 3, `n` squares around and `m` along.
fn elbow(n: u32, m: u32) -> Mesh {
    let bent = |i: u32, j: u32| {
        let (t, p) = (TAU * i as f32 / n as f32, PI / 2.0 * j as f32 / m as f32);
        let r = 3.0 + t.cos();
        [r * p.cos(), r * p.sin(), t.sin()]
    };
    let mut triangles = Vec::new();
    for j in 0..m {
        for i in 0..n {
            let at = |i: u32, j: u32| j * n + i % n;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh {
        positions: (0..=m)
            .flat_map(|j| (0..n).map(move |i| bent(i, j)))
            .collect(),
        triangles,
        ..Mesh::default()
    }
}

/// A frustum without caps: `n` squares around.
fn lamp_shade(n: u32) -> Mesh {
    let mut mesh = zoo::tube(n, 2.0);
    for p in &mut mesh.positions {
        let radius = if p[2] > 1.0 { 0.4 } else { 1.0 };
        *p = [radius * p[0], radius * p[1], p[2]];
    }
    mesh
}

/// Protects the promise of the module for everything nasty that is small.
#[test]
fn any_surface_is_divided_into_maps_without_overlaps() {
    for mesh in zoo::zoo().iter().filter(|mesh| mesh.name != "empty") {
        println!("{}", mesh.name);
        divided(mesh, 4.1);
    }
}

/// Protects the same from given charts and from components slit open, which hold panels in some of these surfaces.
#[test]
fn any_charts_are_improved_without_overlaps() {
    for mesh in zoo::zoo().iter().filter(|mesh| mesh.name != "empty") {
        println!("{}", mesh.name);
        let surface = surface(mesh);
        let (cut, terms) = (cut(&surface), Terms::default());
        let (found, _) = from_charts(
            &CutProblem::new(&surface, &bound(4.1), &Unobserved),
            cut,
            &terms,
            &options(),
            &Unobserved,
        );
        check(&surface, &found);
    }
}

/// A surface without area has no metric to search in, but its map has places.
#[test]
fn a_surface_without_area_is_mapped() {
    let mut mesh = zoo::grid(2, 2);
    for p in &mut mesh.positions {
        *p = [p[0] + 3.0 * p[1], 0.0, 0.0];
    }
    let surface = surface(&mesh);
    let problem = CutProblem::new(&surface, &bound(4.1), &Unobserved);
    let terms = Terms::default();
    let (found, _) = from_surface(&problem, &terms, &options(), Symmetry::Auto, &Unobserved);
    assert!(!found.is_empty());
    let places = found.iter().flat_map(|map| &map.embedding.uv).flatten();
    assert!(places.copied().all(f64::is_finite));
}

/// Panels are laid out in a few charts even where the effort is far too small to glue them one by one.
#[test]
fn panels_are_slit_open_where_that_is_cheaper() {
    let steps: Vec<[i32; 3]> = (0..8)
        .flat_map(|x| (0..=x).map(move |z| [x, 0, z]))
        .collect();
    let surface = surface(&zoo::voxels(&steps));
    let mut effort = SearchEffort::for_surface(surface.triangles.len(), surface.triangles.len());
    effort.most = 8.0 * surface.triangles.len() as f64;
    let terms = Terms {
        effort,
        ..Terms::default()
    };
    let problem = CutProblem::new(&surface, &bound(4.1), &Unobserved);
    let (found, _) = from_surface(&problem, &terms, &options(), Symmetry::Off, &Unobserved);
    check(&surface, &found);
    assert!(found.len() <= 6, "{}", found.len());
    assert!(energy(&found) <= 4.1, "{}", energy(&found));
}

/// A cube opens to one net: seven of its twelve edges are cut.
#[test]
fn a_cube_becomes_one_net() {
    let charts = divided(&zoo::voxels(&[[0, 0, 0]]), 4.001);
    assert_eq!(charts.len(), 1);
    assert!(
        (seam(&charts) - 7.0 / 6.0_f64.sqrt()).abs() < 1e-6,
        "{}",
        seam(&charts)
    );
}

/// A bent tube becomes one strip, cut along its length, not ring by ring.
#[test]
fn an_elbow_is_slit_once() {
    let charts = divided(&elbow(12, 8), 4.1);
    assert_eq!(charts.len(), 1);
    // The inner side of the bend is a quarter of a circle of radius 2.
    let area: f64 = charts.iter().map(MappedChart::surface_area).sum();
    let shortest = f64::from(PI) / area.sqrt();
    assert!(
        seam(&charts) < 1.01 * shortest,
        "{} for {shortest}",
        seam(&charts)
    );
    assert!(energy(&charts) <= 4.1, "{}", energy(&charts));
}

/// A lamp shade is slit once and then flat, whatever its tessellation.
#[test]
fn a_lamp_shade_is_slit_once() {
    for n in [6, 16, 48] {
        let charts = divided(&lamp_shade(n), 4.1);
        assert_eq!(charts.len(), 1, "{n} sides");
        assert!(energy(&charts) < 4.001, "{n} sides: {}", energy(&charts));
        let slit = (0.6_f64 * 0.6 + 4.0).sqrt();
        let length = seam_length(&charts);
        assert!(
            (length - slit).abs() < 1e-3,
            "{n} sides: {length} for {slit}"
        );
    }
}

/// A plate with a hole is flat as it is.
#[test]
fn a_plate_with_a_hole_stays_whole() {
    let mut plate = zoo::grid(5, 5).without(&[24, 25]);
    plate.positions.iter_mut().for_each(|p| p[2] = 0.0);
    let charts = divided(&plate, 4.1);
    assert_eq!(charts.len(), 1);
    assert!(seam(&charts) < 1e-9);
}

/// The mean energy keeps the bound, and a looser bound costs no more seam.
#[test]
fn the_bound_is_kept_and_its_slack_is_spent() {
    for mesh in [zoo::sphere(16, 11), zoo::torus(16, 10), elbow(10, 12)] {
        let mut before = f64::INFINITY;
        for mean in [4.02, 4.1, 4.5] {
            let charts = divided(&mesh, mean);
            assert!(energy(&charts) <= mean, "{} for {mean}", energy(&charts));
            let cost = seam(&charts) + charts.len() as f64 / 10.0;
            assert!(cost <= 1.02 * before, "{cost} after {before} at {mean}");
            before = cost;
        }
    }
}

/// Maps of the components of a mesh, slit to cones; they may overlap themselves.
fn maps_at_cones(mesh: &Mesh, n_cones: usize) -> Vec<MappedChart> {
    let charts = charts_at_cones(&surface(mesh), n_cones).expect("components can be opened");
    (charts.into_iter())
        .flat_map(|chart| map_chart(chart, &options(), Folds::Keep, &Unobserved))
        .collect()
}

/// Each component becomes one disk; with more cones the seams are longer and the distortion is lower.
#[test]
fn more_cones_lower_the_distortion() {
    for mesh in [zoo::sphere(24, 13), zoo::torus(20, 12), zoo::slab(2)] {
        let mut before = (0.0, f64::INFINITY);
        for n_cones in [2, 4, 8, 16] {
            let maps = maps_at_cones(&mesh, n_cones);
            let after = (seam(&maps), energy(&maps));
            assert_eq!(maps.len(), 1);
            assert!(
                after.0 >= before.0,
                "{n_cones} cones: {after:?} after {before:?}"
            );
            assert!(
                after.1 <= before.1 + 1e-6,
                "{n_cones} cones: {after:?} after {before:?}"
            );
            before = after;
        }
    }
}

/// The corners of a cube are its eight cones: with all of them it unfolds, along a tree of edges or nearly so, as the first slit takes the
/// shortest way across a face.
#[test]
fn a_cube_has_eight_cones() {
    let cube = zoo::voxels(&[[0; 3]]);
    for n_cones in [8, 100] {
        let maps = maps_at_cones(&cube, n_cones);
        assert!((energy(&maps) - 4.0).abs() < 1e-6, "{}", energy(&maps));
        let (shortest, longest) = (7.0 / 6_f64.sqrt(), (6.0 + 2_f64.sqrt()) / 6_f64.sqrt());
        assert!(
            (shortest - 1e-6..=longest + 1e-6).contains(&seam(&maps)),
            "{}",
            seam(&maps)
        );
    }
    // The first slit passes a third corner.
    assert!(energy(&maps_at_cones(&cube, 5)) > 4.01);
}

/// Each component becomes one disk that has every given cone on its boundary, whatever the topology and wherever the cones are.
#[test]
fn slits_pass_through_given_cones() {
    let two = zoo::sphere(12, 7).with(&zoo::torus(12, 8).moved([4.0, 0.0, 0.0]));
    let meshes = [zoo::sphere(12, 7), zoo::torus(12, 8), zoo::grid(6, 5), two];
    for (mesh, n_components) in meshes.iter().zip([1, 1, 1, 2]) {
        let surface = surface(mesh);
        let [a, b, _] = surface.triangles[0];
        let last = surface.positions.len() as u32 - 1;
        let some = (0..=last).step_by(7).collect();
        for cones in [vec![], vec![b], vec![a, b], vec![b, last], some] {
            let charts = charts_through(&surface, &cones).expect("components can be opened");
            assert_eq!(charts.len(), n_components, "{cones:?}");
            let on_boundary: Vec<[f64; 3]> = (charts.iter())
                .flat_map(|chart| {
                    let loops = chart.disk.loops.concat();
                    loops.into_iter().map(|v| chart.positions[v as usize])
                })
                .collect();
            for &cone in &cones {
                let place = surface.positions[cone as usize];
                assert!(on_boundary.contains(&place), "{cone} of {cones:?}");
            }
            let maps: Vec<MappedChart> = (charts.into_iter())
                .flat_map(|chart| map_chart(chart, &options(), Folds::Cut, &Unobserved))
                .collect();
            check(&surface, &maps);
        }
    }
}

/// A cube that is slit through its eight corners unfolds along a tree of seven edges; one corner fewer leaves distortion.
#[test]
fn a_cube_unfolds_at_its_given_corners() {
    let surface = surface(&zoo::voxels(&[[0; 3]]));
    let maps = |cones: &[u32]| -> Vec<MappedChart> {
        let charts = charts_through(&surface, cones).expect("it can be opened");
        (charts.into_iter())
            .flat_map(|chart| map_chart(chart, &options(), Folds::Keep, &Unobserved))
            .collect()
    };
    let corners: Vec<u32> = (0..8).collect();
    let unfolded = maps(&corners);
    assert!((energy(&unfolded) - 4.0).abs() < 1e-6);
    let edges = 7.0 / 6_f64.sqrt();
    assert!(
        (seam(&unfolded) - edges).abs() < 1e-6,
        "{}",
        seam(&unfolded)
    );
    assert!(energy(&maps(&corners[1..])) > 4.01);
}

/// Cones are as many as the bound needs: a tighter one takes longer seams, and the mean energy keeps it.
#[test]
fn cones_are_chosen_to_a_bound() {
    for mesh in [zoo::sphere(24, 13), zoo::torus(20, 12), zoo::slab(2)] {
        let surface = surface(&mesh);
        let mut before = f64::INFINITY;
        for mean in [4.02, 4.1, 4.5] {
            let problem = CutProblem::new(&surface, &bound(mean), &Unobserved);
            let maps = maps_at_cones_under_bound(&problem, &options(), &Unobserved);
            let maps = maps.expect("components can be opened");
            check(&surface, &maps);
            assert!(energy(&maps) <= mean, "{} for {mean}", energy(&maps));
            assert!(seam(&maps) <= before, "{} at {mean}", seam(&maps));
            before = seam(&maps);
        }
    }
}

/// Charts that are cut more than they need to be get fewer and shorter seams.
#[test]
fn given_charts_get_shorter_seams() {
    let mesh = elbow(12, 8);
    let surface = surface(&mesh);
    let start = cut(&surface);
    let (found, _) = from_charts(
        &CutProblem::new(&surface, &bound(4.1), &Unobserved),
        start.clone(),
        &Terms::default(),
        &options(),
        &Unobserved,
    );
    check(&surface, &found);
    assert!(found.len() < start.len());
    assert!(seam(&found) < seam(&start));
    assert!(energy(&found) <= 4.1, "{}", energy(&found));
}

/// Both parts of a ramp that winds around its axis one and a half times are known to collide without mapping them as one.
#[test]
fn parts_that_collide_are_not_mapped() {
    let mesh = ramp(36);
    let surface = surface(&mesh);
    let parts: Vec<MappedChart> = (charts(&surface, Cut::Disk).into_iter())
        .flat_map(|chart| map_chart(chart, &options(), Folds::Cut, &Unobserved))
        .collect();
    assert_eq!(parts.len(), 2);
    let (found, counts) = from_charts(
        &CutProblem::new(&surface, &bound(4.1), &Unobserved),
        parts,
        &Terms::default(),
        &options(),
        &Unobserved,
    );
    check(&surface, &found);
    assert_eq!(found.len(), 2);
    assert!(counts.collided > 0);
    assert_eq!(counts.failed, 0);
}

/// A search that may do nothing returns what it was given.
#[test]
fn charts_stay_without_effort() {
    let mesh = elbow(12, 8);
    let surface = surface(&mesh);
    let cut = cut(&surface);
    let idle = Terms {
        effort: SearchEffort::for_surface(0, 1),
        ..Terms::default()
    };
    let (found, counts) = from_charts(
        &CutProblem::new(&surface, &bound(4.1), &Unobserved),
        cut.clone(),
        &idle,
        &options(),
        &Unobserved,
    );
    assert_eq!(found.len(), cut.len());
    assert_eq!(seam(&found), seam(&cut));
    assert_eq!(counts.glued + counts.reopened, 0);
}

/// Pose, scale and order change numbers at the size of rounding, not the cut, although many parts of these shapes are alike.
#[test]
fn pose_and_order_do_not_change_the_cut() {
    for mesh in [elbow(12, 8), beveled_box(0.1)] {
        let of = |mesh: &Mesh| {
            let surface = surface(mesh);
            let surface = surface.reordered(&canonical_order(&surface));
            let (charts, _) = from_surface(
                &CutProblem::new(&surface, &bound(4.1), &Unobserved),
                &unbounded(),
                &options(),
                Symmetry::Auto,
                &Unobserved,
            );
            (charts.len(), seam(&charts))
        };
        let tiny = posed(&mesh, [0.0, 0.0], 1e-3);
        let turned = [[0.3, 0.7], [1.9, 2.3], [4.0, 5.1]].map(|turn| posed(&mesh, turn, 0.37));
        let mut shuffled = mesh.shuffled();
        for triangle in shuffled.triangles.iter_mut().step_by(2) {
            triangle.rotate_left(1);
        }
        let (n, length) = of(&mesh);
        for other in turned.iter().chain([&tiny, &shuffled]) {
            let (m, other) = of(other);
            assert_eq!(n, m);
            assert!(
                (length - other).abs() < 1e-3 * length,
                "{length} and {other}"
            );
        }
    }
}

/// A mesh turned about two axes, and scaled.
fn posed(mesh: &Mesh, [about_x, about_z]: [f32; 2], size: f32) -> Mesh {
    let turned = |[x, y]: [f32; 2], angle: f32| {
        let (sin, cos) = angle.sin_cos();
        [cos * x - sin * y, sin * x + cos * y]
    };
    let mut mesh = mesh.clone();
    for p in &mut mesh.positions {
        let [x, y] = turned([p[0], p[1]], about_z);
        let [y, z] = turned([y, p[2]], about_x);
        *p = [size * x, size * y, size * z];
    }
    mesh
}

/// A box with beveled edges keeps its sides nearly straight: the bevels take the distortion. If panels counted once, the sides would be
/// stretched by 6 %.
#[test]
fn panels_stay_straight() {
    for map in &divided(&beveled_box(0.3), 4.1) {
        let (chart, uv) = (&map.chart, &map.embedding.uv);
        for (triangle, corners) in chart.disk.triangles.iter().zip(&chart.corners) {
            // The first twelve triangles are the sides.
            if corners[0] / 3 < 12 {
                for side in [[0, 1], [1, 2], [2, 0]] {
                    let [a, b] = side.map(|k| triangle[k] as usize);
                    let [x, y] = sub(uv[a], uv[b]);
                    let length = distance(chart.positions[a], chart.positions[b]);
                    let stretch = x.hypot(y) / length;
                    assert!((stretch - 1.0).abs() < 0.03, "{stretch}");
                }
            }
        }
    }
}

/// The walls of a ring are straight strips, whatever its tessellation. If they counted once, walls and ends would be bent to one chart.
#[test]
fn walls_stay_straight() {
    for n in [8, 24] {
        let energy = energy(&divided(&ring(n), 4.1));
        assert!(energy < 4.01, "{energy}");
    }
}

/// A flat ring from radius 2 to 3 that rises slightly and goes on around its axis: `n` squares, 24 a turn.
fn ramp(n: u32) -> Mesh {
    let point = |i: u32, radius: f32| {
        let (sin, cos) = (i as f32 * TAU / 24.0).sin_cos();
        [radius * cos, radius * sin, 0.002 * i as f32]
    };
    Mesh {
        name: format!("ramp {n}"),
        positions: (0..=n)
            .flat_map(|i| [point(i, 2.0), point(i, 3.0)])
            .collect(),
        triangles: (0..n)
            .map(|i| 2 * i)
            .flat_map(|a| [[a, a + 1, a + 3], [a, a + 3, a + 2]])
            .collect(),
    }
}

/// A tube of radius 1, height 1 and thickness 0.1: `n` squares around each of its walls and ends.
fn ring(n: u32) -> Mesh {
    let corners: [[f32; 2]; 4] = [[1.0, 0.0], [1.0, 1.0], [0.9, 1.0], [0.9, 0.0]];
    let on_circle = |i: u32, [r, z]: [f32; 2]| {
        let t = TAU * i as f32 / n as f32;
        [r * t.cos(), r * t.sin(), z]
    };
    let mut triangles = Vec::new();
    for (k, i) in (0..4).flat_map(|k| (0..n).map(move |i| (k, i))) {
        let at = |k: u32, i: u32| (k % 4) * n + i % n;
        let [a, b, c, d] = [at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    Mesh {
        positions: (corners.into_iter())
            .flat_map(|corner| (0..n).map(move |i| on_circle(i, corner)))
            .collect(),
        triangles,
        ..Mesh::default()
    }
}

/// A cube of side 2 whose edges and corners are cut off; the six sides come first.
fn beveled_box(bevel: f32) -> Mesh {
    let inner = 1.0 - bevel;
    let axes = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];
    let place = |axis: [usize; 3], x: f32, y: f32, z: f32| {
        let mut p = [0.0; 3];
        (p[axis[0]], p[axis[1]], p[axis[2]]) = (x, y, z);
        p
    };
    let mut quads: Vec<[[f32; 3]; 4]> = Vec::new();
    for axis in axes {
        for side in [1.0, -1.0] {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            let mut quad = corners.map(|[y, z]| place(axis, side, y * inner, z * inner));
            if side < 0.0 {
                quad.reverse();
            }
            quads.push(quad);
        }
    }
    for axis in axes {
        for (s, t) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
            let mut quad = [
                place(axis, s, t * inner, -inner),
                place(axis, s * inner, t, -inner),
                place(axis, s * inner, t, inner),
                place(axis, s, t * inner, inner),
            ];
            if s * t < 0.0 {
                quad.reverse();
            }
            quads.push(quad);
        }
    }
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for quad in quads {
        let n = positions.len() as u32;
        positions.extend(quad);
        triangles.extend([[n, n + 1, n + 2], [n, n + 2, n + 3]]);
    }
    for s in [1.0, -1.0] {
        for t in [1.0, -1.0] {
            for u in [1.0, -1.0] {
                let n = positions.len() as u32;
                positions.extend([
                    [s, t * inner, u * inner],
                    [s * inner, t, u * inner],
                    [s * inner, t * inner, u],
                ]);
                triangles.push(if s * t * u > 0.0 {
                    [n, n + 1, n + 2]
                } else {
                    [n, n + 2, n + 1]
                });
            }
        }
    }
    Mesh {
        positions,
        triangles,
        ..Mesh::default()
    }
}

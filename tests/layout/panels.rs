//! Surfaces that consist of panels, cut along their creases by the search.

use std::sync::Arc;

use crate::zoo::{self, Mesh};
use std::collections::BTreeMap;
use unwrapd_layout::charts::{Bound, Bounded, MappedChart, Symmetry, Unobserved};
use unwrapd_layout::search::{CutProblem, SearchEffort, Terms, from_surface};
use unwrapd_maps::certificate::{Claims, certify};
use unwrapd_maps::embed::{Options, rest_shapes};
use unwrapd_maps::mesh::Surface;
use unwrapd_method::energy::SymmetricDirichlet;
use unwrapd_method::numerics::square::{Square, times};
use unwrapd_method::numerics::vec2::{doubled_area, sub};
use unwrapd_method::numerics::vec3::{area_vector, distance, dot, norm, unit};

fn mesh(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh {
        positions,
        triangles,
        ..Mesh::default()
    }
}

const BOUND: Bound = Bound {
    mean: 4.1,
    stretch: None,
    of: Bounded::Surface,
};

fn options() -> Options {
    Options {
        density: Arc::new(SymmetricDirichlet),
        ..Options::default()
    }
}

fn surface(mesh: &Mesh) -> Surface {
    Surface::new(&mesh.positions, &mesh.triangles).expect("a usable mesh")
}

/// Charts of a surface that consists of panels, by the search. The fill of the page does not count.
fn unfolded(mesh: &Mesh) -> Vec<MappedChart> {
    unfolded_under(mesh, &BOUND)
}

fn unfolded_under(mesh: &Mesh, bound: &Bound) -> Vec<MappedChart> {
    unfolded_with(mesh, bound, SearchEffort::for_surface)
}

fn unfolded_with(
    mesh: &Mesh,
    bound: &Bound,
    effort: impl Fn(usize, usize) -> SearchEffort,
) -> Vec<MappedChart> {
    let surface = surface(mesh);
    let problem = CutProblem::new(&surface, bound, &Unobserved);
    assert!(problem.is_paneled());
    let n = surface.triangles.len();
    let terms = Terms {
        effort: effort(n, n),
        fill_weight: 0.0,
    };
    from_surface(&problem, &terms, &options(), Symmetry::Auto, &Unobserved).0
}

/// Charts of a surface that does not consist of panels. The fill of the page does not count.
fn cut(mesh: &Mesh) -> Vec<MappedChart> {
    let surface = surface(mesh);
    let problem = CutProblem::new(&surface, &BOUND, &Unobserved);
    assert!(!problem.is_paneled());
    let n = surface.triangles.len();
    let terms = Terms {
        effort: SearchEffort::for_surface(n, n),
        fill_weight: 0.0,
    };
    from_surface(&problem, &terms, &options(), Symmetry::Auto, &Unobserved).0
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

/// Every edge of a chart is as long in its map as on the surface, as far as the solver goes, and the judge finds neither flips nor overlaps.
#[track_caller]
fn assert_unfolded(charts: &[MappedChart]) {
    for map in charts {
        for ratio in edge_ratios(map) {
            assert!((ratio - 1.0).abs() < 2e-3, "{ratio}");
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

/// A square plate of `n` × `n` squares with a bump in its middle.
fn plate_with_bump(n: u32) -> Mesh {
    let mut plate = zoo::grid(n, n);
    for [x, y, z] in &mut plate.positions {
        [*x, *y] = [*x, *y].map(|at| at / n as f32 - 0.5);
        *z = 0.2 * (1.0 - (*x * *x + *y * *y) / 0.09).max(0.0).powi(2);
    }
    plate
}

#[test]
fn planes_beside_what_is_round_are_not_stretched() {
    let charts = unfolded(&plate_with_bump(20));
    let (mut of_plate, mut of_bump) = (1.0_f64, 1.0_f64);
    for map in &charts {
        let faces = map.chart.disk.triangles.iter();
        for (triangle, ratios) in faces.zip(edge_ratios(map).as_chunks::<3>().0) {
            let highest = triangle.map(|v| map.chart.positions[v as usize][2]);
            let is_flat = highest.into_iter().all(|z| z <= 0.0);
            let most = if is_flat { &mut of_plate } else { &mut of_bump };
            *most = ratios
                .iter()
                .fold(*most, |most, ratio| most.max(ratio.max(1.0 / ratio)));
        }
    }
    assert!(of_plate < 1.05, "{of_plate}");
    assert!(of_bump > 1.05, "{of_bump}");
}

#[test]
fn the_wall_of_a_cylinder_becomes_a_rectangle() {
    for n in [16, 64] {
        let charts = unfolded(&cylinder(n, 3.0));
        assert_unfolded(&charts);
        assert_planes_whole(&charts);
        let is_wall = |&[a, b, c]: &[u32; 3]| {
            let lowest = [a, b, c].map(|corner| corner / 3);
            lowest.iter().all(|&face| face < 2 * n)
        };
        let with_wall = charts
            .iter()
            .filter(|map| map.chart.corners.iter().any(is_wall));
        assert_eq!(with_wall.count(), 1);
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

/// Without any effort for the search, facets stay whole.
#[test]
fn no_effort_makes_no_charts_of_single_faces() {
    let bar = zoo::voxels(&[[0, 0, 0], [1, 0, 0], [2, 0, 0]]);
    let charts = unfolded_with(&bar, &BOUND, |n, of_all| {
        SearchEffort::for_surface(n, of_all).share(0.0)
    });
    assert_planes_whole(&charts);
}

/// Asserts that some charts are few and stretched, as those of a round surface are.
#[track_caller]
fn assert_round(charts: &[MappedChart], most: usize) {
    assert!(charts.len() <= most, "{} charts", charts.len());
    let stretch = (charts.iter().flat_map(edge_ratios)).fold(1.0, f64::max);
    assert!(stretch > 1.01, "it cannot be unfolded");
}

#[test]
fn what_is_round_has_no_panels() {
    for (n, m, most) in [(24, 12, 13), (16, 7, 9), (8, 7, 6), (8, 5, 8), (10, 5, 9)] {
        assert_round(&cut(&zoo::sphere(n, m)), most);
    }
    for (n, m) in [(16, 8), (12, 8), (8, 8)] {
        assert_round(&cut(&zoo::torus(n, m)), 8);
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
fn what_is_round_has_no_panels_however_fine_it_is() {
    assert_round(&cut(&dome(120)), 1);
}

/// No more of a surface than a hundredth is stretched beyond a bound on the stretch.
#[test]
fn a_bound_on_the_stretch_is_kept() {
    let mesh = plate_with_bump(20);
    for most in [1.05, 1.2] {
        let bound = Bound {
            stretch: Some(most),
            ..BOUND
        };
        let charts = unfolded_under(&mesh, &bound);
        let (mut stretched, mut area) = (0.0, 0.0);
        for map in &charts {
            for (triangle, sigma) in map.chart.disk.triangles.iter().zip(singular_values(map)) {
                let [p, q, r] = triangle.map(|v| map.chart.positions[v as usize]);
                let own = norm(area_vector(p, q, r));
                area += own;
                if sigma[0] > most || sigma[1] * most < 1.0 {
                    stretched += own;
                }
            }
        }
        assert!(stretched <= 0.01 * area, "{stretched} of {area}");
    }
}

/// Singular values of the map of each face, the larger first.
fn singular_values(map: &MappedChart) -> Vec<[f64; 2]> {
    let rest = rest_shapes(&map.chart.positions, &map.chart.disk.triangles);
    let faces = map.chart.disk.triangles.iter().zip(&rest.shapes);
    let of_face = faces.map(|(triangle, shape)| {
        let [a, b, c] = triangle.map(|v| map.embedding.uv[v as usize].map(|x| x / rest.scale));
        let (first, last) = (sub(b, a), sub(c, a));
        let sides = [[first[0], last[0]], [first[1], last[1]]];
        times(&sides, &shape.inverse).singular_values(doubled_area(a, b, c) / (2.0 * shape.size))
    });
    of_face.collect()
}

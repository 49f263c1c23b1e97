//! Surfaces divided into charts.

use crate::few_vertices::few_vertices;
use crate::places;
use crate::zoo::{self, Mesh};
use proptest::prelude::*;
use std::cell::Cell;
use std::f64::consts::{FRAC_PI_3, FRAC_PI_6};
use std::path::Path;
use unwrapd_layout::charts::{Chart, Cut, MappedChart, charts, halves, min_cut, seam_length};
use unwrapd_maps::embed;
use unwrapd_maps::mesh::{CUT, Disk, Surface};
use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::numerics::vec3::{area_vector, dot, norm};
use unwrapd_method::solver::Control;

fn surface(mesh: &Mesh) -> Surface {
    Surface::new(&mesh.positions, &mesh.triangles).expect("a usable mesh")
}

/// What must hold for the charts of any surface; returns them.
fn checked(surface: &Surface, cut: Cut) -> Vec<Chart> {
    let charts = charts(surface, cut);
    let mut seen = vec![false; surface.triangles.len()];
    for chart in &charts {
        assert_eq!(chart.positions.len(), chart.disk.n_vertices);
        assert_eq!(chart.corners.len(), chart.disk.triangles.len());
        let again = Disk::new(chart.disk.n_vertices, chart.disk.triangles.clone());
        assert_eq!(again.as_ref(), Ok(&chart.disk));
        let (mut balance, mut total) = (0.0, 0.0);
        for (triangle, corners) in chart.disk.triangles.iter().zip(&chart.corners) {
            let t = corners[0] as usize / 3;
            assert!(!seen[t], "triangle {t} is in two charts");
            seen[t] = true;
            let turn = [1, 2, 0].map(|i| corners[i] % 3);
            let kept = (0..3).all(|i| turn[i] == (corners[i] + 1) % 3);
            let turned = (0..3).all(|i| turn[i] == (corners[i] + 2) % 3);
            assert!(kept || turned);
            for (&v, &corner) in triangle.iter().zip(corners) {
                assert_eq!(corner as usize / 3, t);
                let welded = surface.triangles[t][corner as usize % 3];
                let position = surface.positions[welded as usize];
                assert_eq!(chart.positions[v as usize], position);
            }
            let [a, b, c] = surface.corners(t);
            let area = norm(area_vector(a, b, c));
            balance += if kept { area } else { -area };
            total += area;
        }
        assert!(balance >= -1e-9 * total, "wound against most of its area");
    }
    assert!(seen.iter().all(|&s| s), "a triangle is in no chart");
    charts
}

#[test]
fn halves_have_each_triangle_once() {
    for mesh in zoo::zoo() {
        let surface = surface(&mesh);
        let charts = charts(&surface, Cut::Disk);
        for chart in charts.iter().filter(|c| c.corners.len() > 1) {
            let n = chart.disk.triangles.len();
            let parts = halves(chart);
            let sizes: Vec<usize> = parts.iter().map(|part| part.corners.len()).collect();
            assert!(sizes.contains(&(n / 2)) && sizes.iter().sum::<usize>() == n);
            let mut corners: Vec<[u32; 3]> = parts.iter().flat_map(|p| p.corners.clone()).collect();
            let mut expected = chart.corners.clone();
            corners.sort_unstable();
            expected.sort_unstable();
            assert_eq!(corners, expected, "{}", mesh.name);
            for part in &parts {
                for (triangle, corners) in part.disk.triangles.iter().zip(&part.corners) {
                    let welded = corners.map(|c| surface.triangles[c as usize / 3][c as usize % 3]);
                    let positions = welded.map(|v| surface.positions[v as usize]);
                    assert_eq!(triangle.map(|v| part.positions[v as usize]), positions);
                }
            }
        }
    }
}

#[test]
fn the_zoo_is_divided() {
    for mesh in zoo::zoo() {
        println!("{}", mesh.name);
        let surface = surface(&mesh);
        let n_auto = checked(&surface, Cut::Fast).len();
        let n_disk = checked(&surface, Cut::Disk).len();
        // Pages of a book share no edge but the one.
        if !mesh.name.ends_with("on an edge") {
            assert_eq!(n_disk, surface.defects.components, "{}", mesh.name);
        }
        assert!(n_disk <= n_auto.max(surface.defects.components));
    }
}

#[test]
fn a_book_is_bound_in_pairs() {
    for pages in [3, 5, 200] {
        let surface = surface(&zoo::book(pages));
        let n_disk = checked(&surface, Cut::Disk).len();
        assert_eq!(n_disk, pages.div_ceil(2) as usize);
    }
}

#[test]
fn charts_of_a_closed_surface_are_nearly_flat() {
    for mesh in [
        zoo::sphere(48, 31),
        zoo::torus(60, 30),
        zoo::slab(3),
        zoo::sphere(48, 31).with(&zoo::sphere(48, 31).reversed()),
    ] {
        let surface = surface(&mesh);
        for chart in checked(&surface, Cut::Fast) {
            let normals: Vec<[f64; 3]> = chart
                .disk
                .triangles
                .iter()
                .map(|t| {
                    let [a, b, c] = t.map(|v| chart.positions[v as usize]);
                    area_vector(a, b, c)
                })
                .collect();
            let sum = normals
                .iter()
                .fold([0.0; 3], |s, n| [s[0] + n[0], s[1] + n[1], s[2] + n[2]]);
            for normal in &normals {
                assert!(dot(*normal, sum) > 0.0, "a triangle faces backwards");
            }
        }
    }
}

#[test]
fn a_cube_is_few_charts_and_a_sphere_some() {
    let cube = checked(&surface(&zoo::voxels(&[[0, 0, 0]])), Cut::Fast);
    assert!((2..=6).contains(&cube.len()), "{}", cube.len());
    let sphere = checked(&surface(&zoo::sphere(48, 31)), Cut::Fast);
    assert!((2..=10).contains(&sphere.len()), "{}", sphere.len());
    assert_eq!(checked(&surface(&zoo::grid(20, 20)), Cut::Fast).len(), 1);
}

#[test]
fn charts_are_the_same_every_time() {
    let surface = surface(&zoo::torus(60, 30).with(&zoo::slab(3)));
    for cut in [Cut::Fast, Cut::Disk] {
        let one = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .expect("a thread");
        assert_eq!(one.install(|| charts(&surface, cut)), charts(&surface, cut));
    }
}

#[test]
fn charts_do_not_depend_on_the_unit_of_length() {
    let mesh = zoo::torus(40, 20).with(&zoo::slab(3).moved([9.0, 0.0, 0.0]));
    for factor in [2f32.powi(-30), 2f32.powi(30)] {
        let mut scaled = mesh.clone();
        for p in &mut scaled.positions {
            *p = p.map(|x| x * factor);
        }
        for cut in [Cut::Fast, Cut::Disk] {
            let corners = |mesh: &Mesh| -> Vec<_> {
                charts(&surface(mesh), cut)
                    .into_iter()
                    .map(|chart| chart.corners)
                    .collect()
            };
            assert_eq!(corners(&mesh), corners(&scaled));
        }
    }
}

#[test]
fn shuffled_faces_make_as_many_disks() {
    for mesh in zoo::zoo() {
        let shuffled = mesh.shuffled();
        let n_disks = |mesh| checked(&surface(mesh), Cut::Disk).len();
        assert_eq!(n_disks(&mesh), n_disks(&shuffled), "{}", mesh.name);
        checked(&surface(&shuffled), Cut::Fast);
    }
}

#[test]
fn files_are_one_disk_per_component() {
    for name in ["cat_head.obj", "moebius.obj"] {
        assert_disk_per_component(&places::asset(name));
    }
}

fn assert_disk_per_component(path: &Path) {
    let mesh = zoo::read_mesh(path).expect("a readable mesh");
    let surface = surface(&mesh);
    let disks = checked(&surface, Cut::Disk);
    println!("{}: {} disks", mesh.name, disks.len());
    assert!(disks.len() <= surface.defects.components, "{}", mesh.name);
    checked(&surface, Cut::Fast);
}

proptest! {
    #[test]
    fn any_triangles_are_divided(mesh in few_vertices()) {
        let surface = surface(&mesh);
        checked(&surface, Cut::Disk);
        checked(&surface, Cut::Fast);
    }
}

/// A strip of squares, each two faces: face `2 i` and `2 i + 1` share the diagonal of square `i`.
fn strip(n_squares: u32) -> Vec<u32> {
    let mut twin = vec![CUT; 6 * n_squares as usize];
    let mut glue = |a: u32, b: u32| {
        twin[a as usize] = b;
        twin[b as usize] = a;
    };
    for i in 0..n_squares {
        glue(6 * i, 6 * i + 3);
        if i + 1 < n_squares {
            glue(6 * i + 4, 6 * (i + 1) + 1);
        }
    }
    twin
}

fn go_on() -> Control {
    Control::Continue
}

#[test]
fn a_minimum_cut_takes_the_cheapest_edges() {
    let twin = strip(4);
    // Every edge costs 5 but the one between the second square and the third.
    let mut capacity = vec![5_u64; twin.len()];
    for h in [10, 13] {
        capacity[h] = 2;
    }
    let side = min_cut(&twin, &capacity, &[0], &[7], &go_on);
    assert_eq!(side, [true, true, true, true, false, false, false, false]);
    // Cut off on both sides, and nearest to the source where all edges cost the same.
    let side = min_cut(&twin, &vec![3; twin.len()], &[4], &[0, 7], &go_on);
    assert_eq!(side.iter().filter(|&&inside| inside).count(), 1);
    // Nothing to cut: there is no way.
    let mut apart = strip(4);
    apart[10] = CUT;
    apart[13] = CUT;
    let side = min_cut(&apart, &capacity, &[0], &[7], &go_on);
    assert_eq!(side.iter().filter(|&&inside| inside).count(), 4);
}

#[test]
fn two_ways_are_cut_at_once() {
    // A ring of squares: two ways from the first face to the one opposite.
    let n = 6_u32;
    let mut twin = strip(n);
    let (last, first) = (6 * (n - 1) + 4, 1);
    twin[last as usize] = first;
    twin[first as usize] = last;
    let mut capacity = vec![7_u64; twin.len()];
    for h in [10, 13, 22, 25] {
        capacity[h] = 1;
    }
    let side = min_cut(&twin, &capacity, &[4], &[11], &go_on);
    let inside: Vec<usize> = (0..side.len()).filter(|&f| side[f]).collect();
    assert_eq!(inside, [4, 5, 6, 7]);
}

/// Connected sets of faces on both sides of a seam.
fn n_parts(twin: &[u32], side: &[bool]) -> usize {
    let mut seen = vec![false; side.len()];
    let mut n = 0;
    for first in 0..side.len() {
        let mut open = vec![first];
        n += usize::from(!seen[first]);
        while let Some(face) = open.pop() {
            if !std::mem::replace(&mut seen[face], true) {
                let across = (3 * face..3 * face + 3).map(|h| twin[h]);
                let beside = across.filter(|&t| t != CUT).map(|t| t as usize / 3);
                open.extend(beside.filter(|&f| side[f] == side[face]));
            }
        }
    }
    n
}

/// The edges between two sets of faces.
fn n_seams(twin: &[u32], side: &[bool]) -> usize {
    let is_seam = |(h, &t): (usize, &u32)| t != CUT && side[h / 3] && !side[t as usize / 3];
    twin.iter().enumerate().filter(|&it| is_seam(it)).count()
}

#[test]
fn a_cut_that_is_ended_early_still_parts() {
    let (n, m) = (600, 8);
    let grid = zoo::grid(n, m);
    let disk = Disk::new(grid.positions.len(), grid.triangles.clone());
    let twin = disk.expect("a disk").twins();
    let capacity = vec![1_000; twin.len()];
    let row = |y: u32| -> Vec<u32> { (2 * n * y..2 * n * (y + 1)).collect() };
    let (sources, sinks) = (row(0), row(m - 1));
    let questions = Cell::new(0);
    let end = || {
        questions.set(questions.get() + 1);
        Control::Finish
    };
    let side = min_cut(&twin, &capacity, &sources, &sinks, &end);
    assert_eq!(questions.get(), 1);
    assert!(sources.iter().all(|&f| side[f as usize]));
    assert!(sinks.iter().all(|&f| !side[f as usize]));
    let parts = n_parts(&twin, &side);
    assert_eq!(parts, 2);
    let whole = min_cut(&twin, &capacity, &sources, &sinks, &go_on);
    assert!(n_seams(&twin, &whole) <= n_seams(&twin, &side));
}

/// The faces that are inside all minimum cuts, by trying every set of faces.
fn nearest_minimum(twin: &[u32], capacity: &[u64], [source, sink]: [usize; 2]) -> Vec<bool> {
    let n = twin.len() / 3;
    let sides = (0_u32..1 << n).filter(|set| set >> source & 1 == 1 && set >> sink & 1 == 0);
    let inside = |set: u32, h: usize| set >> (h / 3) & 1 == 1;
    let cost = |set: u32| -> u64 {
        let cut = (0..twin.len()).filter(|&h| inside(set, h) && !inside(set, twin[h] as usize));
        cut.map(|h| capacity[h]).sum()
    };
    let least = sides.clone().map(cost).min().expect("a set");
    let all = sides.filter(|&set| cost(set) == least);
    let common = all.fold(u32::MAX, |common, set| common & set);
    (0..n).map(|f| common >> f & 1 == 1).collect()
}

proptest! {
    #[test]
    fn no_cut_is_cheaper_or_nearer_to_the_source(
        costs in prop::collection::vec(1_u64..6, 18),
        sink in 1_usize..12,
    ) {
        let triangles = zoo::sphere(3, 2).triangles;
        let ends = |h: usize| (triangles[h / 3][h % 3], triangles[h / 3][(h + 1) % 3]);
        let across = |h: usize| {
            let (a, b) = ends(h);
            (0..36).find(|&t| ends(t) == (b, a)).expect("a closed surface")
        };
        let twin: Vec<u32> = (0..36).map(|h| across(h) as u32).collect();
        let edges: Vec<usize> = (0..36).filter(|&h| h < across(h)).collect();
        let edge = |h: usize| edges.iter().position(|&e| e == h.min(across(h))).expect("an edge");
        let capacity: Vec<u64> = (0..36).map(|h| costs[edge(h)]).collect();
        let found = min_cut(&twin, &capacity, &[0], &[sink as u32], &go_on);
        prop_assert_eq!(found, nearest_minimum(&twin, &capacity, [0, sink]));
    }
}

/// A chart of some of the unit squares of 3 by 3, each of 8 by 8 cells, mapped as they lie, and bent by 60° along x = `fold`.
fn plate(squares: &[[u32; 2]], fold: f64) -> MappedChart {
    let mut mesh = zoo::grid(24, 24);
    for p in &mut mesh.positions {
        *p = [p[0] / 8.0, p[1] / 8.0, 0.0];
    }
    let positions = mesh.positions.clone();
    mesh.triangles.retain(|t| {
        let middle = [0, 1].map(|k| {
            let sum: f32 = t.iter().map(|&v| positions[v as usize][k]).sum();
            (sum / 3.0) as u32
        });
        squares.contains(&middle)
    });
    let mut chart = charts(&surface(&mesh), Cut::Disk).swap_remove(0);
    let uv = chart.positions.iter().map(|p| [p[0], p[1]]).collect();
    let (sin, cos) = FRAC_PI_3.sin_cos();
    for p in &mut chart.positions {
        let beyond = (p[0] - fold).max(0.0);
        *p = [p[0] - beyond * (1.0 - cos), p[1], beyond * sin];
    }
    MappedChart::given(chart, uv)
}

/// A square with a spike.
const SPIKY: [[u32; 2]; 5] = [[0, 0], [1, 0], [0, 1], [1, 1], [2, 0]];

#[test]
fn a_spiky_chart_is_cut_at_the_root_of_a_spike() {
    // The hull shrinks by a unit when the spike is cut off along its side of length 1.
    let chart = plate(&SPIKY, 2.0);
    let split = chart
        .best_split(chart.area().sqrt(), &go_on)
        .expect("two parts");
    assert!((split.length - 1.0).abs() < 1e-9, "{}", split.length);
    let parts = chart.parted(&split);
    let mut areas: Vec<f64> = parts.iter().map(MappedChart::area).collect();
    areas.sort_by(f64::total_cmp);
    assert!(
        areas.len() == 2 && (areas[0] - 1.0).abs() < 0.1,
        "{areas:?}"
    );
    let n_faces: usize = parts.iter().map(|p| p.chart.corners.len()).sum();
    assert_eq!(n_faces, chart.chart.corners.len());
    for part in &parts {
        let Chart {
            positions, disk, ..
        } = &part.chart;
        assert!(Disk::new(disk.n_vertices, disk.triangles.clone()).is_ok());
        let lies = positions.iter().zip(&part.embedding.uv);
        let unbent = |p: &[f64; 3]| p[0] + p[2] * FRAC_PI_6.tan();
        let is_there = |p: &[f64; 3], [x, y]: [f64; 2]| p[1] == y && (unbent(p) - x).abs() < 1e-9;
        assert!(lies.into_iter().all(|(p, uv)| is_there(p, *uv)));
    }
}

#[test]
fn a_plane_stays_whole_unless_the_page_is_much_too_small_for_it() {
    let chart = plate(&SPIKY, 3.0);
    let unit = chart.area().sqrt();
    assert!(chart.best_split(unit, &go_on).is_none());
    assert!(chart.best_split(unit / 3.0, &go_on).is_some());
}

#[test]
fn the_top_of_what_stands_is_up() {
    for angle in [0.4, 2.0, -1.5] {
        // Bent at its middle: the right half rises towards the viewer, all of it in y.
        let mut chart = plate(&[[0, 0]], 0.5);
        let (sin, cos) = f64::sin_cos(angle);
        for p in &mut chart.embedding.uv {
            *p = [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]];
        }
        let area = chart.area();
        chart.turn_up();
        assert!((chart.area() - area).abs() < 1e-9);
        let positions = &chart.chart.positions;
        let rise = |(p, uv): (&[f64; 3], &[f64; 2])| (p[1], uv[1]);
        let pairs: Vec<(f64, f64)> = positions
            .iter()
            .zip(&chart.embedding.uv)
            .map(rise)
            .collect();
        let slope = |(y, v): &(f64, f64)| (y - 0.5) * v;
        let upward: f64 = pairs.iter().map(slope).sum();
        let square: f64 = pairs.iter().map(|(y, _)| (y - 0.5).powi(2)).sum();
        // Nearly parallel: what lies away from the viewer counts a twentieth.
        assert!(upward / square > 0.99, "{angle}: {}", upward / square);
    }
}

/// A fan with a needle under each blade, a rounding step high in the map.
fn fan_on_needles(n_needles: u32) -> MappedChart {
    let top = 2 * n_needles + 1;
    let mut positions: Vec<[f32; 3]> = (0..top).map(|i| [i as f32, 0.0, (i % 2) as f32]).collect();
    positions.push([0.0, 9.0, 0.0]);
    let needle = |i: u32| {
        [
            [2 * i, 2 * i + 2, 2 * i + 1],
            [2 * i, 2 * i + 1, top],
            [2 * i + 1, 2 * i + 2, top],
        ]
    };
    let triangles: Vec<[u32; 3]> = (0..n_needles).flat_map(needle).collect();
    let surface = Surface::new(&positions, &triangles).expect("a usable mesh");
    let chart = charts(&surface, Cut::Disk).swap_remove(0);
    let on_line = |x: f64| [x, x / 3.0];
    let place = |p: &[f64; 3]| {
        let mut place = if p[1] > 0.0 {
            [0.0, 9.0]
        } else {
            on_line(p[0])
        };
        while p[2] > 0.0 && orient2d_sign(on_line(p[0] - 1.0), on_line(p[0] + 1.0), place) <= 0 {
            place[1] = place[1].next_up();
        }
        place
    };
    let uv = chart.positions.iter().map(place).collect();
    MappedChart::given(chart, uv)
}

#[test]
fn a_needle_is_not_flipped_by_turning_its_chart() {
    let mut chart = fan_on_needles(40);
    let is_positive =
        |c: &MappedChart| embed::is_positive(&c.chart.disk.triangles, &c.embedding.uv);
    assert!(is_positive(&chart));
    let turned = |p: &[f64; 2]| [0.6 * p[0] - 0.8 * p[1], 0.8 * p[0] + 0.6 * p[1]];
    let turned: Vec<[f64; 2]> = chart.embedding.uv.iter().map(turned).collect();
    assert!(!embed::is_positive(&chart.chart.disk.triangles, &turned));
    chart.turn_up();
    assert!(is_positive(&chart));
}

#[test]
fn a_crumb_is_not_cut_off() {
    let chart = plate(&[[0, 0]], 0.5);
    let unit = chart.area().sqrt();
    assert!(chart.best_split(unit, &go_on).is_some());
    // In an atlas two hundred times as large even a half is a crumb.
    assert!(chart.best_split(20.0 * unit, &go_on).is_none());
}

#[test]
fn seams_have_two_sides_and_the_boundary_of_a_mesh_one() {
    let length = |mesh: &Mesh| {
        let surface = surface(mesh);
        let unmapped = |chart: Chart| {
            let uv = vec![[0.0; 2]; chart.disk.n_vertices];
            MappedChart::given(chart, uv)
        };
        let charts: Vec<MappedChart> = charts(&surface, Cut::Disk)
            .into_iter()
            .map(unmapped)
            .collect();
        let around = |MappedChart { chart, .. }: &MappedChart| -> f64 {
            let edges = chart
                .disk
                .loops
                .iter()
                .flat_map(|of| of.iter().zip(of.iter().cycle().skip(1)));
            let at = |v: &u32| chart.positions[*v as usize];
            edges
                .map(|(a, b)| norm([0, 1, 2].map(|k| at(a)[k] - at(b)[k])))
                .sum()
        };
        (seam_length(&charts), charts.iter().map(around).sum::<f64>())
    };
    let (seams, around) = length(&zoo::grid(4, 3));
    assert!(seams == 0.0 && around > 14.0);
    let (seams, around) = length(&zoo::sphere(12, 9));
    assert!(seams > 0.0 && (2.0 * seams - around).abs() < 1e-9);
}

mod shared {
    use super::{assert_disk_per_component, places};

    #[test]
    #[ignore = "needs ../shared"]
    fn meshes_are_one_disk_per_component() {
        for folder in ["data/closed", "data/disk"] {
            let mut paths: Vec<_> = std::fs::read_dir(places::shared(folder))
                .expect("a folder")
                .map(|entry| entry.expect("an entry").path())
                .filter(|p| p.extension().is_some_and(|e| e == "obj" || e == "off"))
                .filter(|p| p.metadata().is_ok_and(|m| m.len() < 1_500_000))
                .collect();
            paths.sort();
            for path in paths {
                assert_disk_per_component(&path);
            }
        }
    }
}

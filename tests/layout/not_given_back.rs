//! What is not laid back on a neighbor, and how soon that is seen.

use std::sync::Mutex;
use std::time::Duration;

use crate::given_back::{balanced, flap_and_notch, mapped, options, regions, surface};
use crate::zoo::{self, Mesh};
use unwrapd_layout::charts::{Bound, MappedChart, MirrorPlane, Observer, given_back};
use unwrapd_maps::mesh::Surface;
use unwrapd_method::solver::{Control, Iterate};

/// Notes what takes time.
#[derive(Default)]
struct Noting(Mutex<Vec<usize>>);

impl Observer for Noting {
    fn iterate(&self, _: usize, _: &Iterate) -> Control {
        Control::Continue
    }
    fn worked(&self, faces: usize) {
        self.0.lock().expect("one thread").push(faces);
    }
    fn control(&self) -> Control {
        Control::Continue
    }
    fn elapsed(&self) -> Duration {
        Duration::ZERO
    }
}

/// How many charts are left, and how often a smaller one was glued to the largest as that was at first.
fn left_and_glued(surface: &Surface, maps: Vec<MappedChart>, bound: &Bound) -> (usize, usize) {
    let faces = maps.iter().map(|map| map.chart.disk.triangles.len());
    let mut faces: Vec<usize> = faces.collect();
    faces.sort_unstable();
    let glued = faces[faces.len() - 1] + faces[faces.len() - 2];
    let noting = Noting::default();
    let given = given_back(surface, maps, bound, &options(), &noting);
    let noted = noting.0.into_inner().expect("one thread");
    let glued = noted.iter().filter(|&&n| n == glued).count();
    (given.len(), glued)
}

/// A prism without its bottom over a regular polygon of eight corners.
fn prism() -> Mesh {
    let corner = |i: u32| {
        let (sin, cos) = (std::f32::consts::TAU * i as f32 / 8.0).sin_cos();
        [cos, sin]
    };
    let sides = (0..8).flat_map(|i| {
        let [a, b, c, d] = [i, (i + 1) % 8, 8 + (i + 1) % 8, 8 + i];
        [[a, b, c], [a, c, d], [d, c, 16]]
    });
    let rings = [0.0, 2.0].map(|z| (0..8).map(move |i| (corner(i), z)));
    let around = rings.into_iter().flatten();
    let all = around.chain([([0.0; 2], 2.0)]);
    Mesh {
        positions: all.map(|([x, y], z)| [x, y, z]).collect(),
        triangles: sides.collect(),
        ..Mesh::default()
    }
}

#[test]
fn where_laying_costs_far_more_than_may_be_spent_nothing_is_glued() {
    let surface = surface(&prism());
    let charts = regions(&surface, |[.., z]| usize::from(z > 1.9));
    let maps = charts.into_iter().map(mapped).collect();
    // There are fifteen places where the cap covers nothing, each for more than is left.
    let bound = Bound {
        mean: 4.000_01,
        ..balanced()
    };
    assert_eq!(left_and_glued(&surface, maps, &bound), (2, 0));
}

#[test]
fn a_place_is_tried_once_while_both_charts_are_as_they_are() {
    // The flap fills the notch but for less than is kept between two parts of a border.
    let surface = surface(&flap_and_notch(-5e-7));
    let charts = regions(&surface, |[_, _, z]| usize::from(z > 0.0));
    let flat = |p: &[f64; 3]| [p[0], p[1] + p[2]];
    let maps = charts.into_iter().map(|chart| {
        let uv = chart.positions.iter().map(flat).collect();
        MappedChart::given(chart, uv)
    });
    // Along both edges at its foot, and along each.
    assert_eq!(
        left_and_glued(&surface, maps.collect(), &balanced()),
        (2, 3)
    );
}

/// A plane with a slot of 8 by 8 cells, and on both sides of the slot a flap of 6 cells that stands there, so high.
fn slot_with_flaps(height: f32) -> Mesh {
    let mut plane = zoo::grid(16, 16);
    let middles = |t: &[u32; 3], k: usize| {
        let sum: f32 = t.iter().map(|&v| plane.positions[v as usize][k]).sum();
        sum / 3.0
    };
    let slot = |t: &[u32; 3]| (4.0..12.0).contains(&middles(t, 0)) && middles(t, 1) > 8.0;
    let kept: Vec<[u32; 3]> = plane
        .triangles
        .iter()
        .copied()
        .filter(|t| !slot(t))
        .collect();
    plane.triangles = kept;
    for p in &mut plane.positions {
        p[2] = 0.0;
    }
    let flap = |x: f32| {
        let mut flap = zoo::grid(8, 6);
        for p in &mut flap.positions {
            *p = [x, 9.0 + p[1], height * p[0] / 8.0];
        }
        flap
    };
    plane.with(&flap(4.0)).with(&flap(12.0))
}

#[test]
fn charts_and_their_mirror_images_make_room_for_each_other_or_stay() {
    let given = |height: f32| {
        let surface = surface(&slot_with_flaps(height));
        let charts = regions(&surface, |[x, _, z]| match (x, z) {
            (_, ..1e-6) => 0,
            (..8.0, _) => 1,
            _ => 2,
        });
        let maps = charts.into_iter().map(mapped).map(|mut map| {
            map.chart.mirror = Some(MirrorPlane::through([8.0, 0.0, 0.0], [1.0, 0.0, 0.0]));
            map
        });
        left_and_glued(&surface, maps.collect(), &balanced())
    };
    assert_eq!(given(3.0), (1, 1), "both fit");
    assert_eq!(given(7.0), (3, 0), "one fits");
}

#[test]
fn in_a_crowd_less_is_pushed_apart() {
    let given = |others: u32| {
        let mut mesh = flap_and_notch(0.02);
        for i in 0..others {
            let triangle = Mesh {
                positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
                triangles: vec![[0, 1, 2]],
                ..Mesh::default()
            };
            mesh = mesh.with(&triangle.moved([10.0 + 2.0 * i as f32, 0.0, 0.0]));
        }
        let surface = surface(&mesh);
        let charts = regions(&surface, |[_, _, z]| usize::from(z > 0.0));
        let maps = charts.into_iter().map(mapped).collect();
        left_and_glued(&surface, maps, &balanced()).0 - others as usize
    };
    assert_eq!(given(5), 1);
    assert_eq!(given(100), 2);
}

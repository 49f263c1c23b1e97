//! Charts whose nearly straight borders become straight.

use crate::zoo::{self, Mesh};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;
use unwrapd_layout::charts::{
    Bound, Bounded, Cut, Folds, MappedChart, Straighten, Straightened, Unobserved, charts,
    map_chart, straightened,
};
use unwrapd_maps::certificate::{Claims, certify};
use unwrapd_maps::embed::Options;
use unwrapd_maps::mesh::Surface;
use unwrapd_method::energy::SymmetricDirichlet;

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

/// The charts of a mesh that is a disk, or of one disk per component.
fn disks(mesh: &Mesh) -> (Surface, Vec<MappedChart>) {
    let surface = Surface::new(&mesh.positions, &mesh.triangles).expect("a usable mesh");
    let mapped = charts(&surface, Cut::Disk)
        .into_iter()
        .flat_map(|chart| map_chart(chart, &options(), Folds::Cut, &Unobserved))
        .collect();
    (surface, mapped)
}

fn straight_where(
    condition: Straighten,
    mesh: &Mesh,
    bound: &Bound,
) -> (Vec<MappedChart>, Straightened) {
    let (surface, before) = disks(mesh);
    let weights = vec![1.0; surface.triangles.len()];
    let after = straightened(
        before.clone(),
        &|_| condition,
        &weights,
        bound,
        &options(),
        &Unobserved,
    );
    (before, after)
}

fn straight_under(mesh: &Mesh, bound: &Bound) -> (Vec<MappedChart>, Straightened) {
    straight_where(Straighten::WhereBounded, mesh, bound)
}

/// Share of the outer border within 0.1 degrees of the axes.
fn aligned_share(map: &MappedChart) -> f64 {
    let (mut aligned, mut all) = (0.0, 0.0);
    for border in map.chart.disk.boundary_in(&map.embedding.uv) {
        for (i, p) in border.iter().enumerate() {
            let q = border[(i + 1) % border.len()];
            let [x, y] = [q[0] - p[0], q[1] - p[1]];
            let length = x.hypot(y);
            all += length;
            if x.abs().min(y.abs()) < 0.1_f64.to_radians().sin() * length {
                aligned += length;
            }
        }
    }
    aligned / all
}

/// A strip around a cone: `n` quads along an arc of this radius and angle, and two across the width, lifted out of the plane as far
/// as the steepness says.
fn belt(n: u32, radius: f32, width: f32, angle: f64, steepness: f32) -> Mesh {
    let mut mesh = zoo::grid(n, 2);
    for p in &mut mesh.positions {
        let t = f64::from(p[0]) / f64::from(n) * angle;
        let r = radius + width * (p[1] / 2.0 - 0.5);
        let (sin, cos) = t.sin_cos();
        *p = [r * cos as f32, r * sin as f32, r * steepness];
    }
    mesh
}

fn is_bijective(map: &MappedChart) -> bool {
    let uvs: Vec<[[f64; 2]; 3]> = (map.chart.disk.triangles.iter())
        .map(|t| t.map(|v| map.embedding.uv[v as usize]))
        .collect();
    certify(
        &map.chart.positions,
        &map.chart.disk.triangles,
        &uvs,
        &Claims::default(),
    )
    .is_bijective()
}

/// A belt around a cone unrolls to an arc; it becomes a rectangle that keeps the bound and has no flip.
#[test]
fn a_belt_becomes_a_rectangle() {
    let (before, after) = straight_under(&belt(40, 4.0, 0.8, FRAC_PI_2, 0.5), &BOUND);
    assert!(aligned_share(&before[0]) < 0.2);
    assert!(
        aligned_share(&after.charts[0]) > 0.999,
        "{}",
        aligned_share(&after.charts[0])
    );
    assert!(is_bijective(&after.charts[0]));
    assert_eq!(after.n_bent, 0);
    assert!((after.charts[0].area() / after.charts[0].surface_area() - 1.0).abs() < 1e-9);
}

/// A belt that is too wide for its radius stays as it is: the bound comes first.
#[test]
fn a_belt_beyond_the_bound_stays() {
    let wide = belt(40, 1.0, 1.4, FRAC_PI_2, 0.0);
    let (before, after) = straight_under(
        &wide,
        &Bound {
            mean: 4.02,
            ..BOUND
        },
    );
    assert_eq!(before[0].embedding.uv, after.charts[0].embedding.uv);
    assert_eq!(after.n_bent, 1);
}

/// A belt alone on its page would become longer, and the page with it: it stays an arc. Where other charts need as large a page, it
/// becomes a rectangle, which has no gaps.
#[test]
fn a_belt_that_would_enlarge_the_page_stays() {
    let arc = belt(40, 4.0, 0.8, FRAC_PI_2, 0.5);
    let (before, after) = straight_where(Straighten::WhereCompact, &arc, &BOUND);
    assert_eq!(before[0].embedding.uv, after.charts[0].embedding.uv);
    let many = (1..8).fold(arc.clone(), |all, k| {
        all.with(&arc.clone().moved([0.0, 0.0, 3.0 * k as f32]))
    });
    let (_, after) = straight_where(Straighten::WhereCompact, &many, &BOUND);
    assert_eq!(after.charts.len(), 8);
    for map in &after.charts {
        assert!(aligned_share(map) > 0.999, "{}", aligned_share(map));
    }
}

/// The border of a disc is nowhere straight.
#[test]
fn a_disc_stays_round() {
    let (before, after) = straight_under(&zoo::cone(64), &BOUND);
    for (before, after) in before.iter().zip(&after.charts) {
        assert_eq!(before.embedding.uv, after.embedding.uv);
    }
}

/// A right angle at the corners of a hexagon would exceed the bound: it may turn as a whole, and keeps its shape.
#[test]
fn a_hexagon_keeps_its_angles() {
    let mut mesh = zoo::cone(6);
    for p in &mut mesh.positions {
        p[2] = 0.0;
    }
    let (_, after) = straight_under(&mesh, &BOUND);
    let map = &after.charts[0];
    for triangle in &map.chart.disk.triangles {
        for (k, l) in [(0, 1), (1, 2), (2, 0)] {
            let [p, q] = [k, l].map(|corner| map.embedding.uv[triangle[corner] as usize]);
            assert!(((q[0] - p[0]).hypot(q[1] - p[1]) - 1.0).abs() < 1e-5);
        }
    }
}

/// A flat chart has no distortion to spend: a trapezoid stays a trapezoid.
#[test]
fn a_flat_chart_keeps_its_shape() {
    let mut mesh = zoo::grid(4, 4);
    for p in &mut mesh.positions {
        *p = [p[0] * (1.0 + 0.05 * p[1]), p[1], 0.0];
    }
    let (before, after) = straight_where(Straighten::WhereCompact, &mesh, &BOUND);
    assert_eq!(before[0].embedding.uv, after.charts[0].embedding.uv);
}

/// Whatever the mesh, no map flips or overlaps itself, and all charts together keep the bound if they did.
#[test]
fn the_zoo_keeps_its_promises() {
    for mesh in zoo::zoo() {
        let Ok(surface) = Surface::new(&mesh.positions, &mesh.triangles) else {
            continue;
        };
        if surface.triangles.is_empty() {
            continue;
        }
        let (before, after) = straight_under(&mesh, &BOUND);
        for (before, after) in before.iter().zip(&after.charts) {
            assert!(
                is_bijective(after) || !is_bijective(before),
                "{}",
                mesh.name
            );
        }
    }
}

/// Turning a chart does not change its straight map, up to rounding.
#[test]
fn straight_belts_do_not_depend_on_the_pose() {
    let mesh = belt(24, 4.0, 0.8, 1.2, 0.3);
    let (_, first) = straight_under(&mesh, &BOUND);
    let mut turned = mesh.clone();
    let (sin, cos) = (PI / 7.0).sin_cos();
    for p in &mut turned.positions {
        let [x, y, z] = p.map(f64::from);
        *p = [cos * x - sin * z, y, sin * x + cos * z].map(|x| x as f32);
    }
    let (_, second) = straight_under(&turned, &BOUND);
    assert!((aligned_share(&first.charts[0]) - aligned_share(&second.charts[0])).abs() < 1e-3);
}

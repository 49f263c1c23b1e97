//! Starts and optimized maps: never a flip, sizes as promised.

use proptest::prelude::*;
use std::sync::{Arc, Mutex};
use unwrapd_maps::embed::{
    Corners, InvalidStart, Options, Simplification, Star, hierarchical_start, optimize,
    parameterize, rest_shapes, start,
};
use unwrapd_maps::mesh::Disk;
use unwrapd_method::barrier::{BarrierKind, NoBarrier};
use unwrapd_method::energy::{
    Density, DensityKind, RestShape, SymmetricDirichlet, Term, Triangles,
};
use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::solver::{Control, Iterate, Settings, best_scale};

use crate::disks::{Mesh, NO_HOLE, cone, grid, tube};
use crate::taylor::assert_taylor;

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}

fn n_bad(disk: &Disk, uv: &[[f64; 2]]) -> usize {
    let bad = |t: &&[u32; 3]| {
        let [a, b, c] = t.map(|v| uv[v as usize]);
        orient2d_sign(a, b, c) <= 0
    };
    disk.triangles.iter().filter(bad).count()
}

fn area(disk: &Disk, uv: &[[f64; 2]]) -> f64 {
    let doubled = disk.triangles.iter().map(|t| {
        let [a, b, c] = t.map(|v| uv[v as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    });
    0.5 * doubled.sum::<f64>()
}

/// Maps with every energy and checks what is promised of every map.
fn check(name: &str, (disk, positions): &Mesh) {
    assert_eq!(n_bad(disk, &start(disk, positions)), 0, "{name}: start");
    let uv = hierarchical_start(disk, positions).expect("a start");
    assert_eq!(n_bad(disk, &uv), 0, "{name}: hierarchy");
    let rest = rest_shapes(positions, &disk.triangles);
    let wanted = if rest.true_area > 0.0 {
        rest.true_area
    } else {
        rest.area
    };
    for energy in [
        DensityKind::Arap,
        DensityKind::Lscm,
        DensityKind::SymmetricDirichlet,
    ] {
        let options = Options {
            density: energy.planar().expect("an energy of the plane"),
            ..Options::default()
        };
        let embedding = parameterize(disk, positions, &options, &go_on);
        assert_eq!(n_bad(disk, &embedding.uv), 0, "{name}: {energy:?}");
        let ratio = area(disk, &embedding.uv) / wanted;
        assert!(
            (ratio - 1.0).abs() < 1e-9,
            "{name}: {energy:?}: area off by {ratio}"
        );
        assert!(
            embedding.summary.energy_last.is_finite(),
            "{name}: {energy:?}"
        );
        assert!(embedding.summary.energy_last <= embedding.summary.energy_first);
    }
}

#[test]
fn nasty_disks_are_mapped_without_a_flip() {
    check("one triangle", &cone_slice());
    check("cone", &cone(12, 3.0));
    check("needle cone", &cone(40, 1e4));
    check("tube behind three vertices", &tube(3, 60));
    check("longer tube", &tube(8, 40));
    let plane = |x: usize, y: usize| [x as f64, y as f64, 0.0];
    check("plane", &grid(9, NO_HOLE, plane));
    check(
        "hundreds of holes",
        &grid(41, |x, y| x % 2 == 1 && y % 2 == 1, plane),
    );
    check(
        "all on a line",
        &grid(6, NO_HOLE, |x, y| [(7 * y + x) as f64, 0.0, 0.0]),
    );
    check(
        "1e-30 apart",
        &grid(5, NO_HOLE, |x, y| [1e-30 * x as f64, 1e-30 * y as f64, 0.0]),
    );
    check(
        "1e30 large, partly 1e-30 apart",
        &grid(5, NO_HOLE, |x, y| {
            let length = if x < 3 { 1e-30 } else { 1e30 };
            [length * x as f64, 1e30 * y as f64, 0.0]
        }),
    );
    check(
        "slivers",
        &grid(8, NO_HOLE, |x, y| [x as f64, 1e-7 * y as f64, 0.0]),
    );
    check(
        "zero-area rows",
        &grid(8, NO_HOLE, |x, y| {
            [
                x as f64 + if y == 3 { 0.5 } else { 0.0 },
                y.min(3) as f64 + y.saturating_sub(4) as f64,
                0.0,
            ]
        }),
    );
}

fn cone_slice() -> Mesh {
    let disk = Disk::new(3, vec![[0, 1, 2]]).expect("a disk");
    (disk, vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 1.0]])
}

#[test]
fn a_flat_disk_comes_back_as_it_is() {
    let (disk, positions) = grid(
        7,
        |x, y| x == 3 && y < 6 && y > 1,
        |x, y| [x as f64, 0.8 * y as f64 + 0.3 * (x as f64).sin(), 2.0],
    );
    let embedding = parameterize(&disk, &positions, &Options::default(), &go_on);
    for t in &disk.triangles {
        for k in 0..3 {
            let (a, b) = (t[k] as usize, t[(k + 1) % 3] as usize);
            let distance = |p: &[f64], q: &[f64]| {
                let squares = p.iter().zip(q).map(|(p, q)| (p - q) * (p - q));
                squares.sum::<f64>().sqrt()
            };
            let ratio = distance(&embedding.uv[a], &embedding.uv[b])
                / distance(&positions[a], &positions[b]);
            assert!((ratio - 1.0).abs() < 0.01, "{a} {b}: {ratio}");
        }
    }
}

/// A flat strip that is bent to a ring, up to a gap between its ends.
fn nearly_closed_ring(gap: f64) -> Mesh {
    let n = 12;
    let place = |x: usize, y: usize| {
        let angle = (std::f64::consts::TAU - gap) * x as f64 / n as f64;
        let radius = 1.0 + 0.1 * y as f64 / n as f64;
        [radius * angle.sin(), radius * angle.cos(), 0.0]
    };
    grid(n, |_, _| false, place)
}

#[test]
fn flat_disks_that_touch_themselves_are_opened() {
    for (gap, starts_as_it_lies) in [(1e-3, true), (1e-7, false), (0.0, false), (-0.1, false)] {
        let (disk, positions) = nearly_closed_ring(gap);
        let start = Mutex::new(None);
        let watch = |iterate: &Iterate| {
            start
                .lock()
                .expect("one thread")
                .get_or_insert(iterate.energy);
            Control::Finish
        };
        parameterize(&disk, &positions, &Options::default(), &watch);
        let energy = start.into_inner().expect("one thread").expect("the start");
        assert_eq!(energy < 1e-9, starts_as_it_lies, "{gap}: {energy}");
    }
}

#[test]
fn a_simplified_disk_keeps_its_holes_and_area() {
    let is_hole = |x, y| [20, 60].contains(&x) && (40..50).contains(&y);
    let plane = |x, y| [x as f64, y as f64, 0.0];
    let (disk, positions) = grid(80, is_hole, plane);
    let Simplification {
        disk: simple,
        vertices,
        ..
    } = Simplification::new(&disk, &positions, 200).expect("a disk");
    assert!(simple.n_vertices < 400, "{}", simple.n_vertices);
    assert_eq!(vertices.len(), simple.n_vertices);
    assert_eq!(simple.loops.len(), 3);
    let flat = |v: &u32| positions[*v as usize][..2].try_into().expect("a point");
    let kept: Vec<[f64; 2]> = vertices.iter().map(flat).collect();
    let whole: Vec<[f64; 2]> = (0..disk.n_vertices as u32).map(|v| flat(&v)).collect();
    let ratio = area(&simple, &kept) / area(&disk, &whole);
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
}

/// No other energy's map is better by an energy than the map that minimizes it.
#[test]
fn each_energy_is_lowest_for_its_own_map() {
    let (disk, positions) = grid(9, NO_HOLE, |i, j| {
        let [x, y] = [i, j].map(|k| k as f64);
        let (dx, dy) = (x - 4.0, y - 3.0);
        [x, y, 4.0 * (-(dx * dx + dy * dy) / 6.0).exp()]
    });
    let densities: Vec<Arc<dyn Density<2>>> = [
        "arap",
        "green",
        "symmetric-dirichlet",
        "mips",
        "amips",
        "st-venant-kirchhoff",
        "neo-hookean",
        "log(s1)^2 + log(s2)^2",
    ]
    .map(|name| {
        let kind: DensityKind = name.parse().expect(name);
        kind.planar().expect("an energy of the plane")
    })
    .to_vec();
    let maps: Vec<Vec<[f64; 2]>> = (densities.iter())
        .map(|density| {
            let options = Options {
                density: Arc::clone(density),
                barrier: BarrierKind::None,
                solver: Settings::exact(),
                ..Options::default()
            };
            parameterize(&disk, &positions, &options, &go_on).uv
        })
        .collect();
    let rest = rest_shapes(&positions, &disk.triangles);
    for (i, density) in densities.iter().enumerate() {
        let term = Triangles::shared(
            &disk.triangles,
            &rest.shapes,
            Arc::clone(density),
            NoBarrier,
        );
        // Maps have the surface's area; each energy has a size of its own that it likes best.
        let lowest = |map: &Vec<[f64; 2]>| {
            let x = map.as_flattened();
            let scale = best_scale(&|x| term.value(x), x);
            let scaled: Vec<f64> = x.iter().map(|x| scale * x).collect();
            term.value(&scaled)
        };
        let energies: Vec<f64> = maps.iter().map(lowest).collect();
        let others = energies.iter().enumerate().filter(|&(j, _)| j != i);
        for (j, other) in others {
            assert!(energies[i] <= other * (1.0 + 1e-4), "{i} {j}: {energies:?}");
        }
    }
}

#[test]
fn a_bad_start_is_refused_by_triangle() {
    let (disk, positions) = cone(6, 1.0);
    let mut uv = start(&disk, &positions);
    uv[0] = [10.0, 0.0];
    let outcome = optimize(&disk, &positions, &uv, &Options::default(), &go_on);
    assert!(matches!(outcome, Err(InvalidStart::NotPositive(_))));
    uv.pop();
    let outcome = optimize(&disk, &positions, &uv, &Options::default(), &go_on);
    assert_eq!(outcome.expect_err("too short"), InvalidStart::Length(6, 7));
}

#[test]
fn without_a_barrier_there_is_still_a_map() {
    let mesh = grid(9, NO_HOLE, |x, y| {
        [x as f64, y as f64, 9.0 * (x as f64 - 4.0).abs()]
    });
    let options = Options {
        barrier: BarrierKind::None,
        ..Options::default()
    };
    let embedding = parameterize(&mesh.0, &mesh.1, &options, &go_on);
    assert!(embedding.uv.as_flattened().iter().all(|x| x.is_finite()));
    assert!(embedding.summary.energy_last < embedding.summary.energy_first);
}

#[test]
fn the_watcher_may_end_it_with_a_valid_map() {
    let (disk, positions) = grid(9, NO_HOLE, |x, y| {
        [x as f64, y as f64, 3.0 * ((x * y) as f64).sin()]
    });
    let twice = |i: &Iterate| {
        if i.iteration < 2 {
            Control::Continue
        } else {
            Control::Finish
        }
    };
    let embedding = parameterize(&disk, &positions, &Options::default(), &twice);
    assert_eq!(embedding.summary.iterations, 2);
    assert_eq!(n_bad(&disk, &embedding.uv), 0);
}

/// The energy around a vertex is that of its triangles, and its derivatives belong to it.
#[test]
fn taylor_star() {
    let at = |k: u32| {
        let angle = f64::from(k) * 1.1;
        [(1.0 + 0.2 * f64::from(k)) * angle.cos(), angle.sin()]
    };
    let triangles: Vec<[u32; 3]> = (1..5).map(|k| [0, k, k + 1]).collect();
    let shapes: Vec<RestShape> = (1..5)
        .map(|k| RestShape::from_edges([1.0, 0.1 * f64::from(k)], [0.3, 0.9]))
        .collect();
    let mut star = Star::default();
    for (triangle, shape) in triangles.iter().zip(&shapes) {
        // The vertex is another corner of each.
        let corner = triangle[1] as usize % 3;
        let ends = [at(triangle[1]), at(triangle[2])];
        let [g1, g2] = shape.inverse;
        let g0 = [-g1[0] - g2[0], -g1[1] - g2[1]];
        let turned = [[g1, g2], [g0, g1], [g2, g0]][corner];
        let turned = RestShape {
            inverse: turned,
            ..*shape
        };
        star.push(&Corners::new(&turned), corner, ends);
    }
    let position = |x: &[f64]| [x[0], x[1]];
    let (x, d) = ([0.05, -0.1], [0.3, 0.2]);
    let (gradient, [xx, xy, yy]) = star.derivatives(x);
    let times = |v: &[f64]| vec![xx * v[0] + xy * v[1], xy * v[0] + yy * v[1]];
    assert_taylor(|x| star.value(position(x)), &gradient, times, &x, &d);

    let all: Vec<f64> = x.into_iter().chain((1..6).flat_map(at)).collect();
    let sum = Triangles::new(&triangles, &shapes, SymmetricDirichlet, NoBarrier).value(&all);
    assert!((star.value(x) - sum).abs() < 1e-12 * sum);
    assert_eq!(star.value([9.0, 9.0]), f64::INFINITY);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn random_surfaces_with_holes_are_never_flipped(
        n in 1_usize..12,
        holes in any::<u64>(),
        heights in prop::collection::vec(-3.0..3.0_f64, 169),
        flat in 1e-6..1.0_f64,
        unit in -9..9_i32,
    ) {
        let unit = 10_f64.powi(unit);
        let is_hole = |x: usize, y: usize| {
            // Isolated squares inside, so that what is left is a disk with holes.
            let inside = x % 2 == 1 && y % 2 == 1 && x + 1 < n && y + 1 < n;
            inside && holes >> ((x / 2 * 6 + y / 2) % 64) & 1 == 1
        };
        let mesh = grid(n, is_hole, |x, y| {
            [unit * x as f64, unit * flat * y as f64, unit * heights[y * (n + 1) + x]]
        });
        check("random", &mesh);
    }
}

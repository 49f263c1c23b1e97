//! Triangles inside polygons.

use crate::simple_polygons::{doubled_area, simple_polygon};
use unwrapd_files::polygon::{Filling, triangulate};
use unwrapd_maps::certificate::certify_planar;
use unwrapd_method::numerics::random::Random;

fn triangles_of(corners: &[[f64; 3]]) -> (Filling, Vec<[u32; 3]>) {
    let mut triangles = Vec::new();
    let filling = triangulate(corners, &mut triangles);
    (filling, triangles)
}

fn flat(corners: &[[f64; 2]]) -> Vec<[f64; 3]> {
    corners.iter().map(|&[x, y]| [x, y, 0.0]).collect()
}

/// Twice the area of all triangles, each of which has to be positive.
fn covered(plane: &[[f64; 2]], triangles: &[[u32; 3]]) -> f64 {
    let areas = triangles
        .iter()
        .map(|t| doubled_area(&t.map(|k| plane[k as usize])));
    areas.inspect(|&area| assert!(area > 0.0)).sum()
}

/// n − 2 positive triangles that do not overlap and have the polygon's area: all exactly.
fn assert_filled(plane: &[[f64; 2]], space: &[[f64; 3]], name: &str) {
    let (filling, triangles) = triangles_of(space);
    assert_eq!(filling, Filling::Inside, "{name}: {plane:?}");
    assert_eq!(triangles.len(), plane.len() - 2, "{name}");
    assert_eq!(covered(plane, &triangles), doubled_area(plane), "{name}");
}

#[test]
fn a_thousand_simple_polygons_are_covered_once() {
    let mut random = Random::new(8);
    for number in 0..1000 {
        let polygon = simple_polygon(3 + number % 198, &mut random);
        let space: Vec<_> = polygon.space.iter().map(|p| p.map(f64::from)).collect();
        let name = format!("polygon {number}");
        assert_filled(&polygon.plane, &space, &name);
        let (_, triangles) = triangles_of(&space);
        assert!(
            certify_planar(&polygon.plane, &triangles).is_bijective(),
            "{name}"
        );
        // As their mirror images seen from behind.
        let reversed: Vec<_> = space.iter().rev().copied().collect();
        let mirrored: Vec<_> = polygon.plane.iter().rev().map(|&[x, y]| [-x, y]).collect();
        assert_filled(&mirrored, &reversed, &name);
    }
}

#[test]
fn a_reflex_corner_stays_one() {
    let l = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    for first in 0..6 {
        let mut corners = l;
        corners.rotate_left(first);
        assert_filled(&corners, &flat(&corners), "L");
    }
}

#[test]
fn quads_take_the_diagonal_that_is_inside_and_folds_least() {
    let quad = |corners: [[f64; 3]; 4]| triangles_of(&corners);
    let first = (Filling::Inside, vec![[0, 1, 2], [0, 2, 3]]);
    let second = (Filling::Inside, vec![[0, 1, 3], [1, 2, 3]]);
    let square = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    assert_eq!(quad(square), first, "a flat convex quad");
    // An arrowhead: each corner may be the reflex one.
    let mut arrow = [
        [0.0, 0.0, 0.0],
        [2.0, -1.0, 0.0],
        [0.0, 3.0, 0.0],
        [-2.0, -1.0, 0.0],
    ];
    for shift in 0..4 {
        let expected = if shift % 2 == 0 { &first } else { &second };
        assert_eq!(&quad(arrow), expected, "an arrowhead turned {shift} times");
        arrow.rotate_left(1);
    }
    // A bent kite folds by 41 degrees along its short diagonal, by 53 along its long one.
    for height in [-0.5, 0.5] {
        let mut kite = [
            [0.0, 0.0, 0.0],
            [2.0, -1.0, height],
            [3.0, 0.0, 0.0],
            [2.0, 1.0, height],
        ];
        assert_eq!(quad(kite), second, "bent along the second diagonal");
        kite.rotate_left(1);
        assert_eq!(quad(kite), first, "bent along the first diagonal");
    }
    // Three corners on a line, exactly and nearly.
    for off in [0.0, 1e-9, -1e-9] {
        let corners = [
            [0.0, 0.0, 0.0],
            [1.0, off, 0.0],
            [2.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
        ];
        assert_eq!(quad(corners), second, "a corner on a side, {off}");
    }
}

#[test]
fn corners_on_straight_sides_are_corners_of_positive_triangles() {
    // A square with n corners on each side, and a triangle of which all other corners are on its sides.
    for n in [1, 2, 7, 100] {
        for cycle in [
            vec![[0, 0], [1, 0], [1, 1], [0, 1]],
            vec![[0, 0], [3, 1], [1, 2]],
        ] {
            let following = cycle.iter().cycle().skip(1);
            let corners: Vec<[f64; 2]> = cycle
                .iter()
                .zip(following)
                .flat_map(|(p, q)| {
                    (0..n).map(|k| {
                        [0, 1].map(|axis| f64::from(n * p[axis] + k * (q[axis] - p[axis])))
                    })
                })
                .collect();
            if corners.len() > 3 {
                assert_filled(&corners, &flat(&corners), "straight sides");
                // Off the axes nothing is exactly straight any more.
                let turned: Vec<_> = corners
                    .iter()
                    .map(|p| [p[0] * 0.1, p[0] * 0.7 - p[1] * 0.1, p[1] * 0.3])
                    .collect();
                assert_filled(&corners, &turned, "turned");
            }
        }
    }
}

#[test]
fn a_hole_on_a_bridge_is_left_out() {
    let outer = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let hole = [[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0]];
    let bridged = |outer: &[[f64; 2]], hole: &[[f64; 2]]| {
        let mut corners = outer.to_vec();
        corners.push(outer[0]);
        corners.extend(hole);
        corners.push(hole[0]);
        corners
    };
    let once = bridged(&outer, &hole);
    assert_filled(&once, &flat(&once), "one hole");
    let twice = bridged(
        &bridged(&outer, &hole.map(|p| p.map(|x| x * 0.5))),
        &[[3.0, 0.5], [3.0, 1.0], [3.5, 1.0]],
    );
    assert_filled(&twice, &flat(&twice), "two holes from one corner");
}

#[test]
fn repeated_corners_make_triangles_without_area() {
    let corners = [
        [0.0, 0.0],
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 2.0],
        [2.0, 2.0],
        [2.0, 2.0],
        [1.0, 1.0],
        [0.0, 2.0],
        [0.0, 0.0],
    ];
    for first in 0..corners.len() {
        let mut corners = corners;
        corners.rotate_left(first);
        let (filling, triangles) = triangles_of(&flat(&corners));
        assert_eq!(filling, Filling::Inside);
        assert_eq!(triangles.len(), 7);
        let areas: Vec<f64> = triangles
            .iter()
            .map(|t| doubled_area(&t.map(|k| corners[k as usize])))
            .collect();
        assert_eq!(
            areas.iter().filter(|&&area| area == 0.0).count(),
            4,
            "{areas:?}"
        );
        assert!(areas.iter().all(|&area| area >= 0.0), "{areas:?}");
        assert_eq!(areas.iter().sum::<f64>(), 4.0 + 2.0);
        let mut used: Vec<u32> = triangles.as_flattened().to_vec();
        used.sort_unstable();
        used.dedup();
        assert_eq!(used.len(), corners.len(), "each corner has a triangle");
    }
    let triangle = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 1.0]];
    assert_eq!(
        triangles_of(&flat(&triangle)),
        (Filling::Inside, vec![[0, 1, 2], [0, 2, 3]])
    );
}

#[test]
fn what_crosses_itself_or_has_no_area_is_a_fan() {
    let bow_tie = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    let star = [0, 2, 4, 1, 3].map(|k| {
        let angle = f64::from(k) * std::f64::consts::TAU / 5.0;
        [angle.cos(), angle.sin()]
    });
    let eight = [
        [0.0, 0.0],
        [2.0, -1.0],
        [2.0, 1.0],
        [0.0, 0.0],
        [-2.0, -1.0],
        [-2.0, 1.0],
    ];
    let spike = [
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [5.0, 5.0],
        [1.0, 1.0],
        [0.0, 1.0],
    ];
    let through_a_corner = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]];
    let twice_round = [
        [0.0, 0.0],
        [1.0, 0.0],
        [0.0, 1.0],
        [0.0, 0.0],
        [1.0, 0.0],
        [0.0, 1.0],
    ];
    let line = [[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [2.0, 0.0]];
    let point = [[1.0, 2.0]; 5];
    let cases: [&[[f64; 2]]; 8] = [
        &bow_tie,
        &star,
        &eight,
        &spike,
        &through_a_corner,
        &twice_round,
        &line,
        &point,
    ];
    for corners in cases {
        let (filling, triangles) = triangles_of(&flat(corners));
        assert_eq!(filling, Filling::Fan, "{corners:?}");
        let fan: Vec<[u32; 3]> = (2..corners.len() as u32).map(|k| [0, k - 1, k]).collect();
        assert_eq!(triangles, fan);
    }
}

#[test]
fn sizes_do_not_matter() {
    let l = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    let expected = triangles_of(&flat(&l));
    for size in [1e-300, 1e-45, 1e-9, 1e9, 1e38, 1e300] {
        let corners = l.map(|p| p.map(|x| x * size));
        assert_eq!(triangles_of(&flat(&corners)), expected, "{size}");
    }
    let beyond = [
        [-1e308, 0.0, 0.0],
        [1e308, 0.0, 0.0],
        [1e308, 1e308, 0.0],
        [0.0, 1e308, 0.0],
    ];
    assert_eq!(triangles_of(&beyond).0, Filling::Fan);
}

#[test]
fn bent_polygons_are_filled_as_seen_along_their_mean_normal() {
    let mut random = Random::new(3);
    for number in 0..200 {
        let polygon = simple_polygon(5 + number % 40, &mut random);
        // Bent so little that the normal hardly leaves the axis.
        let bend = |x: f64| 1e-3 * x * (x / 50.0).sin();
        let bent = polygon
            .plane
            .iter()
            .map(|&[x, y]| [x, y, bend(x) * bend(y)]);
        let bent: Vec<[f64; 3]> = bent.collect();
        assert_filled(&polygon.plane, &bent, "bent");
    }
}

#[test]
fn coarse_grids_never_panic() {
    let mut random = Random::new(5);
    let mut n_inside = 0;
    for _ in 0..20_000 {
        let n = 4 + random.below(12);
        let size = 2 + random.below(4);
        let corners: Vec<[f64; 3]> = (0..n)
            .map(|_| [0; 3].map(|_| random.below(size) as f64))
            .collect();
        let (filling, triangles) = triangles_of(&corners);
        assert_eq!(triangles.len(), n - 2);
        assert!(triangles.as_flattened().iter().all(|&k| (k as usize) < n));
        n_inside += usize::from(filling == Filling::Inside);
    }
    assert!(n_inside > 1000, "{n_inside}");
}

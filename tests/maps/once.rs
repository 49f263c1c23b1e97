//! Whether charts overlap, where it is seen from their boundaries.

use unwrapd_maps::certificate::{Certificate, Claims, certify};
use unwrapd_maps::mesh::CornerUvs;

/// The squares of a grid for which `is_there`, as triangles, from a corner and with a side.
fn squares(corner: [f64; 2], side: f64, is_there: impl Fn(u32, u32) -> bool) -> Vec<CornerUvs> {
    const N: u32 = 8;
    let at = |i: u32, j: u32| {
        [
            corner[0] + side * f64::from(i) / f64::from(N),
            corner[1] + side * f64::from(j) / f64::from(N),
        ]
    };
    (0..N * N)
        .map(|k| (k % N, k / N))
        .filter(|&(i, j)| is_there(i, j))
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// Charts on surfaces of their own, one above the other.
fn certificate(charts: &[Vec<CornerUvs>]) -> Certificate {
    let (mut positions, mut uvs) = (Vec::new(), Vec::new());
    for (height, chart) in charts.iter().enumerate() {
        for face in chart {
            positions.extend(face.map(|[u, v]| [u, v, height as f64]));
            uvs.push(*face);
        }
    }
    let faces = 0..uvs.len() as u32;
    let triangles: Vec<[u32; 3]> = faces.map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
    certify(&positions, &triangles, &uvs, &Claims::default())
}

fn ring(i: u32, j: u32) -> bool {
    !((2..6).contains(&i) && (2..6).contains(&j))
}

#[test]
fn a_chart_in_the_hole_of_another_is_beside_it() {
    let ring = squares([0.0, 0.0], 1.0, ring);
    let island = squares([0.3125, 0.3125], 0.375, |_, _| true);
    assert!(certificate(std::slice::from_ref(&ring)).is_bijective());
    assert!(certificate(&[ring, island]).is_bijective());
}

#[test]
fn a_chart_within_another_overlaps_it() {
    let whole = squares([0.0, 0.0], 1.0, |_, _| true);
    for (corner, side) in [([0.3125, 0.3125], 0.375), ([0.28125, 0.28125], 0.0625)] {
        let inner = squares(corner, side, |_, _| true);
        let found = certificate(&[whole.clone(), inner]);
        assert!(found.overlapping_pairs_between_charts > Some(0));
    }
}

#[test]
fn a_chart_across_another_or_twice_at_one_place_overlaps_it() {
    let whole = squares([0.0, 0.0], 1.0, |_, _| true);
    for corner in [[0.0, 0.0], [0.5, 0.5], [0.5, 0.0], [0.03125, 0.0]] {
        let other = squares(corner, 1.0, |_, _| true);
        let found = certificate(&[whole.clone(), other]);
        assert!(
            found.overlapping_pairs_between_charts > Some(0),
            "{corner:?}"
        );
    }
}

/// What fills a hole, what stands beside, and what reaches a little farther.
#[test]
fn charts_that_touch_do_not_overlap() {
    let outer = squares([0.0, 0.0], 1.0, ring);
    let inner = squares([0.25, 0.25], 0.5, |_, _| true);
    assert!(certificate(&[outer.clone(), inner]).is_bijective());
    let beside = squares([1.0, 0.0], 1.0, |_, _| true);
    assert!(certificate(&[outer.clone(), beside]).is_bijective());
    let larger = squares([0.25, 0.25], 0.53125, |_, _| true);
    assert!(!certificate(&[outer, larger]).is_bijective());
}

//! The box tree against brute force.

/// The tree is the crate's own affair and needs nothing of it.
#[path = "../../src/maps/src/certificate/box_tree.rs"]
mod source;

use source::{Bounds, BoxTree, BoxVisit, enlarged, search_budget};

/// Whether no line along an axis lies between two boxes.
fn meet<const D: usize>(a: &Bounds<D>, b: &Bounds<D>) -> bool {
    (0..D).all(|axis| a[0][axis] < b[1][axis] && b[0][axis] < a[1][axis])
}

fn scattered_boxes(n: u32) -> Vec<Bounds> {
    let part = |i: u32, factor: f64| (f64::from(i) * factor).fract();
    let of = |i: u32| {
        let (x, y) = (part(i, 0.754_877), part(i, 0.569_840));
        let (w, h) = (0.3 * part(i, 0.381).powi(4), 0.3 * part(i, 0.272).powi(4));
        [[x, y], [x + w, y + h]]
    };
    (0..n).map(of).collect()
}

/// The same boxes with a third side.
fn boxes_in_space(n: u32) -> Vec<Bounds<3>> {
    let flat = scattered_boxes(n).into_iter().zip(1..);
    flat.map(|([[x, y], [a, b]], k)| {
        let z = (f64::from(k) * 0.430_159).fract();
        [[x, y, z], [a, b, z + 0.5 * (a - x)]]
    })
    .collect()
}

#[test]
fn pairs_are_found_once_each() {
    for n in [0, 1, 4, 5, 100, 1000] {
        every_pair_is_found_once(&scattered_boxes(n));
        every_pair_is_found_once(&boxes_in_space(n));
    }
}

fn every_pair_is_found_once<const D: usize>(boxes: &[Bounds<D>]) {
    let n = boxes.len() as u32;
    let mut found = Vec::new();
    let visit = BoxTree::new(boxes).pairs(search_budget(boxes.len()), |i, j| {
        found.push([i.min(j), i.max(j)]);
    });
    found.sort_unstable();
    let meets = |&[i, j]: &[u32; 2]| meet(&boxes[i as usize], &boxes[j as usize]);
    let all = (0..n).flat_map(|i| (i + 1..n).map(move |j| [i, j]));
    assert!(found == all.filter(meets).collect::<Vec<_>>(), "{n} boxes");
    assert_eq!(visit, BoxVisit::Complete);
}

#[test]
fn boxes_that_meet_one_are_found_once_each() {
    for n in [0, 1, 4, 5, 100, 1000] {
        let boxes = scattered_boxes(n);
        let tree = BoxTree::new(&boxes);
        for one in scattered_boxes(20) {
            let mut found = Vec::new();
            tree.meeting(&one, |i| found.push(i));
            found.sort_unstable();
            let all = (0..n).filter(|&i| meet(&boxes[i as usize], &one));
            assert!(found == all.collect::<Vec<_>>(), "{n} boxes");
        }
    }
}

#[test]
fn enlarged_boxes_meet_where_they_touched() {
    let (a, b) = ([[0.0, 0.0], [1.0, 1.0]], [[1.0, 0.5], [1.0, 2.0]]);
    let touching = |boxes: &[Bounds]| {
        let mut found = 0;
        BoxTree::new(boxes).pairs(100, |_, _| found += 1);
        found
    };
    assert_eq!(touching(&[a, b]), 0);
    assert_eq!(touching(&[enlarged(a), enlarged(b)]), 1);
}

#[test]
fn the_closest_pair_is_of_two_groups() {
    let boxes = scattered_boxes(300);
    for n_groups in [1, 2, 7] {
        let groups: Vec<u32> = (0..300).map(|i| i / 10 % n_groups).collect();
        let center_distance = |i: u32, j: u32| {
            let center = |k: u32, axis: usize| {
                0.5 * (boxes[k as usize][0][axis] + boxes[k as usize][1][axis])
            };
            (center(i, 0) - center(j, 0)).hypot(center(i, 1) - center(j, 1))
        };
        let mut expected = f64::INFINITY;
        for i in 0..300 {
            for j in (0..i).filter(|&j| groups[j as usize] != groups[i as usize]) {
                expected = expected.min(center_distance(i, j));
            }
        }
        let found = BoxTree::new(&boxes).closest(&groups, 1_000_000, center_distance);
        assert_eq!(found, (expected, BoxVisit::Complete));
    }
}

#[test]
fn a_heap_of_boxes_ends_the_search() {
    let boxes = vec![[[0.0; 2], [1.0; 2]]; 1000];
    let mut found = 0;
    let visit = BoxTree::new(&boxes).pairs(10_000, |_, _| found += 1);
    assert_eq!(visit, BoxVisit::Truncated);
    assert!(found > 0 && found <= 10_000);
    let groups: Vec<u32> = (0..1000).collect();
    let (_, visit) = BoxTree::new(&boxes).closest(&groups, 100, |_, _| 1.0);
    assert_eq!(visit, BoxVisit::Truncated);
}

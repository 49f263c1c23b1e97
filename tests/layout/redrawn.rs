//! Seams of a chart that are drawn anew near where they were.

use std::collections::HashSet;

use unwrapd_layout::charts::{Chart, parted_along};
use unwrapd_maps::mesh::{CUT, Disk, next};

use crate::disks::{Mesh, NO_HOLE, grid};

const N: usize = 40;

fn chart((disk, positions): Mesh) -> Chart {
    Chart {
        corners: (0..disk.triangles.len() as u32)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect(),
        mirror: None,
        positions,
        disk,
    }
}

fn plane() -> Chart {
    chart(grid(N, NO_HOLE, |x, y| [x as f64, y as f64, 0.0]))
}

/// The halfedges of a disk at which the label of its faces changes, one for each edge.
fn between(disk: &Disk, label: &dyn Fn(u32) -> u32) -> Vec<u32> {
    let inner = (0u32..).zip(disk.twins());
    let inner = inner.filter(|&(h, t)| t != CUT && h < t);
    let apart = inner.filter(|&(h, t)| label(h / 3) != label(t / 3));
    apart.map(|(h, _)| h).collect()
}

fn vertices(disk: &Disk, h: u32) -> [u32; 2] {
    let [a, b] = [h, next(h)].map(|h| disk.triangles[h as usize / 3][h as usize % 3]);
    [a.min(b), a.max(b)]
}

/// The edges at which the label of the faces changes, by the middles of those.
fn seams(chart: &Chart, label: impl Fn([f64; 2]) -> u32) -> HashSet<[u32; 2]> {
    let middle = |face: u32| {
        let corners = chart.disk.triangles[face as usize].map(|v| chart.positions[v as usize]);
        [0, 1].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0)
    };
    let halfedges = between(&chart.disk, &|face| label(middle(face)));
    let edges = halfedges.into_iter().map(|h| vertices(&chart.disk, h));
    edges.collect()
}

/// The edges of a chart at which some parts of it meet. Each face has to be in one part.
fn seams_of(chart: &Chart, parts: &[Chart]) -> HashSet<[u32; 2]> {
    let mut part = vec![usize::MAX; chart.disk.triangles.len()];
    for (number, of) in parts.iter().enumerate() {
        for corners in &of.corners {
            let face = &mut part[corners[0] as usize / 3];
            assert_eq!(*face, usize::MAX, "a face in two parts");
            *face = number;
        }
    }
    assert!(!part.contains(&usize::MAX), "a face in no part");
    let halfedges = between(&chart.disk, &|face| part[face as usize] as u32);
    let edges = halfedges.into_iter().map(|h| vertices(&chart.disk, h));
    edges.collect()
}

fn length(chart: &Chart, edges: &HashSet<[u32; 2]>) -> f64 {
    let length = |edge: &[u32; 2]| {
        let [p, q] = edge.map(|v| chart.positions[v as usize]);
        (p[0] - q[0]).hypot(p[1] - q[1]).hypot(p[2] - q[2])
    };
    edges.iter().map(length).sum()
}

/// 0 and 1 on both sides of a line that goes up and down by two.
fn zigzag([x, y]: [f64; 2]) -> u32 {
    u32::from(y > 20.0 + 2.0 * ((x / 4.0).floor() % 2.0))
}

#[test]
fn a_seam_becomes_as_short_as_it_can_nearby() {
    let chart = plane();
    let drawn = seams(&chart, zigzag);
    let parts = parted_along(&chart, |edge| drawn.contains(&edge), 4);
    assert_eq!(parts.len(), 2);
    let redrawn = length(&chart, &seams_of(&chart, &parts));
    // Its ends stay where they are.
    assert!(length(&chart, &drawn) > 50.0);
    assert!(redrawn < N as f64 + 2.0, "{redrawn}");
}

#[test]
fn a_seam_that_may_not_move_stays() {
    let chart = plane();
    let drawn = seams(&chart, zigzag);
    let parts = parted_along(&chart, |edge| drawn.contains(&edge), 0);
    assert_eq!(seams_of(&chart, &parts), drawn);
}

#[test]
fn a_seam_runs_to_a_crease_that_is_near_enough() {
    let ridge = |x: usize, y: usize| [x as f64, y as f64, -(y.abs_diff(23) as f64)];
    let chart = chart(grid(N, NO_HOLE, ridge));
    let drawn = seams(&chart, |[_, y]| u32::from(y > 20.0));
    let on_ridge = |most_off: usize| {
        let parts = parted_along(&chart, |edge| drawn.contains(&edge), most_off);
        assert_eq!(parts.len(), 2);
        let seams = seams_of(&chart, &parts);
        let is_on = |edge: &&[u32; 2]| edge.iter().all(|v| *v as usize / (N + 1) == 23);
        seams.iter().filter(is_on).count()
    };
    assert!(on_ridge(3) > N / 2, "{}", on_ridge(3));
    assert_eq!(on_ridge(2), 0);
}

#[test]
fn seams_that_meet_part_a_chart_as_before() {
    let chart = plane();
    // Three sectors, an island, whose seam has no end, and two corners of the page cut off.
    let label = |[x, y]: [f64; 2]| {
        if (x - 30.0).hypot(y - 12.0) < 5.0 {
            return 3;
        }
        if x + y < 9.0 || x + y > 71.0 {
            return 4;
        }
        ((y - 20.0).atan2(x - 20.0) / 2.1 + 1.5).floor() as u32
    };
    let drawn = seams(&chart, label);
    for most_off in 0..6 {
        let parts = parted_along(&chart, |edge| drawn.contains(&edge), most_off);
        assert_eq!(parts.len(), 6, "{most_off}");
        let redrawn = seams_of(&chart, &parts);
        assert!(length(&chart, &redrawn) <= length(&chart, &drawn) + 1e-9);
    }
}

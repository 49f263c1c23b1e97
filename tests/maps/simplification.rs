//! Seams of simplified disks carried back to what these were made of.

use std::collections::HashSet;

use unwrapd_maps::embed::Simplification;
use unwrapd_maps::mesh::{CUT, Disk, UnionFind, next};

use crate::disks::{NO_HOLE, grid};

/// The parts of a disk that are left when some edges are cut, for each face, and how many.
fn parts(disk: &Disk, cut: impl Fn([u32; 2]) -> bool) -> (Vec<u32>, usize) {
    let mut faces = UnionFind::new(disk.triangles.len());
    for (h, t) in (0u32..).zip(disk.twins()).filter(|&(_, t)| t != CUT) {
        if !cut(edge(disk, h)) {
            faces.unite(h / 3, t / 3);
        }
    }
    faces.labels()
}

fn edge(disk: &Disk, h: u32) -> [u32; 2] {
    let [a, b] = [h, next(h)].map(|h| disk.triangles[h as usize / 3][h as usize % 3]);
    [a.min(b), a.max(b)]
}

/// The edges inside a disk between faces of different labels.
fn between(disk: &Disk, label: impl Fn(u32) -> u32) -> Vec<[u32; 2]> {
    let inner = (0u32..)
        .zip(disk.twins())
        .filter(|&(h, t)| t != CUT && h < t);
    let apart = inner.filter(|&(h, t)| label(h / 3) != label(t / 3));
    apart.map(|(h, _)| edge(disk, h)).collect()
}

/// The middle of a face of a grid.
fn middle(disk: &Disk, positions: &[[f64; 3]], face: u32) -> [f64; 2] {
    let corners = disk.triangles[face as usize].map(|v| positions[v as usize]);
    [0, 1].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0)
}

/// For each part the middles of its faces added up.
fn sums(of_face: &[u32], n: usize, middles: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; n];
    for (&part, [x, y]) in of_face.iter().zip(middles) {
        let sum = &mut sums[part as usize];
        *sum = [sum[0] + x, sum[1] + y, sum[2] + 1.0];
    }
    sums
}

#[test]
fn parts_of_a_simplified_disk_become_parts_of_the_disk() {
    let hill = |x, y| [x as f64, y as f64, 9.0 * (0.1 * x as f64).sin()];
    let (disk, positions) = grid(60, NO_HOLE, hill);
    for n_vertices in [30, 100, 400] {
        let simple = Simplification::new(&disk, &positions, n_vertices).expect("a disk");
        let at: Vec<[f64; 3]> = simple
            .vertices
            .iter()
            .map(|&v| positions[v as usize])
            .collect();
        // Three sectors that meet at one point, and an island.
        let label = |face: u32| {
            let [x, y] = middle(&simple.disk, &at, face).map(|x| x - 31.0);
            if (x - 12.0).hypot(y - 12.0) < 9.0 {
                return 3;
            }
            (y.atan2(x) / 2.1 + 1.5).floor() as u32
        };
        let seams = between(&simple.disk, label);
        let of_simple: HashSet<[u32; 2]> = seams.iter().copied().collect();
        let (part, n) = parts(&simple.disk, |edge| of_simple.contains(&edge));
        let carried = simple.carried_back(&seams);
        let (fine_part, n_fine) = parts(&disk, |edge| carried.contains(&edge));
        assert_eq!(n_fine, n, "{n_vertices}");
        assert!(n >= 4);
        // No seam ends inside a part.
        let apart = between(&disk, |face| fine_part[face as usize]);
        assert_eq!(carried, apart.into_iter().collect(), "{n_vertices}");
        let coarse = (0..part.len() as u32).map(|f| middle(&simple.disk, &at, f));
        let fine = (0..fine_part.len() as u32).map(|f| middle(&disk, &positions, f));
        let coarse = sums(&part, n, coarse);
        for sum in sums(&fine_part, n, fine)
            .into_iter()
            .filter(|sum| sum[2] > 300.0)
        {
            let near = |other: &[f64; 3]| {
                (sum[0] / sum[2] - other[0] / other[2]).hypot(sum[1] / sum[2] - other[1] / other[2])
            };
            let nearest = coarse.iter().map(near).fold(f64::INFINITY, f64::min);
            assert!(nearest < 6.0, "{n_vertices}: {nearest}");
        }
    }
}

#[test]
fn a_slit_of_a_simplified_disk_stays_one() {
    let (disk, positions) = grid(40, NO_HOLE, |x, y| [x as f64, y as f64, 0.0]);
    let simple = Simplification::new(&disk, &positions, 60).expect("a disk");
    let on_boundary: HashSet<u32> = simple.disk.loops.iter().flatten().copied().collect();
    // Every edge from the boundary inward, alone.
    let twins = simple.disk.twins();
    let slits = (0u32..).zip(&twins).filter(|&(h, &t)| t != CUT && h < t);
    let slits = slits.map(|(h, _)| edge(&simple.disk, h));
    let is_slit =
        |edge: &[u32; 2]| on_boundary.contains(&edge[0]) != on_boundary.contains(&edge[1]);
    let mut n_slits = 0;
    for slit in slits.filter(is_slit) {
        let carried = simple.carried_back(&[slit]);
        let (_, n_parts) = parts(&disk, |edge| carried.contains(&edge));
        assert_eq!(n_parts, 1);
        let ends = |v: u32| carried.iter().filter(|edge| edge.contains(&v)).count();
        let vertices: HashSet<u32> = carried.iter().flatten().copied().collect();
        let boundary: HashSet<u32> = disk.loops.iter().flatten().copied().collect();
        let inside = vertices.iter().filter(|v| !boundary.contains(v));
        let tips = inside.filter(|&&v| ends(v) == 1).count();
        assert_eq!(tips, 1, "{carried:?}");
        let roots = carried.iter().flatten().filter(|v| boundary.contains(v));
        assert_eq!(roots.count(), 1);
        n_slits += 1;
    }
    assert!(n_slits > 20, "{n_slits}");
}

//! What a disk is, and each reason for not being one.

use unwrapd_maps::mesh::{Disk, NotADisk};

/// A grid of `n` × `n` squares without those in `holes`; unused vertices removed.
fn grid(n: u32, holes: &[(u32, u32)]) -> (usize, Vec<[u32; 3]>) {
    let mut triangles = Vec::new();
    for y in 0..n {
        for x in 0..n {
            if !holes.contains(&(x, y)) {
                let a = y * (n + 1) + x;
                let d = a + n + 1;
                triangles.extend([[a, a + 1, d + 1], [a, d + 1, d]]);
            }
        }
    }
    (((n + 1) * (n + 1)) as usize, triangles)
}

fn refusal(n_vertices: usize, triangles: &[[u32; 3]]) -> NotADisk {
    Disk::new(n_vertices, triangles.to_vec()).expect_err("not a disk")
}

const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

#[test]
fn one_triangle_is_a_disk() {
    let disk = Disk::new(3, vec![[0, 1, 2]]).expect("a disk");
    assert_eq!(disk.loops, [[0, 1, 2]]);
}

#[test]
fn holes_become_loops_in_the_direction_of_their_triangles() {
    let (n, triangles) = grid(7, &[(1, 1), (4, 2), (5, 5), (4, 5)]);
    let disk = Disk::new(n, triangles).expect("a disk");
    let lengths: Vec<usize> = disk.loops.iter().map(Vec::len).collect();
    assert_eq!(lengths, [28, 6, 4, 4]);
    for boundary in &disk.loops {
        for (i, &a) in boundary.iter().enumerate() {
            let b = boundary[(i + 1) % boundary.len()];
            let owners = (disk.triangles.iter())
                .filter(|t| (0..3).any(|k| (t[k], t[(k + 1) % 3]) == (a, b)));
            assert_eq!(owners.count(), 1, "{a} {b}");
        }
    }
}

#[test]
fn every_refusal_has_its_name() {
    assert_eq!(refusal(0, &[]), NotADisk::Empty);
    assert_eq!(refusal(3, &[[0, 1, 3]]), NotADisk::OutOfRange(0));
    assert_eq!(refusal(3, &[[0, 1, 1]]), NotADisk::RepeatedVertex(0));
    assert_eq!(refusal(4, &[[0, 1, 3]]), NotADisk::UnusedVertex(2));
    assert_eq!(
        refusal(5, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]),
        NotADisk::NonManifoldEdge(0, 1)
    );
    assert_eq!(
        refusal(4, &[[0, 1, 2], [0, 1, 3]]),
        NotADisk::Inconsistent(0, 1)
    );
    assert_eq!(refusal(6, &[[0, 1, 2], [3, 4, 5]]), NotADisk::Disconnected);
    assert_eq!(refusal(4, &TETRAHEDRON), NotADisk::Closed);
}

#[test]
fn touching_holes_are_not_manifold() {
    let (n, triangles) = grid(4, &[(1, 1), (2, 2)]);
    assert_eq!(refusal(n, &triangles), NotADisk::NonManifoldVertex(12));
    assert_eq!(refusal(5, &[[0, 1, 2], [0, 3, 4]]), NotADisk::Disconnected);
}

#[test]
fn a_torus_with_a_hole_has_genus_one() {
    let n = 5;
    let mut triangles = Vec::new();
    for y in 0..n {
        for x in 0..n {
            let at = |dx: u32, dy: u32| (y + dy) % n * n + (x + dx) % n;
            triangles.extend([
                [at(0, 0), at(1, 0), at(1, 1)],
                [at(0, 0), at(1, 1), at(0, 1)],
            ]);
        }
    }
    triangles.pop();
    assert_eq!(refusal((n * n) as usize, &triangles), NotADisk::Genus(1));
}

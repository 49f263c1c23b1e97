//! Disks to be embedded: grids, cones and tubes of any size.

use unwrapd_maps::mesh::Disk;

/// A disk and the positions of its vertices.
pub type Mesh = (Disk, Vec<[f64; 3]>);

/// For a [`grid`] without holes.
pub const NO_HOLE: fn(usize, usize) -> bool = |_, _| false;

/// `n` × `n` squares, each cut by a diagonal, placed by `place(x, y)` with x, y in 0..=n; `is_hole(x, y)` takes squares
/// out.
pub fn grid(
    n: usize,
    is_hole: impl Fn(usize, usize) -> bool,
    place: impl Fn(usize, usize) -> [f64; 3],
) -> Mesh {
    let mut triangles = Vec::new();
    for y in 0..n {
        for x in 0..n {
            if !is_hole(x, y) {
                let a = (y * (n + 1) + x) as u32;
                let d = a + n as u32 + 1;
                let flip = (x + y) % 2 == 0;
                triangles.extend(if flip {
                    [[a, a + 1, d + 1], [a, d + 1, d]]
                } else {
                    [[a, a + 1, d], [a + 1, d + 1, d]]
                });
            }
        }
    }
    let positions: Vec<[f64; 3]> = (0..(n + 1) * (n + 1))
        .map(|v| place(v % (n + 1), v / (n + 1)))
        .collect();
    let disk = Disk::new(positions.len(), triangles).expect("a disk");
    (disk, positions)
}

/// A cone of `n` triangles.
pub fn cone(n: u32, height: f64) -> Mesh {
    let mut positions = vec![[0.0, 0.0, height]];
    positions.extend((0..n).map(|i| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        [angle.cos(), angle.sin(), 0.0]
    }));
    let triangles = (0..n).map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect();
    (
        Disk::new(positions.len(), triangles).expect("a disk"),
        positions,
    )
}

/// A tube of `length` rings of `around` vertices, closed at one end; its only boundary is the first ring.
pub fn tube(around: u32, length: u32) -> Mesh {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for ring in 0..length {
        for i in 0..around {
            let turn = (f64::from(i) + 0.5 * f64::from(ring % 2)) / f64::from(around);
            let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
            positions.push([cos, sin, -f64::from(ring)]);
            let (a, b) = (ring * around + i, ring * around + (i + 1) % around);
            let (c, d) = (a + around, b + around);
            if ring + 1 == length {
                triangles.push([a, length * around, b]);
            } else if ring % 2 == 0 {
                triangles.extend([[a, c, b], [b, c, d]]);
            } else {
                triangles.extend([[a, d, b], [a, c, d]]);
            }
        }
    }
    positions.push([0.0, 0.0, -f64::from(length)]);
    (
        Disk::new(positions.len(), triangles).expect("a disk"),
        positions,
    )
}

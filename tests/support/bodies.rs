//! Regular bodies of the plane and of space.

use unwrapd_maps::mesh::{PlanarMesh, TetMesh};

/// A sheet of `n` × `n` unit squares, two triangles each.
pub fn sheet(n: u32) -> PlanarMesh {
    let row = n + 1;
    let vertices = (0..row * row).map(|v| [f64::from(v % row), f64::from(v / row)]);
    let squares = (0..n * n).map(|s| s / n * row + s % n);
    let triangles = squares.flat_map(|a| [[a, a + 1, a + row + 1], [a, a + row + 1, a + row]]);
    PlanarMesh::new(vertices.collect(), triangles.collect()).expect("a sheet")
}

/// A block of `n` × `n` × `n` unit cubes, six tetrahedra each.
pub fn block(n: u32) -> TetMesh {
    let row = n + 1;
    let id = |[x, y, z]: [u32; 3]| x + row * (y + row * z);
    let vertices = (0..row * row * row).map(|v| [v % row, v / row % row, v / (row * row)]);
    let axes = [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ];
    let tets = (0..n * n * n).flat_map(|c| {
        axes.map(|order| {
            let mut corner = [c % n, c / n % n, c / (n * n)];
            let mut tet = [id(corner); 4];
            for (place, axis) in tet[1..].iter_mut().zip(order) {
                corner[axis] += 1;
                *place = id(corner);
            }
            tet
        })
    });
    let vertices = vertices.map(|p| p.map(f64::from)).collect();
    TetMesh::new(vertices, tets.collect()).expect("a block")
}

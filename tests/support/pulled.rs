//! Bodies with handles that bend and twist them.

use unwrapd_deform::{Body, Problem, SoftPull, Units};
use unwrapd_maps::mesh::{PlanarMesh, TetMesh};
use unwrapd_method::barrier::{Barrier, BarrierKind};
use unwrapd_method::energy::EnergyKind;
use unwrapd_method::solver::{Handles, LevenbergSettings};

/// A strip of `length` × 2 squares of the given edge, two triangles each.
pub fn strip(length: u32, edge: f64) -> PlanarMesh {
    let vertices = (0..3 * (length + 1)).map(|v| [f64::from(v / 3), f64::from(v % 3)]);
    let triangles = (0..2 * length).flat_map(|cell| {
        let a = cell / 2 * 3 + cell % 2;
        [[a, a + 3, a + 4], [a, a + 4, a + 1]]
    });
    let vertices = vertices.map(|p| p.map(|x| edge * x)).collect();
    PlanarMesh::new(vertices, triangles.collect()).expect("a valid strip")
}

/// A bar of `length` unit cubes, six tetrahedra each.
pub fn bar(length: u32) -> TetMesh {
    let id = |x: u32, y: u32, z: u32| 4 * x + 2 * y + z;
    let vertices = (0..4 * (length + 1)).map(|v| [v / 4, v / 2 % 2, v % 2].map(f64::from));
    let mut tets = Vec::new();
    for x in 0..length {
        for [a, b, c] in [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ] {
            let mut corner = [x, 0, 0];
            let mut tet = [id(corner[0], corner[1], corner[2]); 4];
            for (step, axis) in [a, b, c].into_iter().enumerate() {
                corner[axis] += 1;
                tet[step + 1] = id(corner[0], corner[1], corner[2]);
            }
            tets.push(tet);
        }
    }
    TetMesh::new(vertices.collect(), tets).expect("a valid bar")
}

pub fn problem(
    body: Body,
    energy: EnergyKind,
    kind: BarrierKind,
    vertices: &[u32],
    targets: Vec<f64>,
) -> Problem {
    let smallest = body
        .determinants()
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    let groups = body.groups(vertices);
    Problem {
        untangled: 0,
        start: body.rest.clone(),
        barrier: Barrier {
            kind,
            beta: energy.default_beta(),
            s: 1.0,
            epsilon: 1e-4 * smallest,
        },
        energy,
        bound: None,
        boundary_barrier: None,
        stations: vec![Handles {
            vertices: vertices.to_vec(),
            targets,
            groups,
            ..Handles::default()
        }],
        turned: Vec::new(),
        aims: Vec::new(),
        soft: SoftPull::default(),
        search: false,
        levenberg: LevenbergSettings::default(),
        units: Units::Given,
        body,
    }
}

/// The strip's left end held, its right end turned by a right angle and brought near.
pub fn bent_strip(edge: f64, energy: impl Into<EnergyKind>, kind: BarrierKind) -> Problem {
    let length = 8;
    let vertices = [0, 1, 2, 24, 25, 26];
    let targets = [
        [0.0, 0.0],
        [0.0, 1.0],
        [0.0, 2.0],
        [4.0, 4.0],
        [3.0, 4.0],
        [2.0, 4.0],
    ];
    let targets = targets.into_iter().flatten().map(|x| edge * x).collect();
    problem(
        Body::from(&strip(length, edge)),
        energy.into(),
        kind,
        &vertices,
        targets,
    )
}

pub fn twisted_bar(energy: impl Into<EnergyKind>) -> Problem {
    let length = 6;
    let held: Vec<u32> = (0..4).chain(4 * length..4 * length + 4).collect();
    let l = f64::from(length);
    let (a, b) = (
        [
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 1.0, 0.0],
            [0.0, 1.0, 1.0],
        ],
        [[l, 1.0, 1.0], [l, 1.0, 0.0], [l, 0.0, 1.0], [l, 0.0, 0.0]],
    );
    let targets = a.into_iter().chain(b).flatten().collect();
    problem(
        Body::from(&bar(length)),
        energy.into(),
        BarrierKind::InverseSpline,
        &held,
        targets,
    )
}

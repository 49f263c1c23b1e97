//! Thin bodies: as many iterations as others, since nothing but rounding regularizes what the handles hold.

use unwrapd_deform::{Body, Handle, Model, Problem, Solution};
use unwrapd_maps::mesh::PlanarMesh;
use unwrapd_method::energy::DensityKind;
use unwrapd_method::solver::{Control, Iterate, Settings, Status};

use crate::bodies::sheet;

const SIDE: u32 = 30;

/// A square sheet of length 1 flattened to a height.
fn flattened(height: f64) -> Body {
    let square = sheet(SIDE);
    let scale = 1.0 / f64::from(SIDE);
    let vertices = square.vertices().iter();
    let vertices = vertices.map(|[x, y]| [scale * x, height * scale * y]);
    let triangles = square.triangles().to_vec();
    Body::from(&PlanarMesh::new(vertices.collect(), triangles).expect("a sheet"))
}

/// Holds vertices of the sheet at places.
fn solved(body: Body, held: [(u32, [f64; 2]); 2], energy: DensityKind) -> Solution {
    let model = Model {
        energy: energy.into(),
        ..Model::default()
    };
    let handles = held.map(|(vertex, to)| Handle::Vertex {
        vertex,
        to: to.to_vec(),
        weight: None,
    });
    let problem = Problem::new(body, &handles, &model).expect("a problem");
    let go_on = |_: &Iterate| Control::Continue;
    problem.solve(&Settings::follow(), &go_on).expect("a map")
}

#[test]
fn a_thin_sheet_is_stretched_in_as_few_iterations_as_a_square_one() {
    for energy in [DensityKind::Arap, DensityKind::SymmetricDirichlet] {
        let mut energies = Vec::new();
        for height in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            let far = (SIDE + 1) * (SIDE + 1) - 1;
            let held = [(0, [0.0, 0.0]), (far, [1.2, height])];
            let solution = solved(flattened(height), held, energy.clone());
            assert_eq!(solution.summary.status, Status::Converged, "{height}");
            assert!(
                solution.summary.iterations <= 60,
                "{height}: {:?}",
                solution.summary
            );
            energies.push(solution.quality.energy);
        }
        // Stretched evenly, whatever the height.
        let last = energies[energies.len() - 1];
        for energy in &energies[1..] {
            assert!((energy / last - 1.0).abs() < 0.01, "{energies:?}");
        }
    }
}

#[test]
fn a_thin_sheet_is_bent_in_few_iterations() {
    for height in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let middle = SIDE / 2 * (SIDE + 1);
        let y = 0.5 * height;
        let held = [(middle, [0.0, y]), (middle + SIDE, [0.6, y + 0.2])];
        let solution = solved(flattened(height), held, DensityKind::Arap);
        assert_eq!(solution.summary.status, Status::Converged, "{height}");
        assert!(
            solution.summary.iterations <= 60,
            "{height}: {:?}",
            solution.summary
        );
        assert_eq!(solution.quality.inverted, 0);
    }
}

#[test]
fn a_part_on_a_hinge_keeps_its_place() {
    // Two triangles that share a vertex, the first held: nothing holds the other against turning.
    let vertices = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    let mesh = PlanarMesh::new(vertices, vec![[0, 1, 2], [0, 3, 4]]).expect("a mesh");
    let held = [(1, [1.0, 0.0]), (2, [0.0, 1.2])];
    let solution = solved(Body::from(&mesh), held, DensityKind::Arap);
    assert_eq!(solution.summary.status, Status::Converged);
    let [a, b, c] = [0, 3, 4].map(|v: usize| [solution.x[2 * v], solution.x[2 * v + 1]]);
    let moved = [
        b[0] - a[0] + 1.0,
        b[1] - a[1],
        c[0] - a[0],
        c[1] - a[1] + 1.0,
    ];
    assert!(moved.iter().all(|x| x.abs() < 0.3), "{moved:?}");
}

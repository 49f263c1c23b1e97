//! What a map does to each element.

use unwrapd_deform::{Body, BodyElements, Handle, Model, Problem, Units};

use crate::bodies::{block, sheet};
use unwrapd_method::energy::{DensityKind, DisplacementKind, EnergyKind};

/// A body with an energy that is measured in its own unit; what pulls it does not matter here.
fn problem(body: Body, energy: EnergyKind) -> Problem {
    let model = Model {
        energy,
        ..Model::default()
    };
    let to = body.rest[..body.dim()].to_vec();
    let problem = Problem::new(
        body,
        &[Handle::Vertex {
            vertex: 0,
            to,
            weight: None,
        }],
        &model,
    );
    Problem {
        units: Units::Given,
        ..problem.expect("a handle of the body")
    }
}

/// Coordinates stretched along the axes, then turned in the plane of the first two.
fn moved(problem: &Problem, stretch: &[f64]) -> Vec<f64> {
    let (sin, cos) = 0.7_f64.sin_cos();
    let places = problem.body.rest.chunks(stretch.len());
    let moved = places.flat_map(|p| {
        let mut q: Vec<f64> = p.iter().zip(stretch).map(|(x, s)| x * s).collect();
        (q[0], q[1]) = (cos * q[0] - sin * q[1], sin * q[0] + cos * q[1]);
        q
    });
    moved.collect()
}

fn weights(problem: &Problem) -> Vec<f64> {
    match &problem.body.elements {
        BodyElements::Triangles { rest, .. } => rest.iter().map(|r| r.weight).collect(),
        BodyElements::Tetrahedra { rest, .. } => rest.iter().map(|r| r.weight).collect(),
    }
}

#[test]
fn elements_tell_how_they_are_stretched_and_their_energies_add_up() {
    use DensityKind::{Lscm, SymmetricDirichlet};
    let flat = || (Body::from(&sheet(3)), &[0.5, 3.0][..]);
    let solid = (Body::from(&block(2)), &[0.5, 3.0, 1.5][..]);
    for ((body, stretch), energy) in [
        (flat(), SymmetricDirichlet),
        (flat(), Lscm),
        (solid, SymmetricDirichlet),
    ] {
        let problem = problem(body, energy.into());
        let x = moved(&problem, stretch);
        let cells = problem.cells(&x);
        let names: Vec<_> = cells.iter().map(|of| of.name).collect();
        assert_eq!(
            names,
            ["singular_values", "relative_size", "energy_density"]
        );
        let mut sorted = stretch.to_vec();
        sorted.sort_by(|a, b| b.total_cmp(a));
        let expected = [sorted, vec![stretch.iter().product()]];
        for (of, expected) in cells.iter().zip(&expected) {
            assert_eq!(of.components, expected.len());
            for values in of.values.chunks(of.components) {
                let near = |(x, y): (&f64, &f64)| (x - y).abs() < 1e-12;
                assert!(values.iter().zip(expected).all(near), "{values:?}");
            }
        }
        let densities = cells[2].values.iter();
        let sum: f64 = densities.zip(weights(&problem)).map(|(e, w)| e * w).sum();
        let energy = problem.quality(&x).energy;
        assert!((sum - energy).abs() < 1e-10 * energy, "{sum} {energy}");
    }
}

#[test]
fn a_quadratic_form_has_no_energy_of_elements() {
    let problem = problem(Body::from(&sheet(2)), DisplacementKind::Laplacian.into());
    let cells = problem.cells(&problem.start);
    assert_eq!(cells.len(), 2);
}

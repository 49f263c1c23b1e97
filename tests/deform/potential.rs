//! Energies of problems as functions: derivatives, units, domain.

use unwrapd_deform::{Body, Model, Problem, ProblemError, Units};
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::numerics::csr::Csr;

use crate::pulled::{bar, strip};
use crate::random::Random;
use crate::taylor::assert_taylor;
use unwrapd_method::energy::DensityKind;

fn product(matrix: &Csr, vector: &[f64]) -> Vec<f64> {
    let rows = matrix.indptr.windows(2);
    rows.map(|row| {
        let stored = row[0]..row[1];
        stored
            .map(|k| matrix.data[k] * vector[matrix.indices[k]])
            .sum()
    })
    .collect()
}

fn problems() -> Vec<Problem> {
    let model = |energy: &str, bijective| Model {
        energy: energy.parse().expect(energy),
        bijective,
        ..Model::default()
    };
    let (plane, space) = (Body::from(&strip(3, 2.5)), Body::from(&bar(2)));
    vec![
        Problem::at_rest(plane.clone(), &model("log(s1)^2 + log(s2)^2", true)).expect("a problem"),
        Problem::at_rest(plane, &model("green", false)).expect("a problem"),
        Problem::at_rest(space, &model("neo-hookean", false)).expect("a problem"),
    ]
}

fn near(x: &[f64], size: f64) -> Vec<f64> {
    let mut random = Random::new(7);
    x.iter()
        .map(|x| x + size * (2.0 * random.next() - 1.0))
        .collect()
}

#[test]
fn taylor_potentials() {
    for mut problem in problems() {
        for units in [Units::Given, Units::Normalized] {
            problem.units = units;
            let x = near(&problem.start, 0.05);
            let direction = near(&vec![0.0; x.len()], 0.1);
            let mut potential = problem.potential().expect("an energy");
            let gradient = potential.gradient(&x).expect("a gradient");
            let hessian = potential.hessian(&x).expect("a Hessian");
            let value = |x: &[f64]| potential.value(x).expect("a value");
            assert_taylor(value, &gradient, |v| product(&hessian, v), &x, &direction);
        }
    }
}

#[test]
fn hessians_are_whole_and_not_shifted() {
    for mut problem in problems() {
        problem.units = Units::Given;
        let x = near(&problem.start, 0.05);
        let hessian = problem
            .potential()
            .and_then(|mut p| p.hessian(&x))
            .expect("a Hessian");
        let n = x.len();
        let unit = |i: usize| -> Vec<f64> { (0..n).map(|k| f64::from(u8::from(k == i))).collect() };
        let columns: Vec<Vec<f64>> = (0..n).map(|i| product(&hessian, &unit(i))).collect();
        for (i, column) in columns.iter().enumerate() {
            for (k, entry) in column.iter().enumerate() {
                assert_eq!(*entry, columns[k][i]);
            }
        }
        // An energy that does not notice shifts has no curvature along them.
        let dim = problem.body.dim();
        let shift: Vec<f64> = (0..n).map(|k| f64::from(u8::from(k % dim == 0))).collect();
        let most = hessian
            .data
            .iter()
            .fold(0.0_f64, |most, x| most.max(x.abs()));
        for entry in product(&hessian, &shift) {
            assert!(entry.abs() <= 1e-13 * most, "{entry} of {most}");
        }
        let ascending = |row: &[usize]| row.is_sorted_by(|a, b| a < b);
        assert!(
            hessian
                .indptr
                .windows(2)
                .all(|r| ascending(&hessian.indices[r[0]..r[1]]))
        );
    }
}

#[test]
fn outside_the_domain_there_are_no_derivatives() {
    let problem = Problem::at_rest(
        Body::from(&strip(2, 1.0)),
        &Model {
            energy: DensityKind::SymmetricDirichlet.into(),
            barrier: BarrierKind::None,
            ..Model::default()
        },
    );
    let problem = problem.expect("a problem");
    let mut potential = problem.potential().expect("an energy");
    let flat = vec![0.0; problem.start.len()];
    assert_eq!(potential.value(&flat), Ok(f64::INFINITY));
    assert_eq!(potential.gradient(&flat), Err(ProblemError::OutsideDomain));
    assert_eq!(potential.hessian(&flat), Err(ProblemError::OutsideDomain));
    assert!(matches!(
        potential.value(&flat[1..]),
        Err(ProblemError::WrongStart { .. })
    ));
}

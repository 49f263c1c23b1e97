//! Energies by formula and by closure.

use unwrapd_method::barrier::{Barrier, BarrierKind};
use unwrapd_method::energy::{
    Arap, Batched, Density, DensityBatch, Formula, FormulaError, Jet, Mips, Modes,
    SymmetricDirichlet, Term, Triangles,
};

use unwrapd_method::numerics::square::Matrix;

use crate::terms::{
    PLANE, TRIANGLES, assert_plane_taylor, assert_space_taylor, derivatives, plane_rest,
};

const ARAP: [&str; 2] = [
    "((s1 - 1)^2 + (s2 - 1)^2)/2",
    "((s1 - 1)^2 + (s2 - 1)^2 + (s3 - 1)**2)/2",
];
const SYMMETRIC_DIRICHLET: [&str; 2] = [
    "s1^2 + s2^2 + s1^-2 + s2^-2",
    "s1^2 + s2^2 + s3^2 + 1/s1^2 + 1/s2^2 + 1/s3^2",
];
const HENCKY: [&str; 2] = ["log(s1)^2 + log(s2)^2", "log(s1)^2 + log(s2)^2 + log(s3)^2"];
const MIPS: [&str; 2] = [
    "(s1/s2 + s2/s1)/2",
    "(s1^2 + s2^2 + s3^2)/(3*(s1*s2*s3)^(2/3))",
];

/// ψ = Σᵢ ln²σᵢ, derived by hand.
struct Hencky;

impl<const D: usize> Density<D> for Hencky {
    fn floor(&self) -> f64 {
        0.0
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        sigma.iter().map(|s| s.ln() * s.ln()).sum()
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        sigma.map(|s| 2.0 * s.ln() / s)
    }

    fn hessian(&self, sigma: &[f64; D]) -> [[f64; D]; D] {
        let mut hessian = [[0.0; D]; D];
        for (i, s) in sigma.iter().enumerate() {
            hessian[i][i] = 2.0 * (1.0 - s.ln()) / (s * s);
        }
        hessian
    }
}

fn formula<const D: usize>(texts: [&str; 2]) -> Formula<D> {
    Formula::parse(texts[D - 2]).unwrap()
}

/// Value, slopes, scalings, twists and flips of both at equal, nearly equal and unequal singular values.
fn assert_same<const D: usize>(texts: [&str; 2], density: &dyn Density<D>) {
    let formula = formula::<D>(texts);
    assert_eq!(formula.floor(), density.floor());
    for sigma in [
        [1.0, 1.0, 1.0],
        [1.3, 1.3, 1.3],
        [1.3, 1.3 - 1e-9, 0.4],
        [2.5, 1.1, 0.3],
    ] {
        let sigma: [f64; D] = std::array::from_fn(|i| sigma[i]);
        let (a, b) = (
            Modes::new(&formula, &sigma, 0.7),
            Modes::new(density, &sigma, 0.7),
        );
        let numbers = |modes: &Modes<D>, value: f64| -> Vec<f64> {
            let matrices = [modes.scaling, modes.twist, modes.flip];
            let entries = matrices.iter().flat_map(|m| m.as_flattened()).copied();
            entries.chain(modes.slope).chain([value]).collect()
        };
        let (a, b) = (
            numbers(&a, formula.value(&sigma)),
            numbers(&b, density.value(&sigma)),
        );
        for (a, b) in a.iter().zip(&b) {
            assert!(
                (a - b).abs() <= 1e-10 * b.abs().max(1.0),
                "{a} {b} at {sigma:?}"
            );
        }
    }
}

#[test]
fn formulas_are_the_energies_that_they_say() {
    assert_same::<2>(ARAP, &Arap);
    assert_same::<3>(ARAP, &Arap);
    assert_same::<2>(SYMMETRIC_DIRICHLET, &SymmetricDirichlet);
    assert_same::<3>(SYMMETRIC_DIRICHLET, &SymmetricDirichlet);
    assert_same::<2>(HENCKY, &Hencky);
    assert_same::<3>(HENCKY, &Hencky);
    assert_same::<2>(MIPS, &Mips);
    assert_same::<3>(MIPS, &Mips);
}

#[test]
fn taylor_formulas() {
    let others = [
        "exp(s1/s2 + s2/s1 + s1*s2 + 1/(s1*s2)) + cosh(s1 - 1)*cosh(s2 - 1)",
        "sqrt(1 + (s1 - 1)^2 + (s2 - 1)^2 + (s3 - 1)^2) + (s1*s2*s3)^(s1*s2*s3) - s1*s2*s3",
    ];
    for texts in [ARAP, SYMMETRIC_DIRICHLET, HENCKY, MIPS, others] {
        assert_plane_taylor(formula::<2>(texts), Barrier::NONE);
        assert_space_taylor(formula::<3>(texts), Barrier::NONE);
    }
}

#[test]
fn the_deepest_tree_is_walked() {
    let long = format!("{}{}", "0+".repeat(480), ARAP[0]);
    let long = Formula::<2>::parse(&long).unwrap();
    assert_eq!(long.value(&[2.0, 1.0]), 0.5);
}

#[test]
fn closures_are_densities() {
    let closure = Formula::new(|&[a, b]: &[Jet<2>; 2]| a.ln() * a.ln() + b.ln() * b.ln()).unwrap();
    let sigma = [1.4, 0.6];
    assert_eq!(
        closure.derivatives(&sigma),
        formula::<2>(HENCKY).derivatives(&sigma)
    );
}

/// Calls of a density for many elements, as an interpreter makes them.
struct Mapped<T>(T);

impl<const D: usize, T: Density<D>> DensityBatch<D> for Mapped<T> {
    fn values(&self, sigmas: &[[f64; D]]) -> Vec<f64> {
        sigmas.iter().map(|sigma| self.0.value(sigma)).collect()
    }

    fn gradients(&self, sigmas: &[[f64; D]]) -> Vec<[f64; D]> {
        sigmas.iter().map(|sigma| self.0.gradient(sigma)).collect()
    }

    fn hessians(&self, sigmas: &[[f64; D]]) -> Vec<Matrix<D>> {
        sigmas.iter().map(|sigma| self.0.hessian(sigma)).collect()
    }
}

#[test]
fn a_batch_is_the_density_that_it_computes() {
    fn batch<const D: usize>(density: impl Density<D> + 'static) -> Batched<D> {
        Batched::new(Mapped(density)).expect("an energy")
    }
    assert_same::<2>(HENCKY, &batch(Hencky));
    assert_same::<3>(MIPS, &batch(Mips));
    assert_plane_taylor(batch(SymmetricDirichlet), Barrier::NONE);
    assert_space_taylor(batch(Arap), Barrier::NONE);

    // The domain is found, and elements outside hide no others.
    let (inside, inverted) = ([1.0, 0.5], [1.0, -0.5]);
    let dirichlet = batch(SymmetricDirichlet);
    assert_eq!(dirichlet.values(&[inverted, inside]), [f64::INFINITY, 6.25]);
    assert_eq!(
        [Density::<2>::floor(&batch(Arap)), dirichlet.floor()],
        [f64::NEG_INFINITY, 0.0]
    );

    // The sum over a mesh is that of the density itself.
    let guard = Barrier {
        kind: BarrierKind::InverseSpline,
        beta: 0.1,
        ..Barrier::NONE
    };
    let one = Triangles::new(&TRIANGLES, &plane_rest(), Hencky, guard);
    let many = Triangles::new(&TRIANGLES, &plane_rest(), batch(Hencky), guard);
    assert!((one.value(&PLANE) - many.value(&PLANE)).abs() < 1e-14);
    assert_eq!(
        derivatives(&one, &PLANE, 0.0),
        derivatives(&many, &PLANE, 0.0)
    );
}

#[test]
fn a_batch_that_is_no_energy_is_named() {
    struct Uneven;
    impl DensityBatch<2> for Uneven {
        fn values(&self, sigmas: &[[f64; 2]]) -> Vec<f64> {
            sigmas
                .iter()
                .map(|[a, b]| (a - 1.0).powi(2) + 2.0 * (b - 1.0).powi(2))
                .collect()
        }
        fn gradients(&self, sigmas: &[[f64; 2]]) -> Vec<[f64; 2]> {
            sigmas
                .iter()
                .map(|[a, b]| [2.0 * (a - 1.0), 4.0 * (b - 1.0)])
                .collect()
        }
        fn hessians(&self, sigmas: &[[f64; 2]]) -> Vec<Matrix<2>> {
            vec![[[2.0, 0.0], [0.0, 4.0]]; sigmas.len()]
        }
    }
    assert!(matches!(
        Batched::new(Uneven),
        Err(FormulaError::NotSymmetric)
    ));
}

#[test]
fn inverted_elements_are_outside_where_the_formula_is_infinite() {
    assert_eq!(
        formula::<2>(SYMMETRIC_DIRICHLET).value(&[1.0, -1.0]),
        f64::INFINITY
    );
    assert_eq!(formula::<2>(ARAP).value(&[1.0, -1.0]), 2.0);
}

fn refused<const D: usize>(text: &str) -> FormulaError {
    Formula::<D>::parse(text).expect_err(text)
}

#[test]
fn errors_name_the_column() {
    let column = |text: &str| match refused::<2>(text) {
        FormulaError::Unexpected { column, .. }
        | FormulaError::UnknownName { column, .. }
        | FormulaError::TooDeep { column, .. } => column,
        error => panic!("{text}: {error}"),
    };
    assert_eq!(column(""), 1);
    assert_eq!(column("s1 +"), 5);
    assert_eq!(column("(s1 + s2"), 9);
    assert_eq!(column("s1 s2"), 4);
    assert_eq!(column("s1*s3"), 4);
    assert_eq!(column("s1 + σ₂"), 6);
    assert_eq!(column("1.2.3"), 1);
    assert_eq!(column("1e"), 1);
    assert_eq!(column("log s1"), 5);
    assert_eq!(column(&"(".repeat(1000)), 51);
    assert_eq!(column(&"-".repeat(1000)), 51);
    assert!(matches!(
        refused::<2>(&"1+".repeat(600)),
        FormulaError::TooLong { .. }
    ));
}

#[test]
fn what_is_no_energy_is_named() {
    use FormulaError::{NotFinite, NotMinimal, NotSmooth, NotSymmetric};
    assert!(matches!(
        refused::<2>("log(s1 - 1)^2 + log(s2 - 1)^2"),
        NotFinite { .. }
    ));
    assert!(matches!(refused::<2>("1e999*s1*s2"), NotFinite { .. }));
    assert_eq!(refused::<2>("sqrt((s1 - 1)^2 + (s2 - 1)^2)"), NotSmooth);
    assert_eq!(refused::<2>("((s1 - s2)^2)^0.5"), NotSmooth);
    assert_eq!(refused::<2>("(s1 - 1)^2 + 2*(s2 - 1)^2"), NotSymmetric);
    assert_eq!(refused::<3>("(s1 - 1)^2 + (s2 - 1)^2"), NotSymmetric);
    assert!(matches!(refused::<2>("s1^2 + s2^2"), NotMinimal { .. }));
    assert!(matches!(
        refused::<2>("-(s1 - 1)^2 - (s2 - 1)^2"),
        NotMinimal { .. }
    ));
    assert!(matches!(
        refused::<2>("(s1 - 1)*(s2 - 1)"),
        NotMinimal { .. }
    ));
}

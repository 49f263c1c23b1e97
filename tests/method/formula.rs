//! Energies by formula and by closure.

use unwrapd_method::barrier::Barrier;
use unwrapd_method::energy::{
    Arap, Density, Formula, FormulaError, Jet, Mips, Modes, SymmetricDirichlet,
};

use crate::terms::{assert_plane_taylor, assert_space_taylor};

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

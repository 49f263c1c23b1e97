//! Formulas where the name of an energy is taken.

use unwrapd_deform::{Body, Model, Problem, ProblemError, Solution};
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::{DensityKind, EnergyKind, Formula, FormulaError, OwnEnergy};
use unwrapd_method::solver::{Control, Iterate, Settings};

use crate::pulled::{bent_strip, strip, twisted_bar};
use crate::session::{session, settle, vertex};

const ARAP: [&str; 2] = [
    "((s1 - 1)^2 + (s2 - 1)^2)/2",
    "((s1 - 1)^2 + (s2 - 1)^2 + (s3 - 1)^2)/2",
];

fn read(text: &str) -> EnergyKind {
    text.parse().expect(text)
}

fn solved(problem: &Problem) -> Result<Solution, ProblemError> {
    problem.solve(&Settings::default(), &|_: &Iterate| Control::Continue)
}

fn assert_same(a: &Problem, b: &Problem) {
    let (a, b) = (solved(a).expect("a map"), solved(b).expect("a map"));
    assert_eq!(a.summary.iterations, b.summary.iterations);
    for (a, b) in a.x.iter().zip(&b.x) {
        assert!((a - b).abs() <= 1e-10, "{a} {b}");
    }
    assert!((a.quality.energy - b.quality.energy).abs() <= 1e-10 * b.quality.energy);
}

#[test]
fn a_formula_is_solved_as_the_energy_that_it_says() {
    let bent = |energy| bent_strip(1.0, energy, BarrierKind::InverseSpline);
    assert_same(&bent(read(ARAP[0])), &bent(DensityKind::Arap.into()));
    let [by_text, by_name] = [read(ARAP[1]), DensityKind::Arap.into()].map(twisted_bar);
    assert_same(&by_text, &by_name);
}

#[test]
fn names_and_formulas_are_written_as_they_are_read() {
    for text in ["arap", "st-venant-kirchhoff", ARAP[0], ARAP[1]] {
        let json = serde_json::to_string(text).expect("JSON");
        let energy: EnergyKind = serde_json::from_str(&json).expect(text);
        assert_eq!(energy, read(text));
        assert_eq!(serde_json::to_string(&energy).expect("JSON"), json);
    }
    assert_eq!(
        read("symmetric_dirichlet"),
        DensityKind::SymmetricDirichlet.into()
    );
    assert!(serde_json::from_str::<EnergyKind>("5").is_err());
    assert_ne!(read(ARAP[0]), read(ARAP[1]));
}

#[test]
fn errors_are_those_of_the_dimension_that_is_meant() {
    let refused = |text: &str| text.parse::<EnergyKind>().expect_err(text);
    assert_eq!(refused("s1 + s2 +").column(), Some(10));
    assert_eq!(refused("s1 + s2 + s3 +").column(), Some(15));
    assert!(matches!(refused("steam"), FormulaError::UnknownName { .. }));
    assert!(matches!(
        refused("-(s1*s2*s3 - 1)^2"),
        FormulaError::NotMinimal { .. }
    ));
    let long = format!("{}+{}", ARAP[0], "0".repeat(OwnEnergy::LONGEST));
    assert!(matches!(refused(&long), FormulaError::TooLong { .. }));

    let of_plane = solved(&twisted_bar(read(ARAP[0])));
    assert!(matches!(of_plane, Err(ProblemError::Formula(_))));
    let of_space = solved(&bent_strip(1.0, read(ARAP[1]), BarrierKind::None));
    assert!(matches!(of_space, Err(ProblemError::Formula(_))));
}

#[test]
fn names_have_hyphens_or_underscores() {
    for name in [
        "frozen-arap",
        "symmetric-dirichlet",
        "st-venant-kirchhoff",
        "neo-hookean",
        "uniform-laplacian",
    ] {
        let hyphens: EnergyKind = read(name);
        assert_eq!(serde_json::to_value(&hyphens).expect("JSON"), name);
        assert_eq!(read(&name.replace('-', "_")), hyphens);
    }
    for name in ["inverse-spline", "augmented-log", "neo-hookean"] {
        let read = |name: &str| {
            let quoted = serde_json::Value::from(name);
            serde_json::from_value::<BarrierKind>(quoted).expect("a barrier")
        };
        assert_eq!(read(&name.replace('-', "_")), read(name));
    }
}

/// The rotations are frozen in each step only, so the minimum is that of ARAP.
#[test]
fn frozen_rotations_lead_to_the_same_minimum() {
    let energies = ["arap", "frozen-arap"].map(|name| {
        let problem = bent_strip(1.0, read(name), BarrierKind::InverseSpline);
        let settings = Settings {
            tolerance: 1e-9,
            ..Settings::follow()
        };
        let solution = problem.solve(&settings, &|_: &Iterate| Control::Continue);
        solution.expect("a map").quality.energy
    });
    assert!(
        (energies[0] - energies[1]).abs() <= 1e-4 * energies[0],
        "{energies:?}"
    );
}

#[test]
fn a_session_goes_on_with_a_closure() {
    let body = Body::from(&strip(6, 1.0));
    let handles = [vertex(0, &[0.0, 0.0]), vertex(19, &[7.0, 1.0])];
    let hencky = Formula::<2>::new(|&[a, b]| a.ln() * a.ln() + b.ln() * b.ln()).expect("an energy");
    let [by_closure, by_text] = [
        DensityKind::Formula(hencky.into()).into(),
        read("log(s1)^2 + log(s2)^2"),
    ]
    .map(|energy| {
        let (mut session, _) = session(&body, &handles, &Model::default());
        let model = Model {
            energy,
            ..Model::default()
        };
        session.remodel(&model).expect("a model");
        settle(&mut session);
        assert_eq!(model, model.clone());
        session.positions()
    });
    for (a, b) in by_closure.iter().zip(&by_text) {
        assert!((a - b).abs() <= 1e-9, "{a} {b}");
    }
}

#[test]
fn a_closure_is_written_as_a_word_that_is_no_energy() {
    let arap = Formula::<3>::new(|s| {
        s.map(|s| (s - 1.0).powf(2.0))
            .into_iter()
            .fold(s[0] * 0.0, |a, b| a + b)
    });
    let energy = EnergyKind::Density(DensityKind::Formula(arap.expect("an energy").into()));
    let written = serde_json::to_string(&energy).expect("JSON");
    let read: EnergyKind = serde_json::from_str(&written).expect("a text");
    assert_eq!(written, "\"functions\"");
    assert!(read.check().is_err());
    assert_eq!(energy.check(), Ok(()));
    let problem = bent_strip(1.0, energy, BarrierKind::None);
    let error = solved(&problem).expect_err("for space");
    let expected = FormulaError::OtherDimension { dim: 2 };
    assert_eq!(error, ProblemError::Formula(expected));
}

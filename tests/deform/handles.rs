//! Handles of a researcher's own: what does not fit is an error, and the map stays as it was.

use unwrapd_deform::{Body, Problem};
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::solver::{
    Control, Handles, HandlesError, Iterate, Objective, Settings, Status, follow,
};

use crate::pulled::bent_strip;
use unwrapd_method::energy::DensityKind;

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}

fn strip() -> Problem {
    bent_strip(1.0, DensityKind::Arap, BarrierKind::InverseSpline)
}

fn objective(problem: &Problem) -> Objective {
    let Problem { body, energy, .. } = problem;
    let terms = body
        .terms(energy, problem.barrier, None)
        .expect("a planar energy");
    Objective::of_terms(body.n_vertices(), terms)
}

/// How following ends, and where.
fn followed(body: &Body, handles: &Handles) -> (Result<Status, HandlesError>, Vec<f64>) {
    let mut x = body.rest.clone();
    let stations = std::slice::from_ref(handles);
    let mut objective = objective(&strip());
    let ended = follow::<2>(
        &mut objective,
        &mut x,
        stations,
        &Settings::follow(),
        &go_on,
    );
    (ended.map(|summary| summary.status), x)
}

#[test]
fn what_does_not_fit_is_an_error_and_nothing_moves() {
    let problem = strip();
    let fits = &problem.stations[0];
    let pulls = |change: &dyn Fn(&mut Handles)| {
        let mut handles = fits.clone();
        change(&mut handles);
        let (ended, x) = followed(&problem.body, &handles);
        assert_eq!(x, problem.body.rest);
        ended.expect_err("a misfit").code()
    };
    assert_eq!(pulls(&|h| h.targets.truncate(5)), "unpaired_handles");
    assert_eq!(pulls(&|h| h.targets.push(0.0)), "unpaired_handles");
    assert_eq!(pulls(&|h| h.groups.truncate(2)), "unpaired_handles");
    assert_eq!(pulls(&|h| h.vertices[2] = 27), "unknown_handle");
    assert_eq!(pulls(&|h| h.vertices[2] = 0), "contradictory_handles");
    assert_eq!(pulls(&|h| h.targets[3] = f64::NAN), "bad_target");
    assert_eq!(pulls(&|h| h.targets[3] = 1e154), "bad_target");
    assert_eq!(pulls(&|h| h.bends = vec![[0.0; 3]]), "unpaired_handles");
    let endless = |h: &mut Handles| h.bends = vec![[f64::INFINITY; 3]; h.n_ways()];
    assert_eq!(pulls(&endless), "bad_target");
    let point = |vertex| vec![(vertex, 1.0)];
    assert_eq!(pulls(&|h| h.points.push(point(5))), "unpaired_handles");
    let unmet = |h: &mut Handles| {
        h.points.push(point(5));
        h.point_targets.extend([1.0, 1.0]);
    };
    assert_eq!(pulls(&unmet), "unpaired_handles");
    let mut wrong = problem.clone();
    wrong.stations[0].vertices[2] = 27;
    let solved = wrong.solve(&Settings::follow(), &go_on);
    assert_eq!(solved.expect_err("a misfit").code(), "unknown_handle");
    let levenberg = wrong.solve_by_levenberg(&wrong.levenberg, &go_on);
    assert_eq!(levenberg.expect_err("a misfit").code(), "unknown_handle");
}

#[test]
fn handles_without_groups_travel_alone() {
    let problem = strip();
    let alone = Handles {
        groups: Vec::new(),
        ..problem.stations[0].clone()
    };
    let (ended, x) = followed(&problem.body, &alone);
    assert_eq!(ended, Ok(Status::Converged));
    let targets = alone.targets.as_chunks::<2>().0;
    for (&v, target) in alone.vertices.iter().zip(targets) {
        assert_eq!(&x.as_chunks::<2>().0[v as usize], target);
    }
}

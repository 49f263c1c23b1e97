//! Sessions: valid at every iterate, where a problem ends, undo to the bit, one analysis whatever becomes of the handles, errors.

use unwrapd_deform::{Body, Handle, HandleId, Model, Problem, ProblemError, Session};
use unwrapd_method::solver::{Control, Iterate, Settings, Stage};

use crate::pulled::{bar, strip};

pub fn vertex(vertex: u32, to: &[f64]) -> Handle {
    Handle::Vertex {
        vertex,
        to: to.to_vec(),
        weight: None,
    }
}

pub fn point(at: &[f64], to: &[f64]) -> Handle {
    Handle::Point {
        at: at.to_vec(),
        to: to.to_vec(),
        weight: None,
    }
}

pub fn disc(center: &[f64], radius: f64, to: &[f64]) -> Handle {
    Handle::Disc {
        center: center.to_vec(),
        radius,
        to: to.to_vec(),
        turn: 0.0,
        axis: None,
        weight: None,
    }
}

pub fn session(body: &Body, handles: &[Handle], model: &Model) -> (Session, Vec<HandleId>) {
    let mut session = Session::new(body.clone(), model).expect("an energy of this dimension");
    let add = |handle: &Handle| session.add(handle.clone()).expect("a handle of the body");
    let ids = handles.iter().map(add).collect();
    (session, ids)
}

/// Settles, every iterate being looked at.
#[track_caller]
pub fn settle(session: &mut Session) {
    let mut steps = 0;
    while session.step() == Stage::Moving {
        assert!(session.quality().smallest > 0.0);
        steps += 1;
        assert!(steps < 500, "{:?}", session.summary());
    }
    assert_eq!(session.stage(), Stage::Settled);
}

/// Settled, a session has the energy that a problem with its handles ends with.
#[track_caller]
pub fn assert_solved(session: &Session, body: &Body, model: &Model) {
    let handles: Vec<Handle> = session
        .handles()
        .map(|(_, handle)| handle.clone())
        .collect();
    let problem = Problem::new(body.clone(), &handles, model).expect("a problem");
    let settings = Settings {
        tolerance: 1e-10,
        ..Settings::follow()
    };
    let solution = problem.solve(&settings, &|_: &Iterate| Control::Continue);
    let solved = solution.expect("a map").quality;
    let found = session.quality();
    let relative = |found: f64, solved: f64| (found - solved).abs() / solved.abs().max(1e-3);
    let difference = relative(found.energy + found.barrier, solved.energy + solved.barrier);
    assert!(difference < 1e-6, "{found:?} {solved:?}");
    assert!((found.residual - solved.residual).abs() < 1e-12);
}

/// A strip of 12 × 2 squares in millimeters, its left end held and its right end in the hand.
fn strip_in_hand() -> (Body, [Handle; 3]) {
    let edge = 1e-3;
    let at = |x: f64, y: f64| [edge * x, edge * y];
    let handles = [
        disc(&at(0.0, 1.0), 1.1 * edge, &at(0.0, 1.0)),
        vertex(37, &at(12.0, 1.0)),
        point(&at(6.3, 0.4), &at(6.3, 0.4)),
    ];
    (Body::from(&strip(12, edge)), handles)
}

#[test]
fn it_settles_where_a_problem_ends() {
    let (body, handles) = strip_in_hand();
    let model = Model::default();
    let (mut session, ids) = session(&body, &handles, &model);
    for frame in 1..=10 {
        let way = 2e-4 * f64::from(frame);
        session
            .move_handle(ids[1], &[12e-3 - way, 1e-3 + way])
            .expect("a target");
        session
            .move_handle(ids[2], &[6.3e-3, 0.4e-3 + way])
            .expect("a target");
        session.step();
        assert!(session.quality().smallest > 0.0);
    }
    settle(&mut session);
    assert_solved(&session, &body, &model);
    assert_eq!(session.positions()[74..76], [12e-3 - 2e-3, 1e-3 + 2e-3]);
    assert_eq!(session.analyses(), 1);
}

#[test]
fn handles_come_and_go_with_one_analysis() {
    let (body, handles) = strip_in_hand();
    let model = Model::default();
    let (mut session, ids) = session(&body, &handles[..2], &model);
    session
        .move_handle(ids[1], &[11e-3, 3e-3])
        .expect("a target");
    settle(&mut session);
    let held = session.quality().energy;
    let pulled = session
        .add(point(&[6.3e-3, 0.4e-3], &[6e-3, 2e-3]))
        .expect("a point");
    settle(&mut session);
    assert!(session.quality().energy > held);
    assert_solved(&session, &body, &model);
    let other = session.add(vertex(20, &[6e-3, 4e-3])).expect("a vertex");
    session.remove(pulled).expect("a handle");
    settle(&mut session);
    assert_solved(&session, &body, &model);
    session
        .exchange(other, vertex(20, &[7e-3, 3e-3]))
        .expect("a handle");
    session.remove(ids[0]).expect("a handle");
    session.add(handles[0].clone()).expect("a handle");
    settle(&mut session);
    assert_solved(&session, &body, &model);
    session.remove(other).expect("a handle");
    settle(&mut session);
    assert!((session.quality().energy / held - 1.0).abs() < 1e-6);
    assert_eq!(session.analyses(), 1);
}

#[test]
fn undo_is_exact() {
    let (body, handles) = strip_in_hand();
    let (mut session, ids) = session(&body, &handles, &Model::default());
    assert!(!session.undo() && !session.redo());
    settle(&mut session);
    session.remember();
    let first = session.positions();
    session
        .move_handle(ids[1], &[11e-3, 4e-3])
        .expect("a target");
    // Not settled: what is remembered is the map as it stands.
    session.step();
    session.remember();
    let second = session.positions();
    session.remove(ids[0]).expect("a handle");
    session.step_while(|session| session.summary().iterations < 10);
    let third = session.positions();
    assert!(session.undo());
    assert_eq!(session.positions(), second);
    assert_eq!(session.handles().count(), 3);
    assert!(session.undo());
    assert_eq!(session.positions(), first);
    assert!(!session.undo());
    assert!(session.redo() && session.redo());
    assert_eq!(session.positions(), third);
    assert_eq!(session.handles().count(), 2);
    assert!(session.undo());
    session
        .move_handle(ids[0], &[0.0, 2e-3])
        .expect("it is back");
    settle(&mut session);
    assert_eq!(session.analyses(), 1);
}

#[test]
fn what_cannot_be_held_is_refused_and_changes_nothing() {
    let (body, handles) = strip_in_hand();
    let (mut session, ids) = session(&body, &handles, &Model::default());
    session
        .move_handle(ids[1], &[11e-3, 2e-3])
        .expect("a target");
    session.step();
    let before = session.positions();
    let refused = [
        session
            .add(vertex(39, &[0.0, 0.0]))
            .expect_err("no such vertex"),
        session.add(vertex(3, &[0.0])).expect_err("no position"),
        session
            .add(vertex(3, &[f64::NAN, 0.0]))
            .expect_err("not finite"),
        session
            .add(point(&[1.0, 1.0], &[0.0, 0.0]))
            .expect_err("outside"),
        session
            .add(disc(&[0.0, 0.0], -1.0, &[0.0, 0.0]))
            .expect_err("no radius"),
        session
            .add(vertex(37, &[0.0, 0.0]))
            .expect_err("held elsewhere"),
        session
            .move_handle(ids[0], &[0.0; 3])
            .expect_err("no position"),
    ];
    let codes = refused.map(|error| error.code());
    let expected = [
        "unknown_handle",
        "bad_target",
        "bad_target",
        "handle_outside",
        "bad_parameter",
        "contradictory_handles",
        "bad_target",
    ];
    assert_eq!(codes, expected);
    assert_eq!(session.positions(), before);
    assert_eq!(session.handles().count(), 3);
    session.remove(ids[1]).expect("a handle");
    for gone in [
        session.remove(ids[1]),
        session.move_handle(ids[1], &[0.0, 0.0]),
        session.exchange(ids[1], vertex(1, &[0.0, 0.0])),
    ] {
        assert_eq!(gone, Err(ProblemError::RemovedHandle { handle: 1 }));
    }
    let planar = Model {
        energy: unwrapd_method::energy::DensityKind::Lscm.into(),
        ..Model::default()
    };
    assert!(Session::new(Body::from(&bar(2)), &planar).is_err());
}

#[test]
fn nothing_to_do_is_nothing_done() {
    let (body, _) = strip_in_hand();
    let mut session = Session::new(body.clone(), &Model::default()).expect("an energy");
    assert_eq!(session.positions(), Body::from(&strip(12, 1e-3)).rest);
    settle(&mut session);
    let id = session.add(vertex(4, &body.rest[8..10])).expect("a vertex");
    settle(&mut session);
    let iterations = session.summary().iterations;
    assert_eq!(session.step(), Stage::Settled);
    assert_eq!(session.summary().iterations, iterations);
    let positions = session.positions();
    let distances = positions.iter().zip(&body.rest).map(|(x, y)| (x - y).abs());
    assert!(distances.fold(0.0, f64::max) < 1e-15);
    session.remove(id).expect("a handle");
    settle(&mut session);
}

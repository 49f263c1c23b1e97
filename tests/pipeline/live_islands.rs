//! Islands that make room for those that are held, and the documents that come of it.

use unwrapd_deform::{HandleId, Model};
use unwrapd_files::document::Upload;
use unwrapd_maps::plane::are_disjoint;
use unwrapd_method::numerics::bounds::{Bounds, bounds_of};
use unwrapd_method::solver::Stage;
use unwrapd_pipeline::{
    Island, IslandError, IslandSession, Layout, PipelineError, RepackOptions, Unobserved,
    open_islands, repack_document,
};

use crate::islands::{island, squares, uvs, written};

/// A page of `n` by `n` squares of different sizes, v up.
fn crowd(n: usize) -> Upload {
    let step = 1.0 / n as f64;
    let place = |k: usize| {
        let side = step * (0.85 - 0.1 * (k % 4) as f64);
        let corner = [k % n, k / n].map(|i| step * (i as f64 + 0.05));
        (corner, side)
    };
    squares(&(0..n * n).map(place).collect::<Vec<_>>())
}

fn opened(upload: &Upload) -> IslandSession {
    open_islands(upload, &RepackOptions::default()).expect("a session")
}

/// Holds the island of a face where it lies.
fn held(session: &mut IslandSession, face: u32) -> HandleId {
    let handle = serde_json::from_value(serde_json::json!({ "face": face })).expect("a handle");
    let island = session.map().named(0, &handle).expect("an island");
    session.add(island).expect("it is held")
}

fn settle(session: &mut IslandSession) -> Stage {
    session.step_while(|_| true)
}

/// The rectangle around the square of a face: squares have two faces each.
fn rectangle(session: &IslandSession, face: usize) -> Bounds {
    let uvs = session.map().vertex_uvs();
    let corners = session.map().faces()[face..face + 2].as_flattened();
    let corners = corners.iter().map(|&v| uvs[v as usize]);
    bounds_of(&corners.collect::<Vec<_>>())
}

/// No two islands overlap, and none leaves the page.
fn assert_apart(session: &IslandSession) {
    // Islands of the OBJ file are counter-clockwise, and v points down in the result.
    let uvs = session.map().vertex_uvs().into_iter();
    let uvs: Vec<[f64; 2]> = uvs.map(|[u, v]| [u, 1.0 - v]).collect();
    let faces = session.map().faces();
    assert!(are_disjoint(&uvs, faces), "islands overlap");
    let is_inside = |x: &f64| (-1e-9..=1.0 + 1e-9).contains(x);
    assert!(uvs.as_flattened().iter().all(is_inside), "off the page");
}

fn assert_near(point: [f64; 2], expected: [f64; 2]) {
    let far = (point[0] - expected[0]).hypot(point[1] - expected[1]);
    assert!(far < 1e-12, "{point:?} is not {expected:?}");
}

/// Repacks a document with all islands where a session has them.
fn committed(upload: &Upload, session: &IslandSession) -> Upload {
    let options = RepackOptions {
        islands: session.map().placements(),
        ..RepackOptions::default()
    };
    let outcome = repack_document(upload, &options, &Unobserved).expect("it is written");
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    written(&outcome)
}

#[test]
fn islands_make_room_and_the_document_is_certified() {
    for n in [3, 6, 10] {
        let upload = crowd(n);
        let mut session = opened(&upload);
        let id = held(&mut session, 0);
        for step in 0..40 {
            let t = f64::from(step) / 40.0 * std::f64::consts::TAU;
            let to = [0.5 + 0.3 * t.cos(), 0.5 + 0.3 * (2.0 * t).sin()];
            session.move_handle(id, &to).expect("a target");
            session.step();
            assert_apart(&session);
            let [low, high] = rectangle(&session, 0);
            assert_near([0, 1].map(|k| f64::midpoint(low[k], high[k])), to);
        }
        assert_eq!(settle(&mut session), Stage::Settled);
        // The bytes have the islands where the session has them.
        let file = committed(&upload, &session);
        let shown = session.map().vertex_uvs();
        let faces = session.map().faces().iter();
        for (face, corners) in faces.zip(uvs(&file)) {
            for (&vertex, [u, v]) in face.iter().zip(corners) {
                let [x, y] = shown[vertex as usize];
                let far = (u - x).hypot(v - y);
                assert!(far < 2e-7, "{n} by {n}");
            }
        }
    }
}

#[test]
fn a_released_island_stays_until_another_one_is_held() {
    let mut session = opened(&crowd(5));
    let id = held(&mut session, 0);
    session.move_handle(id, &[0.52, 0.48]).expect("a target");
    settle(&mut session);
    let before = session.map().vertex_uvs();
    session.remove(id).expect("a handle");
    assert_eq!(settle(&mut session), Stage::Settled);
    assert_eq!(session.map().vertex_uvs(), before);
    // The next one is held where it lies, and pushes the first aside.
    let next = held(&mut session, 6);
    session.move_handle(next, &[0.52, 0.48]).expect("a target");
    settle(&mut session);
    assert_apart(&session);
    let [low, high] = rectangle(&session, 6);
    let center = [0, 1].map(|k| f64::midpoint(low[k], high[k]));
    assert_near(center, [0.52, 0.48]);
}

#[test]
fn a_move_that_is_released_at_once_has_room() {
    let mut session = opened(&crowd(5));
    let id = held(&mut session, 0);
    session.move_handle(id, &[0.5, 0.5]).expect("a target");
    session.remove(id).expect("a handle");
    assert_apart(&session);
    assert_eq!(settle(&mut session), Stage::Settled);
    let [low, high] = rectangle(&session, 0);
    let center = [0, 1].map(|k| f64::midpoint(low[k], high[k]));
    assert_near(center, [0.5, 0.5]);
}

#[test]
fn islands_are_held_at_an_angle_and_at_a_size() {
    let upload = crowd(5);
    let mut session = opened(&upload);
    let turned = |turn: f64, scale: f64| Island {
        shift: [0.4, -0.4],
        pivot: Some([0.095, 0.905]),
        turn,
        scale,
        ..island(0)
    };
    let id = session.add(turned(0.0, 1.0)).expect("it is held");
    for step in 1..=12 {
        let (turn, scale) = (15.0 * f64::from(step), 1.0 + 0.05 * f64::from(step));
        session.exchange(id, turned(turn, scale)).expect("it turns");
        session.step();
        assert_apart(&session);
    }
    assert_eq!(settle(&mut session), Stage::Settled);
    let [low, high] = rectangle(&session, 0);
    let side = 0.2 * 0.85 * 1.6;
    let found = [0, 1].map(|k| high[k] - low[k]);
    // Numbers of the file have 32 bits.
    assert!(found.iter().all(|x| (x - side).abs() < 1e-7), "{found:?}");
    committed(&upload, &session);
}

#[test]
fn islands_stay_that_have_room() {
    let mut session = opened(&crowd(4));
    held(&mut session, 0);
    let before = session.map().vertex_uvs();
    assert_eq!(settle(&mut session), Stage::Settled);
    let after = session.map().vertex_uvs();
    // The margin between squares is larger than the padding.
    for (a, b) in before.iter().zip(after) {
        assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 2e-3);
    }
    assert!(session.map().smallest() > 0.999);
}

#[test]
fn an_island_without_room_is_unreached_until_it_leaves() {
    let mut session = opened(&crowd(3));
    let id = held(&mut session, 0);
    session.move_handle(id, &[1.2, 0.5]).expect("a target");
    assert_eq!(settle(&mut session), Stage::Unreachable);
    // It covers the page.
    let large = Island {
        scale: 3.5,
        pivot: Some([0.158, 0.842]),
        shift: [0.342, -0.342],
        ..island(0)
    };
    session.exchange(id, large).expect("it grows");
    assert_eq!(settle(&mut session), Stage::Unreachable);
    session
        .exchange(
            id,
            Island {
                scale: 1.0,
                ..large
            },
        )
        .expect("it shrinks");
    assert_eq!(settle(&mut session), Stage::Settled);
    assert_apart(&session);
}

#[test]
fn an_undo_returns_to_the_places_before() {
    let mut session = opened(&crowd(4));
    let first = session.map().vertex_uvs();
    session.remember();
    let id = held(&mut session, 0);
    session.move_handle(id, &[0.6, 0.6]).expect("a target");
    settle(&mut session);
    let moved = session.map().vertex_uvs();
    assert_ne!(moved, first);
    assert!(session.undo());
    assert_eq!(settle(&mut session), Stage::Settled);
    assert_eq!(session.map().vertex_uvs(), first);
    assert!(session.map().placements().is_empty());
    assert!(session.redo());
    assert_eq!(session.map().vertex_uvs(), moved);
    session.reset();
    assert_eq!(session.map().vertex_uvs(), first);
}

#[test]
fn equal_moves_make_equal_places() {
    let run = || {
        let mut session = opened(&crowd(6));
        let id = held(&mut session, 8);
        for step in 0..10 {
            let t = f64::from(step) / 10.0;
            session.move_handle(id, &[t, 0.5]).expect("a target");
            session.step();
        }
        session.map().vertex_uvs()
    };
    assert_eq!(run(), run());
}

#[test]
fn islands_that_overlap_or_leave_the_page_in_the_file_are_brought_in() {
    let places = [
        ([0.1, 0.1], 0.3),
        ([0.15, 0.12], 0.3),
        ([1.5, -0.4], 0.3),
        ([0.0, 0.0], 1.4),
    ];
    let upload = squares(&places);
    let mut session = opened(&upload);
    held(&mut session, 0);
    assert_eq!(settle(&mut session), Stage::Settled);
    assert_apart(&session);
    committed(&upload, &session);
}

#[test]
fn faulty_handles_are_refused_and_change_nothing() {
    let mut session = opened(&crowd(3));
    let id = held(&mut session, 0);
    settle(&mut session);
    let before = session.map().vertex_uvs();
    let unknown = session.add(island(18)).expect_err("no face");
    assert_eq!(unknown, IslandError::UnknownFace(1));
    let twice = session.add(island(1)).expect_err("the same island");
    assert_eq!(twice, IslandError::Twice(0, 1));
    for target in [&[f64::NAN, 0.0][..], &[1.0], &[1e9, 0.0]] {
        let refused = session.move_handle(id, target).expect_err("no target");
        assert_eq!(refused.code(), "bad_target", "{target:?}");
    }
    let huge = Island {
        scale: 10.0,
        ..island(2)
    };
    assert_eq!(session.add(huge), Err(IslandError::OffPage(1)));
    let refused = session.remodel(&Model::default());
    assert_eq!(refused, Err(IslandError::NoEnergy));
    assert_eq!(session.step(), Stage::Settled);
    assert_eq!(session.map().vertex_uvs(), before);
}

#[test]
fn a_session_has_a_limited_number_of_islands() {
    let places = |n: usize| -> Vec<_> { (0..n).map(|k| ([0.01 * k as f64, 0.5], 0.005)).collect() };
    opened(&squares(&places(101)));
    let refused = open_islands(&squares(&places(102)), &RepackOptions::default());
    match refused {
        Err(PipelineError::Islands(error)) => assert_eq!(error.code(), "too_many_islands"),
        other => panic!("{:?}", other.err()),
    }
}

#[test]
fn a_prescribed_density_is_refused() {
    let options = RepackOptions {
        layout: Layout {
            texels_per_unit: Some(10.0),
            ..Layout::default()
        },
        ..RepackOptions::default()
    };
    let refused = open_islands(&crowd(2), &options).err();
    let code = refused.map(|error| error.code());
    assert_eq!(code, Some("invalid_options"));
}

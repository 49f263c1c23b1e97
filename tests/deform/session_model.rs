//! Sessions whose energy and barrier change, which return to rest, and which go on elsewhere.

use unwrapd_deform::uv::{Anchor, UvEditOptions, UvMesh, UvSession, edit_uvs_from};
use unwrapd_deform::{Body, Model, ProblemError};
use unwrapd_method::solver::{Control, Iterate, Stage};

use crate::pulled::strip;
use crate::session::{assert_solved, disc, session, settle, vertex};
use crate::uv_meshes;
use unwrapd_method::energy::DensityKind;

fn stiff() -> Model {
    Model {
        energy: DensityKind::SymmetricDirichlet.into(),
        ..Model::default()
    }
}

#[test]
fn energy_and_barrier_are_exchanged() {
    let body = Body::from(&strip(12, 1.0));
    let handles = [
        disc(&[0.0, 1.0], 1.1, &[0.0, 1.0]),
        vertex(37, &[12.0, 1.0]),
    ];
    let (mut session, ids) = session(&body, &handles, &Model::default());
    session.remember();
    session.move_handle(ids[1], &[9.0, 4.0]).expect("a target");
    settle(&mut session);
    let before = session.positions();
    session.remodel(&stiff()).expect("a model");
    assert_eq!(session.positions(), before);
    settle(&mut session);
    assert_ne!(session.positions(), before);
    assert_solved(&session, &body, &stiff());

    let narrow = Model {
        max_conformal: Some(1.001),
        ..Model::default()
    };
    let settled = session.positions();
    assert_eq!(session.remodel(&narrow), Err(ProblemError::OutsideDomain));
    assert_eq!(session.positions(), settled);
    assert_eq!(session.stage(), Stage::Settled);

    assert!(session.undo());
    settle(&mut session);
    assert_eq!(session.handles().count(), 2);
    session.remember();
    session.move_handle(ids[1], &[11.0, 3.0]).expect("a target");
    session.step();
    session.reset();
    assert_eq!(session.positions(), body.rest);
    assert_eq!(session.handles().count(), 0);
    assert_eq!(session.step(), Stage::Settled);
    assert!(session.undo());
    assert_eq!(session.handles().count(), 2);
}

/// An edit that starts where a session was ends where one ends that does not.
#[test]
fn an_edit_goes_on_where_a_session_was() {
    let mesh = uv_meshes::UvMesh::grid(6);
    let view = UvMesh {
        positions: &mesh.positions,
        triangles: &mesh.triangles,
        uvs: &mesh.uvs,
    };
    let anchors = [
        Anchor::Vertex {
            vertex: 0,
            to: mesh.uvs[0][0],
            weight: None,
        },
        Anchor::Place {
            at: [0.7, 0.6],
            to: [0.5, 0.4],
            weight: None,
        },
    ];
    let mut options = UvEditOptions::edit();
    let mut session = UvSession::new(&view, options.clone());
    for anchor in anchors.clone() {
        session.add(anchor).expect("an anchor");
    }
    session.step_while(|_| true);
    let (first, signs) = (session.uvs(), session.kept_signs());
    assert!(signs.iter().all(|sign| *sign == signs[0] && *sign != 0));
    assert!((0.0..=1.0).contains(&session.smallest()) && session.energy() > 0.0);
    for (face, corners) in session.faces().iter().zip(&first) {
        let places = session.vertex_uvs();
        assert_eq!(face.map(|v| places[v as usize]), *corners);
    }
    options.model = stiff();
    session.remodel(&options.model).expect("a model");
    assert_eq!(session.uvs(), first);
    session.step_while(|_| true);
    assert_eq!(session.stage(), Stage::Settled);
    let settled = session.uvs();
    assert_ne!(settled, first);

    let far = |start, control: Control| {
        let watch = |_: &Iterate| control;
        let edited = edit_uvs_from(&view, start, &anchors, &options, &watch).expect("a map");
        let pairs = edited.uvs.as_flattened().as_flattened().iter();
        let pairs = pairs.zip(settled.as_flattened().as_flattened());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    assert!(far(None, Control::Continue) < 1e-6);
    assert!(far(Some(&settled), Control::Continue) < 1e-6);
    // At its first iterate an edit is where it starts.
    assert!(far(Some(&settled), Control::Finish) < 1e-6);
    assert!(far(None, Control::Finish) > 1e-3);

    session.reset();
    assert_eq!(session.uvs(), mesh.uvs);
    assert_eq!(session.handles().count(), 0);
}

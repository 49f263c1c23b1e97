//! Sessions of UVs: where an edit ends, other charts to the bit, undo, bijective, errors.

use unwrapd_deform::Model;
use unwrapd_deform::uv::{Anchor, EditError, UvEditOptions, UvMesh, UvSession, edit_uvs};
use unwrapd_maps::certificate::{Overlap, certify};
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_method::solver::{Control, Iterate, Stage};

use crate::uv_meshes;

/// Two squares of 6 × 6 cells, side by side in UV space.
fn two_squares() -> uv_meshes::UvMesh {
    let mut mesh = uv_meshes::UvMesh::grid(6).map_uvs(|[u, v]| [0.4 * u, 0.4 * v]);
    mesh.add(&uv_meshes::UvMesh::grid(6).map_uvs(|[u, v]| [0.5 + 0.4 * u, 0.4 * v]));
    mesh
}

fn view(mesh: &uv_meshes::UvMesh) -> UvMesh<'_> {
    UvMesh {
        positions: &mesh.positions,
        triangles: &mesh.triangles,
        uvs: &mesh.uvs,
    }
}

fn to(vertex: u32, to: [f64; 2]) -> Anchor {
    Anchor::Vertex {
        vertex,
        to,
        weight: None,
    }
}

#[track_caller]
fn assert_valid(mesh: &uv_meshes::UvMesh, uvs: &[CornerUvs]) {
    let certificate = certify(&mesh.positions, &mesh.triangles, uvs, &Overlap::Test.into());
    assert!(certificate.is_valid(), "{certificate:?}");
}

#[track_caller]
fn settle(session: &mut UvSession, mesh: &uv_meshes::UvMesh) {
    let mut steps = 0;
    while session.step() == Stage::Moving {
        assert_valid(mesh, &session.uvs());
        steps += 1;
        assert!(steps < 500);
    }
    assert_eq!(session.stage(), Stage::Settled);
}

/// The largest difference of two maps.
fn difference(a: &[CornerUvs], b: &[CornerUvs]) -> f64 {
    let pairs = a
        .as_flattened()
        .as_flattened()
        .iter()
        .zip(b.as_flattened().as_flattened());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn it_settles_where_an_edit_ends() {
    let mesh = two_squares();
    let bijective = UvEditOptions {
        model: Model {
            bijective: true,
            ..Model::default()
        },
        ..UvEditOptions::edit()
    };
    for options in [UvEditOptions::edit(), UvEditOptions::texture(), bijective] {
        let mut session = UvSession::new(&view(&mesh), options.clone());
        let held = session.add(to(0, mesh.uvs[0][0])).expect("an anchor");
        let center = session.add(to(24, [0.2, 0.2])).expect("an anchor");
        for frame in 1..=5 {
            let target = [
                0.2 + 0.01 * f64::from(frame),
                0.2 - 0.005 * f64::from(frame),
            ];
            session.move_handle(center, &target).expect("a target");
            session.step();
            assert_valid(&mesh, &session.uvs());
        }
        settle(&mut session, &mesh);
        let anchors: Vec<Anchor> = session
            .handles()
            .map(|(_, anchor)| anchor.clone())
            .collect();
        let edited = edit_uvs(&view(&mesh), &anchors, &options, &|_: &Iterate| {
            Control::Continue
        });
        let edited = edited.expect("a map").uvs;
        assert!(difference(&session.uvs(), &edited) < 1e-6);
        assert_eq!(session.uvs()[72..], mesh.uvs[72..]);
        if !options.model.bijective {
            assert_eq!(session.analyses(), 1);
        }
        session.remove(held).expect("an anchor");
        session.remove(center).expect("an anchor");
        assert_eq!(session.step(), Stage::Settled);
    }
}

#[test]
fn undo_is_exact_over_charts() {
    let mesh = two_squares();
    let mut session = UvSession::new(&view(&mesh), UvEditOptions::edit());
    assert_eq!(session.uvs(), mesh.uvs);
    session.remember();
    session.add(to(0, [0.0, 0.0])).expect("an anchor");
    session.add(to(48, [0.45, 0.42])).expect("an anchor");
    session.step();
    session.remember();
    let first = session.uvs();
    let at = Anchor::Place {
        at: [0.73, 0.21],
        to: [0.75, 0.25],
        weight: None,
    };
    session.add(at).expect("a place");
    session.add(to(49, [0.5, 0.0])).expect("an anchor");
    settle(&mut session, &mesh);
    let second = session.uvs();
    assert_ne!(second[72..], mesh.uvs[72..]);
    assert!(session.undo());
    assert_eq!(session.uvs(), first);
    assert!(session.undo() && !session.undo());
    assert_eq!(session.uvs(), mesh.uvs);
    assert_eq!(session.handles().count(), 0);
    assert!(session.redo() && session.redo() && !session.redo());
    assert_eq!(session.uvs(), second);
    assert_eq!(session.handles().count(), 4);
    assert_eq!(session.analyses(), 2);
}

#[test]
fn what_cannot_be_held_is_refused_and_changes_nothing() {
    let mesh = two_squares();
    let mut session = UvSession::new(&view(&mesh), UvEditOptions::texture());
    let id = session.add(to(24, [0.25, 0.2])).expect("an anchor");
    session.step();
    let before = session.uvs();
    let refused = [
        session.add(to(999, [0.0, 0.0])),
        session.add(to(8, [f64::NAN, 0.0])),
        session.add(to(24, [0.1, 0.1])),
        session.add(to(0, [0.1, 0.1])),
    ];
    let expected = [
        EditError::UnknownHandle(1),
        EditError::BadTarget(1),
        EditError::Contradictory(0, 1),
        EditError::OnBoundary(1),
    ];
    assert_eq!(refused, expected.map(Err));
    assert_eq!(session.uvs(), before);
    assert_eq!(session.handles().count(), 1);
    session.remove(id).expect("an anchor");
    assert_eq!(session.remove(id), Err(EditError::UnknownHandle(0)));
    assert_eq!(
        session.move_handle(id, &[0.0; 2]),
        Err(EditError::UnknownHandle(0))
    );
}

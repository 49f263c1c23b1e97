//! Sessions of solids, of cages, with a boundary that may not cross itself, and of sheets large enough to keep a factorization.

use unwrapd_deform::cage::{Cage, CagedSurface};
use unwrapd_deform::{Body, Model};
use unwrapd_maps::certificate::boundary_crossings;
use unwrapd_maps::mesh::PlanarMesh;
use unwrapd_method::solver::Stage;

use crate::pulled::bar;
use crate::session::{assert_solved, disc, point, session, settle, vertex};
use crate::zoo;

#[test]
fn tetrahedra_follow() {
    let body = Body::from(&bar(8));
    let model = Model::default();
    let handles = [
        disc(&[0.0, 0.5, 0.5], 0.8, &[0.0, 0.5, 0.5]),
        disc(&[8.0, 0.5, 0.5], 0.8, &[8.0, 0.5, 0.5]),
        point(&[4.4, 0.3, 0.2], &[4.4, 0.3, 0.2]),
    ];
    let (mut session, ids) = session(&body, &handles, &model);
    for frame in 1..=8 {
        let way = 0.25 * f64::from(frame);
        session
            .move_handle(ids[1], &[8.0 - 0.5 * way, 0.5 + way, 0.5])
            .expect("a target");
        session
            .move_handle(ids[2], &[4.4, 0.3, 0.2 + 0.5 * way])
            .expect("a target");
        session.step();
        assert!(session.quality().smallest > 0.0);
    }
    settle(&mut session);
    assert_solved(&session, &body, &model);
    assert_eq!(session.analyses(), 1);
}

#[test]
fn a_cage_carries_its_surface() {
    let sphere = zoo::sphere(16, 12);
    let positions: Vec<[f64; 3]> = sphere.positions.iter().map(|p| p.map(f64::from)).collect();
    let surfaces = [CagedSurface {
        positions: &positions,
        triangles: &sphere.triangles,
    }];
    let cage = Cage::around(&surfaces, 6).expect("a cage");
    let embedding = cage.embed(&positions).expect("places");
    let handles = [
        disc(&[0.0, 0.0, -1.0], 0.7, &[0.0, 0.0, -1.0]),
        disc(&[0.0, 0.0, 1.0], 0.7, &[0.0, 0.0, 1.0]),
    ];
    let body = Body::from(cage.mesh());
    let (mut session, ids) = session(&body, &handles, &Model::default());
    session
        .move_handle(ids[1], &[0.5, 0.25, 1.0])
        .expect("a target");
    settle(&mut session);
    let carried = cage.interpolate(&embedding, session.positions().as_chunks().0);
    let top = positions.iter().zip(&carried).find(|(p, _)| p[2] > 0.99);
    let (before, after) = top.expect("a pole");
    for (k, way) in [0.5, 0.25, 0.0].into_iter().enumerate() {
        assert!((after[k] - before[k] - way).abs() < 1e-9, "{after:?}");
    }
}

/// A strip two cells wide along five sixths of a circle.
fn horseshoe() -> PlanarMesh {
    let vertex = |v: u32| {
        let angle = (f64::from(v / 3) * 10.0 + 30.0).to_radians();
        let radius = 3.0 + 0.5 * f64::from(v % 3);
        [radius * angle.cos(), radius * angle.sin()]
    };
    let triangles = (0..60).flat_map(|cell| {
        let a = cell / 2 * 3 + cell % 2;
        [[a, a + 1, a + 4], [a, a + 4, a + 3]]
    });
    PlanarMesh::new((0..93).map(vertex).collect(), triangles.collect()).expect("a horseshoe")
}

#[test]
fn the_boundary_never_crosses_itself() {
    let mesh = horseshoe();
    let [start, end] = [1, 91].map(|v: usize| mesh.vertices()[v]);
    let back = mesh.vertices()[46];
    for bijective in [true, false] {
        let model = Model {
            bijective,
            ..Model::default()
        };
        let handles = [vertex(46, &back), vertex(1, &start), vertex(91, &end)];
        let (mut session, ids) = session(&Body::from(&mesh), &handles, &model);
        let mut most = 0;
        for frame in 1..=40 {
            let (s, t) = (f64::from(frame) / 40.0, 1.0 - f64::from(frame) / 40.0);
            let between = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| t * a[k] + s * b[k]);
            session
                .move_handle(ids[1], &between(start, end))
                .expect("a target");
            session
                .move_handle(ids[2], &between(end, start))
                .expect("a target");
            session.step();
            let x = session.positions();
            assert!(session.quality().smallest > 0.0);
            most = most.max(boundary_crossings(x.as_chunks().0, mesh.triangles()));
        }
        assert_eq!(most == 0, bijective);
        session.step_while(|session| session.summary().iterations < 2000);
        let x = session.positions();
        let crossings = boundary_crossings(x.as_chunks().0, mesh.triangles());
        assert!(crossings == 0 || !bijective);
        assert_ne!(session.stage(), Stage::Moving);
    }
}

#[test]
fn a_large_sheet_keeps_its_factorization() {
    let mesh = sheet(100);
    let body = Body::from(&mesh);
    let model = Model::default();
    let handles = [
        disc(&[50.0, 0.0], 12.0, &[50.0, 0.0]),
        disc(&[50.0, 100.0], 12.0, &[50.0, 100.0]),
    ];
    let (mut session, ids) = session(&body, &handles, &model);
    settle(&mut session);
    let before = session.summary().factorizations;
    for frame in 1..=40 {
        let way = 0.5 * f64::from(frame);
        let target = [50.0 + way, 100.0 + 0.5 * way];
        session.move_handle(ids[1], &target).expect("a target");
        session.step();
        let quality = session.quality();
        assert!(
            quality.smallest > 0.0 && quality.residual < 1e-18,
            "{quality:?}"
        );
    }
    let of_frames = session.summary().factorizations - before;
    assert!((1..=8).contains(&of_frames), "{of_frames}");
    settle(&mut session);
    assert_solved(&session, &body, &model);
    assert_eq!(session.analyses(), 1);
}

/// A sheet of `n` by `n` unit squares.
fn sheet(n: u32) -> PlanarMesh {
    let vertices = (0..(n + 1) * (n + 1)).map(|v| [v / (n + 1), v % (n + 1)].map(f64::from));
    let triangles = (0..n * n).flat_map(|cell| {
        let a = cell / n * (n + 1) + cell % n;
        [[a, a + n + 1, a + n + 2], [a, a + n + 2, a + 1]]
    });
    PlanarMesh::new(vertices.collect(), triangles.collect()).expect("a sheet")
}

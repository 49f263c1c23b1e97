//! Meshes given as arrays that share an atlas.

use unwrapd_layout::charts::Cut;
use unwrapd_maps::certificate::{Claims, certify};
use unwrapd_maps::mesh::MeshError;
use unwrapd_pipeline::{
    Cutting, GivenSeams, Island, IslandError, MeasureOptions, MeshArrays, Options, PipelineError,
    RepackOptions, Unobserved, UnwrappedMeshes, VerifyOptions, WeldedUvs, measure_meshes,
    repack_meshes, unwrap, unwrap_meshes, verify_meshes,
};

use crate::pipeline::is_on_seam;
use crate::zoo::{self, Mesh};

fn arrays(mesh: &Mesh) -> MeshArrays {
    MeshArrays {
        positions: mesh.positions.iter().map(|p| p.map(f64::from)).collect(),
        triangles: mesh.triangles.clone(),
        ..MeshArrays::default()
    }
}

fn unwrapped(meshes: &[MeshArrays]) -> UnwrappedMeshes {
    unwrap_meshes(meshes, &Options::default(), &Unobserved).expect("an atlas")
}

/// One mesh gets the UVs that it gets without a report, and the report has their judgment.
#[test]
fn the_zoo_is_unwrapped_as_by_settings() {
    let cutting = Cutting {
        cut: Cut::Fast,
        ..Cutting::default()
    };
    let options = Options {
        cutting,
        ..Options::default()
    };
    for mesh in zoo::zoo() {
        let given = arrays(&mesh);
        let made = unwrap_meshes(std::slice::from_ref(&given), &options, &Unobserved);
        let (positions, triangles) = (&given.positions, &given.triangles);
        let plain = unwrap(positions, triangles, &options.settings(), &Unobserved);
        match (made, plain) {
            (Ok(made), Ok(plain)) => {
                assert_eq!(made.uvs[0], plain.corner_uvs(), "{}", mesh.name);
                assert_eq!(made.charts[0].len(), triangles.len());
                let certificate = certify(positions, triangles, &made.uvs[0], &Claims::default());
                let judged = &made.report.groups[0].certificate;
                assert_eq!(judged.flipped, certificate.flipped, "{}", mesh.name);
                assert_eq!(judged.overlapping_pairs, certificate.overlapping_pairs);
            }
            (Err(made), Err(plain)) => assert_eq!(made.code(), plain.code(), "{}", mesh.name),
            (made, plain) => panic!("{}: {made:?} and {plain:?}", mesh.name),
        }
    }
}

/// Three meshes, of which two have one shape, lie beside each other in one atlas.
#[test]
fn several_share_an_atlas() {
    let meshes = [
        zoo::cone(7),
        zoo::grid(4, 3).moved([5.0, 0.0, 0.0]),
        zoo::cone(7).moved([0.0, 9.0, 0.0]),
    ]
    .map(|mesh| arrays(&mesh));
    let made = unwrapped(&meshes);
    assert!(made.report.certified, "{:?}", made.report.warnings);
    assert_eq!(made.report.groups.len(), 1);
    for (mesh, uvs) in meshes.iter().zip(&made.uvs) {
        assert_eq!(mesh.triangles.len(), uvs.len());
    }
    let mut with_uvs = meshes.to_vec();
    for (mesh, uvs) in with_uvs.iter_mut().zip(made.uvs) {
        mesh.uvs = Some(uvs);
    }
    let asked = VerifyOptions {
        bijective: true,
        ..VerifyOptions::default()
    };
    let verified = verify_meshes(&with_uvs, &asked).expect("a verdict");
    assert!(verified.certified, "{:?}", verified.lacking);
    let measured = measure_meshes(&with_uvs, &MeasureOptions::default()).expect("a report");
    assert_eq!(measured.groups[0].measures, made.report.groups[0].measures);
    let one_twice = [with_uvs[0].clone(), with_uvs[0].clone()];
    assert!(
        !verify_meshes(&one_twice, &asked)
            .expect("a verdict")
            .certified
    );
}

/// An index beyond the vertices of its mesh would name a vertex of the next.
#[test]
fn indices_are_those_of_their_mesh() {
    let mut meshes = [arrays(&zoo::cone(5)), arrays(&zoo::cone(5))];
    let n_vertices = meshes[0].positions.len();
    meshes[0].triangles[1][2] = n_vertices as u32;
    let error = unwrap_meshes(&meshes, &Options::default(), &Unobserved).expect_err("no vertex");
    assert!(matches!(
        error,
        PipelineError::Mesh(MeshError::IndexOutOfRange { face: 1, .. })
    ));
    for nothing in [vec![], vec![MeshArrays::default()]] {
        let error = unwrap_meshes(&nothing, &Options::default(), &Unobserved);
        assert_eq!(error.expect_err("nothing").code(), "no_triangles");
    }
}

/// Edges count the vertices of all meshes.
#[test]
fn seams_may_be_those_of_any_mesh() {
    let meshes = [
        arrays(&zoo::grid(2, 2)),
        arrays(&zoo::grid(2, 2).moved([9.0, 0.0, 0.0])),
    ];
    let first = meshes[0].positions.len() as u32;
    let options = |edges| Options {
        seams: Some(GivenSeams::Edges(edges)),
        ..Options::default()
    };
    let [a, b, _] = meshes[1].triangles[0];
    let named = options(vec![[first + a, first + b]]);
    assert!(unwrap_meshes(&meshes, &named, &Unobserved).is_ok());
    let none = options(vec![[a, first + b]]);
    let error = unwrap_meshes(&meshes, &none, &Unobserved).expect_err("no edge");
    assert_eq!(error.code(), "invalid_seams");
}

/// Cones count the vertices of all meshes; each of two equal meshes is slit through its own.
#[test]
fn cones_may_be_those_of_any_mesh() {
    let sphere = zoo::sphere(12, 7);
    let meshes = [
        arrays(&sphere),
        arrays(&sphere.clone().moved([4.0, 0.0, 0.0])),
    ];
    let n = sphere.positions.len() as u32;
    let options = |cone_vertices| Options {
        cone_vertices: Some(cone_vertices),
        cutting: Cutting {
            cut: Cut::Disk,
            ..Cutting::default()
        },
        ..Options::default()
    };
    let is_slit = |made: &UnwrappedMeshes, mesh: usize, vertex: u32| {
        let MeshArrays {
            positions,
            triangles,
            ..
        } = &meshes[mesh];
        is_on_seam(positions, triangles, &made.uvs[mesh], vertex)
    };
    let (first, second) = (20, 40);
    let named = options(vec![first, n + second]);
    let made = unwrap_meshes(&meshes, &named, &Unobserved).expect("an atlas");
    assert!(is_slit(&made, 0, first) && is_slit(&made, 1, second));
    for wrong in [
        options(vec![2 * n]),
        Options {
            cutting: Cutting::default(),
            ..options(vec![first])
        },
        Options {
            cutting: Cutting {
                cones: Some(3),
                ..named.cutting
            },
            ..options(vec![first])
        },
    ] {
        assert!(unwrap_meshes(&meshes, &wrong, &Unobserved).is_err());
    }
}

/// An island that is put somewhere is there, exactly.
#[test]
fn islands_stay() {
    let mut meshes = [
        arrays(&zoo::grid(2, 2)),
        arrays(&zoo::grid(2, 2).moved([9.0, 0.0, 0.0])),
    ];
    let given = unwrapped(&meshes);
    for (mesh, uvs) in meshes.iter_mut().zip(&given.uvs) {
        let scaled = uvs.iter().map(|face| face.map(|uv| uv.map(|x| 0.25 * x)));
        mesh.uvs = Some(scaled.collect());
    }
    let island = |primitive| Island {
        primitive,
        face: 0,
        shift: [0.0; 2],
        turn: 0.0,
        scale: 1.0,
        pivot: None,
    };
    let options = |islands| RepackOptions {
        islands,
        ..RepackOptions::default()
    };
    let made = repack_meshes(&meshes, &options(vec![island(1)]), &Unobserved).expect("an atlas");
    let before: Vec<_> = meshes.iter().flat_map(|mesh| &mesh.uvs).collect();
    assert_eq!(made.uvs[1][0], before[1][0]);
    assert_ne!(made.uvs[0][0], before[0][0]);
    let error = repack_meshes(&meshes, &options(vec![island(2)]), &Unobserved);
    assert!(matches!(
        error.expect_err("no such mesh"),
        PipelineError::Islands(IslandError::UnknownFace(0))
    ));
}

/// A vertex is there as often as its corners differ, in the order of the faces.
#[test]
fn uvs_are_welded() {
    let triangles = [[3, 1, 0], [0, 1, 2]];
    let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]];
    let welded = WeldedUvs::new(&triangles, &[[a, b, c], [d, b, a]]);
    assert_eq!(welded.origins, [3, 1, 0, 0, 2]);
    assert_eq!(welded.triangles, [[0, 1, 2], [3, 1, 4]]);
    assert_eq!(welded.uvs, [a, b, c, d, a]);
}

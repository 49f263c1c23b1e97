//! Islands that stay where they are put, and others packed around them.

use unwrapd_files::document::{Document, OutputFormat, Upload};
use unwrapd_maps::certificate::chart_ids;
use unwrapd_maps::mesh::{CornerUvs, Resolution};
use unwrapd_pipeline::{
    Island, IslandError, Layout, MeasureOptions, Options, Outcome, PipelineError, RepackOptions,
    Unobserved, VerifyOptions, repack_document, unwrap_document, verify_document,
};

use crate::places;

/// Squares that each have a place and a side in UV, v up, as an OBJ file; they lie apart in space.
pub fn squares(places: &[([f64; 2], f64)]) -> Upload {
    let mut lines = Vec::new();
    for (k, ([u, v], side)) in places.iter().enumerate() {
        for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            let [px, py] = [10.0 * side * x + 20.0 * k as f64, 10.0 * side * y];
            lines.push(format!("v {px} {py} 0"));
            lines.push(format!("vt {} {}", u + side * x, v + side * y));
        }
    }
    for k in 0..places.len() {
        let n = |corner: usize| 4 * k + corner;
        lines.push(format!("f {0}/{0} {1}/{1} {2}/{2}", n(1), n(2), n(3)));
        lines.push(format!("f {0}/{0} {1}/{1} {2}/{2}", n(1), n(3), n(4)));
    }
    Upload::single("squares.obj", lines.join("\n").into_bytes())
}

const FOUR: [([f64; 2], f64); 4] = [
    ([0.1, 0.1], 0.3),
    ([0.6, 0.1], 0.25),
    ([0.1, 0.6], 0.2),
    ([0.6, 0.6], 0.35),
];

pub fn island(face: u32) -> Island {
    Island {
        primitive: 0,
        face,
        shift: [0.0; 2],
        turn: 0.0,
        scale: 1.0,
        pivot: None,
    }
}

fn options(islands: Vec<Island>) -> RepackOptions {
    RepackOptions {
        islands,
        ..RepackOptions::default()
    }
}

fn repacked(upload: &Upload, options: &RepackOptions) -> Outcome {
    repack_document(upload, options, &Unobserved).expect("it fits")
}

/// The UVs of the first primitive, as the file has them.
pub fn uvs(upload: &Upload) -> Vec<CornerUvs> {
    let document = Document::read(upload).expect("a file");
    let uvs = document.corner_uvs(0, 0).expect("a set");
    uvs.expect("UVs")
}

pub fn written(outcome: &Outcome) -> Upload {
    let (name, bytes) = outcome.files[0].clone();
    Upload::single(name, bytes)
}

/// A mesh of several islands, unwrapped.
fn spot(resolution: Resolution, pages: u32) -> Upload {
    let bytes = std::fs::read(places::asset("spot.ply")).expect("an asset");
    let options = Options {
        layout: Layout {
            resolution,
            pages,
            ..Layout::default()
        },
        ..Options::default()
    };
    let upload = Upload::single("spot.ply", bytes);
    written(&unwrap_document(&upload, &options, &Unobserved).expect("it unwraps"))
}

/// For each face its island.
fn island_ids(upload: &Upload) -> Vec<u32> {
    let document = Document::read(upload).expect("a file");
    let primitive = &document.primitives()[0];
    let positions: Vec<[f64; 3]> = (primitive.positions.iter())
        .map(|p| p.map(f64::from))
        .collect();
    chart_ids(&positions, &primitive.triangles, &uvs(upload))
}

fn refused(upload: &Upload, islands: Vec<Island>) -> PipelineError {
    repack_document(upload, &options(islands), &Unobserved).expect_err("it is refused")
}

fn assert_near(uv: [f64; 2], expected: [f64; 2]) {
    let far = (uv[0] - expected[0]).hypot(uv[1] - expected[1]);
    assert!(far < 2e-7, "{uv:?} is not {expected:?}");
}

#[test]
fn a_part_without_uvs_stays_without() {
    let mut text = String::from_utf8(squares(&FOUR).bytes).expect("text");
    // In the object of the squares and of one material with them, and in one of its own.
    text += "\nf 1 2 3\no bare\nf 5 6 7\n";
    let upload = Upload::single("partly.obj", text.into_bytes());
    let outcome = repacked(&upload, &options(Vec::new()));
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    let warnings = outcome.report.warnings.iter();
    let missing = warnings
        .clone()
        .find(|warning| warning.code == "uvs_missing");
    let missing = &missing.expect("a warning").message;
    assert!(missing.starts_with("2 of 10 triangles"), "{missing}");
    assert_eq!(outcome.report.groups[0].certificate.faces, 8);
    // All triangles are in the file, and the record says which have UVs.
    let document = Document::read(&written(&outcome)).expect("a file");
    let counts = document
        .primitives()
        .iter()
        .enumerate()
        .map(|(index, primitive)| {
            let uvs = document.corner_uvs(index, 0).expect("a set");
            (primitive.triangles.len(), uvs.map(|uvs| uvs.len()))
        });
    let counts: Vec<_> = counts.collect();
    assert_eq!(counts, [(8, Some(8)), (1, None), (1, None)]);
    let verified = verify_document(&written(&outcome), &VerifyOptions::default());
    let verified = verified.expect("a judgment");
    assert_eq!(verified.judged.skipped_primitives, 2);
    assert!(
        verified
            .judged
            .to_string()
            .contains("left out: 2 primitives")
    );
}

#[test]
fn polygons_of_an_obj_without_uvs_stay_without() {
    let mut given = String::from_utf8(squares(&FOUR).bytes).expect("text");
    given += "\nf 1 2 3 4\nusemtl bare\nf 5 6 7\n";
    let upload = Upload::single("partly.obj", given.clone().into_bytes());
    let repack = RepackOptions {
        format: OutputFormat::Obj,
        ..options(Vec::new())
    };
    let outcome = repacked(&upload, &repack);
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    let mut warnings = outcome.report.warnings.iter();
    let missing = warnings.find(|warning| warning.code == "uvs_missing");
    let missing = &missing.expect("a warning").message;
    assert!(missing.starts_with("3 of 11 triangles"), "{missing}");
    assert_eq!(outcome.report.groups[0].certificate.faces, 8);
    // The lines are those of the file.
    let written = written(&outcome);
    let text = String::from_utf8(written.bytes.clone()).expect("text");
    let faces: Vec<&str> = text.lines().filter(|line| line.starts_with("f ")).collect();
    assert_eq!(faces.len(), 10);
    assert_eq!(faces[8..], ["f 1 2 3 4", "f 5 6 7"]);
    assert!(faces[..8].iter().all(|line| line.contains('/')));
    // They are judged on request only.
    let judged = |skip_missing: bool| {
        let judged = MeasureOptions {
            skip_missing,
            ..MeasureOptions::default()
        };
        let options = VerifyOptions {
            bijective: true,
            judged,
            ..VerifyOptions::default()
        };
        verify_document(&written, &options)
    };
    let verified = judged(true).expect("a judgment");
    assert!(verified.certified, "{:?}", verified.lacking);
    assert_eq!(verified.judged.skipped_faces, 3);
    let first_line = verified.judged.to_string();
    assert!(
        first_line.ends_with("left out: 3 triangles without UVs"),
        "{first_line}"
    );
    assert_eq!(judged(false).expect_err("refused").code(), "no_uvs");
    // Islands are named by the faces of the file. Its first two faces have no UVs.
    let bare_first = given.replacen("f 1/1", "f 1 2 3 4\nf 1/1", 1);
    let upload = Upload::single("partly.obj", bare_first.into_bytes());
    let of_face = |face: u32| RepackOptions {
        islands: vec![island(face)],
        ..repack.clone()
    };
    let stayed = repacked(&upload, &of_face(4));
    let text = String::from_utf8(self::written(&stayed).bytes).expect("text");
    let uvs = text.lines().filter_map(|line| {
        let numbers = line.strip_prefix("vt ")?.split(' ');
        Some(numbers.map(|x| x.parse().expect("a number")).collect())
    });
    let is_at = |uv: Vec<f64>| (0..2).all(|k| (uv[k] - FOUR[1].0[k]).abs() < 1e-6);
    assert!(uvs.into_iter().any(is_at), "{text}");
    let error = repack_document(&upload, &of_face(1), &Unobserved).expect_err("no island");
    assert_eq!(error.code(), "unknown_face");
}

#[test]
fn islands_stay_bit_for_bit_and_others_are_packed_around_them() {
    let input = spot(Resolution::square(1024), 1);
    let ids = island_ids(&input);
    let locked = [0, 1].map(|id| {
        ids.iter()
            .position(|&other| other == id)
            .expect("an island")
    });
    let islands = locked.map(|face| island(face as u32)).to_vec();
    let outcome = repacked(&input, &options(islands));
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    let (before, after) = (uvs(&input), uvs(&written(&outcome)));
    let stays = |id: u32| id == 0 || id == 1;
    let same = |face: usize| before[face] == after[face];
    assert!((0..ids.len()).all(|face| !stays(ids[face]) || same(face)));
    let moved = (0..ids.len()).filter(|&face| !same(face)).count();
    assert_eq!(moved, ids.iter().filter(|&&id| !stays(id)).count());
    // All others have one scale still.
    let factor = |face: usize| {
        let length = |uvs: &CornerUvs| {
            let [a, b, _] = uvs;
            (a[0] - b[0]).hypot(a[1] - b[1])
        };
        length(&after[face]) / length(&before[face])
    };
    let factors: Vec<f64> = (0..ids.len())
        .filter(|&f| !stays(ids[f]))
        .map(factor)
        .collect();
    let mean = factors.iter().sum::<f64>() / factors.len() as f64;
    assert!(factors.iter().all(|f| (f / mean - 1.0).abs() < 1e-3));
    // The largest first, each where it fits, comes to 0.906.
    assert!(mean > 0.96, "{mean}");
}

#[test]
fn numbers_beyond_the_grid_stay_too() {
    // A tenth is no multiple of any power of two.
    let input = squares(&FOUR);
    let gltf = written(&repacked(
        &input,
        &options((0..4).map(|k| island(2 * k)).collect()),
    ));
    let first = uvs(&gltf);
    assert_eq!(first[0][0][0], f64::from(0.1_f32));
    let again = repacked(&gltf, &options(vec![island(0), island(6)]));
    let second = uvs(&written(&again));
    for face in [0, 1, 6, 7] {
        assert_eq!(first[face], second[face]);
    }
    assert!(again.report.certified);
}

#[test]
fn islands_are_moved_turned_and_scaled() {
    let put = Island {
        shift: [0.25, -0.125],
        turn: 90.0,
        scale: 0.5,
        ..island(0)
    };
    let outcome = repacked(&squares(&FOUR), &options(vec![put]));
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    // v points down in the result: the square lies from 0.6 to 0.9, its middle is (0.25, 0.75).
    let [a, b, c] = uvs(&written(&outcome))[0];
    // (−0.15, 0.15) from the middle, turned from u to v: (−0.15, −0.15).
    assert_near(a, [0.5 - 0.075, 0.625 - 0.075]);
    assert_near(b, [0.5 - 0.075, 0.625 + 0.075]);
    assert_near(c, [0.5 + 0.075, 0.625 + 0.075]);
    let about = Island {
        pivot: Some([0.1, 0.9]),
        scale: 0.5,
        ..island(0)
    };
    let outcome = repacked(&squares(&FOUR), &options(vec![about]));
    let [a, b, _] = uvs(&written(&outcome))[0];
    assert_near(a, [0.1, 0.9]);
    assert_near(b, [0.25, 0.9]);
}

#[test]
fn v_points_where_it_does_in_the_result() {
    let put = Island {
        shift: [0.0, 0.25],
        turn: 90.0,
        ..island(0)
    };
    let mut options = options(vec![put]);
    options.format = OutputFormat::Obj;
    let outcome = repacked(&squares(&FOUR), &options);
    let [a, b, _] = uvs(&written(&outcome))[0];
    assert_near(a, [0.4, 0.35]);
    assert_near(b, [0.4, 0.65]);
}

#[test]
fn texels_stay_square_where_the_texture_is_not() {
    let put = Island {
        turn: 90.0,
        scale: 0.5,
        ..island(0)
    };
    let mut options = options(vec![put]);
    options.layout.resolution = Resolution {
        width: 2048,
        height: 1024,
    };
    let outcome = repacked(&squares(&FOUR), &options);
    let [a, b, c] = uvs(&written(&outcome))[0];
    // 0.3 of the width are 0.6 of the height.
    assert_near(a, [0.25 - 0.0375, 0.75 - 0.15]);
    assert_near(b, [0.25 - 0.0375, 0.75 + 0.15]);
    assert_near(c, [0.25 + 0.0375, 0.75 + 0.15]);
}

#[test]
fn islands_keep_their_shapes_on_textures_that_are_not_square() {
    let resolution = Resolution {
        width: 2048,
        height: 1024,
    };
    let input = spot(resolution, 1);
    for to in [resolution, Resolution::square(1024)] {
        let mut options = options(Vec::new());
        options.layout.resolution = to;
        let report = repacked(&input, &options).report;
        assert!(report.certified);
        let energy = report.groups[0].measures.distortion.sym_dirichlet_mean;
        assert!(energy < Some(4.12), "{to}: {energy:?}");
    }
}

#[test]
fn islands_stay_on_their_pages() {
    let input = spot(Resolution::square(512), 3);
    let before = uvs(&input);
    let second = |uvs: &CornerUvs| uvs.iter().all(|uv| uv[0] > 1.0 && uv[0] < 2.0);
    let face = before.iter().position(second).expect("a second page");
    let mut options = options(vec![island(face as u32)]);
    options.layout.resolution = Resolution::square(512);
    options.layout.pages = 3;
    let outcome = repacked(&input, &options);
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    assert_eq!(uvs(&written(&outcome))[face], before[face]);
}

#[test]
fn the_density_of_the_others_can_be_given() {
    let mut options = options(vec![island(0)]);
    options.layout.texels_per_unit = Some(40.0);
    let outcome = repacked(&squares(&FOUR), &options);
    let after = uvs(&written(&outcome));
    let side = |face: usize| {
        (after[face][0][0] - after[face][1][0]).hypot(after[face][0][1] - after[face][1][1])
    };
    assert!((side(0) - 0.3).abs() < 1e-6);
    assert!((side(2) * 1024.0 - 2.5 * 40.0).abs() < 1e-2);
    options.layout.texels_per_unit = Some(400.0);
    let error = repack_document(&squares(&FOUR), &options, &Unobserved);
    assert_eq!(error.expect_err("too dense").code(), "no_room");
}

#[test]
fn others_shrink_to_the_room_that_is_left() {
    let large = Island {
        shift: [0.0, 0.0],
        scale: 1.9,
        pivot: Some([0.1, 0.9]),
        ..island(0)
    };
    let input = squares(&[([0.1, 0.1], 0.45), ([0.6, 0.6], 0.35)]);
    let outcome = repacked(&input, &options(vec![large]));
    assert!(outcome.report.certified);
    let [a, b, _] = uvs(&written(&outcome))[2];
    let side = (a[0] - b[0]).hypot(a[1] - b[1]);
    assert!((0.05..0.1).contains(&side), "{side}");
    let all = Island {
        scale: 0.998 / 0.45,
        pivot: None,
        shift: [0.175, -0.175],
        ..island(0)
    };
    assert_eq!(refused(&input, vec![all]).code(), "no_room");
}

#[test]
fn faults_name_the_islands() {
    let input = squares(&FOUR);
    let none = refused(&input, vec![island(0), island(8)]);
    assert!(matches!(
        none,
        PipelineError::Islands(IslandError::UnknownFace(1))
    ));
    let nowhere = Island {
        primitive: 1,
        ..island(0)
    };
    let none = refused(&input, vec![nowhere]);
    assert!(matches!(
        none,
        PipelineError::Islands(IslandError::UnknownFace(0))
    ));
    let twice = refused(&input, vec![island(2), island(0), island(3)]);
    assert!(matches!(
        twice,
        PipelineError::Islands(IslandError::Twice(0, 2))
    ));
    let beyond = Island {
        shift: [0.36, 0.0],
        ..island(2)
    };
    let beyond = refused(&input, vec![island(0), beyond]);
    assert!(matches!(
        beyond,
        PipelineError::Islands(IslandError::OffPage(1))
    ));
    let (texels, expected) = (1.5, [0, 1]);
    let near = Island {
        shift: [-0.2 + texels / 1024.0, 0.0],
        ..island(2)
    };
    match refused(&input, vec![island(0), near]) {
        PipelineError::Islands(IslandError::TooNear {
            islands,
            texels: found,
            padding: 2,
        }) => {
            assert_eq!(islands, expected);
            assert!((found - texels).abs() < 1e-3, "{found}");
        }
        other => panic!("{other:?}"),
    }
    // One lies inside another: no borders are near each other.
    let inside = Island {
        scale: 0.2,
        shift: [-0.5, 0.5],
        ..island(6)
    };
    let inside = refused(&input, vec![island(0), inside]);
    assert_eq!(inside.to_string(), "islands 0 and 1 overlap or touch");
    assert_eq!((inside.code(), inside.exit_code()), ("islands_too_near", 3));
}

#[test]
fn numbers_out_of_range_are_refused() {
    for (name, put) in [
        (
            "islands[0].scale",
            Island {
                scale: -1.0,
                ..island(0)
            },
        ),
        (
            "islands[0].scale",
            Island {
                scale: 0.0,
                ..island(0)
            },
        ),
        (
            "islands[0].turn",
            Island {
                turn: 1e9,
                ..island(0)
            },
        ),
        (
            "islands[0].move",
            Island {
                shift: [0.0, f64::NAN],
                ..island(0)
            },
        ),
        (
            "islands[0].pivot",
            Island {
                pivot: Some([1e9, 0.0]),
                ..island(0)
            },
        ),
    ] {
        let error = refused(&squares(&FOUR), vec![put]);
        assert_eq!(error.code(), "invalid_options");
        assert!(error.to_string().contains(name), "{error}");
    }
}

//! OBJ files of several objects and materials through the applications.
use std::fmt::Write as _;
use std::time::Duration;
use unwrapd_deform::uv::parse_anchors;
use unwrapd_files::document::{Document, GroupBy, OutputFormat, Upload};
use unwrapd_layout::charts::Cut;
use unwrapd_method::solver::Control;
use unwrapd_pipeline::{
    Baking, Cutting, EditOptions, Editing, GivenSeams, Observer, Options, Progress, Stage,
    Unobserved, edit_document, unwrap_document,
};

/// A cube of two materials that take turns, in two objects that share vertices; each face has the whole square as its UVs.
fn cube() -> Upload {
    let mut text = String::from("vt 0 0\nvt 0.25 0\nvt 0.25 0.25\nvt 0 0.25\n");
    for v in 0..8 {
        let _ = writeln!(text, "v {} {} {}", v / 4, v / 2 % 2, v % 2);
    }
    let faces = [
        [0, 1, 3, 2],
        [5, 4, 6, 7],
        [4, 0, 2, 6],
        [1, 5, 7, 3],
        [2, 3, 7, 6],
        [0, 4, 5, 1],
    ];
    for (k, face) in faces.iter().enumerate() {
        let object = ["sides", "ends"][usize::from(k >= 4)];
        let _ = writeln!(text, "o {object}\nusemtl m{}", k % 2);
        let corners = (0..4).map(|c| format!("{}/{}", face[c] + 1, c + 1));
        let _ = writeln!(text, "f {}", corners.collect::<Vec<_>>().join(" "));
    }
    Upload::single("cube.obj", text.into_bytes())
}

fn reread(files: &[(String, Vec<u8>)]) -> Document {
    Document::read(&Upload::single(files[0].0.clone(), files[0].1.clone())).unwrap()
}

#[test]
fn faces_wound_against_their_neighbors_are_warned_of() {
    let text = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 5\nf 1 5 4\nf 2 3 6\n";
    let codes = |last: &str| {
        let upload = Upload::single("strip.obj", format!("{text}{last}").into_bytes());
        let options = Options::default();
        let outcome = unwrap_document(&upload, &options, &Unobserved);
        let report = outcome.expect("a result").report;
        assert!(report.certified);
        let warnings = report.warnings.into_iter();
        warnings.map(|w| w.code).collect::<Vec<_>>()
    };
    assert_eq!(codes("f 2 6 5\n"), Vec::<&str>::new());
    assert_eq!(codes("f 2 5 6\n"), ["mixed_winding"]);
}

#[test]
fn an_obj_has_one_atlas_unless_asked_otherwise() {
    for (group_by, n_groups) in [
        (None, 1),
        (Some(GroupBy::Mesh), 2),
        (Some(GroupBy::Material), 2),
        (Some(GroupBy::Primitive), 4),
    ] {
        let options = Options {
            group_by,
            ..Options::default()
        };
        let outcome = unwrap_document(&cube(), &options, &Unobserved).unwrap();
        assert_eq!(outcome.report.groups.len(), n_groups, "{group_by:?}");
        assert!(outcome.report.certified);
        let document = reread(&outcome.files);
        let faces: Vec<usize> = document
            .primitives()
            .iter()
            .map(|p| p.triangles.len())
            .collect();
        assert_eq!(faces, [4, 4, 2, 2]);
        let used = outcome.report.options.unwrap().group_by;
        assert_eq!(used, group_by.or(Some(GroupBy::Scene)));
    }
}

#[test]
fn seams_keep_the_numbers_of_the_file() {
    // All edges but five that hold the faces together in a cross.
    let edges = [[2, 3], [6, 7], [4, 6], [5, 7], [4, 5], [1, 5], [0, 4]];
    let charts = |format, seams: &[[u32; 2]]| {
        let options = Options {
            seams: Some(GivenSeams::Edges(seams.to_vec())),
            format,
            cutting: Cutting {
                cut: Cut::Seams,
                ..Cutting::default()
            },
            ..Options::default()
        };
        let outcome = unwrap_document(&cube(), &options, &Unobserved).unwrap();
        let report = &outcome.report.groups[0];
        (
            report.certificate.charts,
            outcome.report.options.unwrap().seams,
        )
    };
    for seams in [&edges[..], &[[0, 1], [1, 3], [3, 2], [2, 0]]] {
        assert_eq!(
            charts(OutputFormat::Obj, seams),
            charts(OutputFormat::Glb, seams)
        );
    }
    let beyond = Options {
        seams: Some(GivenSeams::Edges(vec![[0, 8]])),
        cutting: Cutting {
            cut: Cut::Seams,
            ..Cutting::default()
        },
        ..Options::default()
    };
    let error = unwrap_document(&cube(), &beyond, &Unobserved).unwrap_err();
    assert!(error.to_string().contains("names vertex 8"), "{error}");
}

/// The cube unfolds at its corners, as they are numbered in the file; its faces alternate between two materials.
#[test]
fn cones_keep_the_numbers_of_the_file() {
    let distortion = |format, cones: std::ops::Range<u32>| {
        let options = Options {
            cone_vertices: Some(cones.collect()),
            format,
            group_by: Some(GroupBy::Scene),
            cutting: Cutting {
                cut: Cut::Disk,
                ..Cutting::default()
            },
            ..Options::default()
        };
        let outcome = unwrap_document(&cube(), &options, &Unobserved).unwrap();
        let measures = &outcome.report.groups[0].measures;
        assert_eq!(measures.seams.charts, 1);
        measures.distortion.sym_dirichlet_mean.unwrap()
    };
    for format in [OutputFormat::Obj, OutputFormat::Glb] {
        assert!(distortion(format, 0..8) < 4.0 + 1e-6);
        assert!(distortion(format, 0..7) > 4.01);
    }
    let beyond = Options {
        cone_vertices: Some(vec![8]),
        cutting: Cutting {
            cut: Cut::Disk,
            ..Cutting::default()
        },
        ..Options::default()
    };
    let error = unwrap_document(&cube(), &beyond, &Unobserved).unwrap_err();
    assert!(error.to_string().contains("at vertex 8"), "{error}");
}

#[test]
fn edited_uvs_are_judged_in_the_order_of_the_file() {
    // A flat grid whose squares take turns with two materials.
    let mut text = String::new();
    for v in 0..16 {
        let [x, y] = [v % 4, v / 4].map(|i| f64::from(i) / 4.0);
        let _ = writeln!(text, "v {x} {y} 0\nvt {x} {y}");
    }
    for square in 0..9 {
        let a = square % 3 + 4 * (square / 3) + 1;
        let corners = [a, a + 1, a + 5, a + 4].map(|v| format!("{v}/{v}"));
        let _ = writeln!(text, "usemtl m{}\nf {}", square % 2, corners.join(" "));
    }
    for format in [OutputFormat::Obj, OutputFormat::Glb] {
        let options = EditOptions {
            anchors: parse_anchors(br#"{"anchors": [{"vertex": 5, "to": [0.3, 0.28]}]}"#).unwrap(),
            format,
            ..EditOptions::default()
        };
        let upload = Upload::single("grid.obj", text.clone().into_bytes());
        let edited = edit_document(&upload, Editing::Map, &options, &Unobserved).unwrap();
        assert!(edited.report.certified && edited.report.bijective);
        let document = reread(&edited.files);
        let uvs = |p: usize| document.corner_uvs(p, 0).unwrap().unwrap();
        let flip = |v: f64| {
            if format == OutputFormat::Obj {
                v
            } else {
                1.0 - v
            }
        };
        let moved = (0..document.primitives().len()).flat_map(uvs).flatten();
        let near = moved.filter(|[u, v]| (u - 0.3).abs() < 1e-6 && (flip(*v) - 0.28).abs() < 1e-6);
        assert!(near.count() >= 4);
    }
}

#[test]
fn textures_for_an_obj_are_refused_before_any_work() {
    struct Refused;
    impl Observer for Refused {
        fn progress(&self, progress: &Progress) -> Control {
            assert_eq!(progress.stage, Stage::Read);
            Control::Continue
        }
        fn elapsed(&self) -> Duration {
            Duration::ZERO
        }
    }
    let options = Options {
        format: OutputFormat::Obj,
        baking: Baking {
            rebake: true,
            ..Baking::default()
        },
        ..Options::default()
    };
    let error = unwrap_document(&cube(), &options, &Refused).unwrap_err();
    assert_eq!(error.code(), "unsupported_output");
}

//! What "certified" promises, and what is said where it is not; equal meshes that are mapped once.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::{Value, json as object};

use crate::cli::{assert_status, unwrapd};

/// Squares side by side, in a row: an OBJ.
pub fn cards(n: usize) -> String {
    let mut text = String::new();
    for i in 0..n {
        let (x, y) = (3 * i, 3 * i + 1);
        let _ = writeln!(text, "v {x} 0 0\nv {y} 0 0\nv {y} 1 0\nv {x} 1 0");
    }
    for a in (0..n).map(|i| 4 * i + 1) {
        let _ = writeln!(text, "f {a} {} {} {}", a + 1, a + 2, a + 3);
    }
    text
}

/// A glTF of boxes, each a mesh with accessors of its own; `shape` moves its corners.
fn boxes(n: usize, shape: impl Fn(usize, [f32; 3]) -> [f32; 3]) -> Vec<u8> {
    const QUADS: [[u16; 4]; 6] = [
        [0, 1, 3, 2],
        [4, 6, 7, 5],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
    ];
    let (mut bytes, mut views, mut accessors) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..n {
        let corner = |c: usize| [(c >> 2) as f32, (c >> 1 & 1) as f32, (c & 1) as f32];
        let corners: Vec<[f32; 3]> = (0..8).map(|c| shape(i, corner(c))).collect();
        let bound = |pick: fn(f32, f32) -> f32| {
            [0, 1, 2].map(|axis| corners.iter().map(|p| p[axis]).reduce(pick))
        };
        views.push(object!({ "buffer": 0, "byteOffset": bytes.len(), "byteLength": 96 }));
        bytes.extend(corners.iter().flatten().flat_map(|x| x.to_le_bytes()));
        views.push(object!({ "buffer": 0, "byteOffset": bytes.len(), "byteLength": 72 }));
        let triangles = QUADS.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]);
        bytes.extend(triangles.flat_map(u16::to_le_bytes));
        accessors.push(
            object!({ "bufferView": 2 * i, "componentType": 5126, "count": 8, "type": "VEC3",
                                 "min": bound(f32::min), "max": bound(f32::max) }),
        );
        accessors.push(object!({ "bufferView": 2 * i + 1, "componentType": 5123, "count": 36, "type": "SCALAR" }));
    }
    let meshes = (0..n).map(|i| {
        let primitive = object!({ "attributes": { "POSITION": 2 * i }, "indices": 2 * i + 1 });
        object!({ "name": format!("Crate {i}"), "primitives": [primitive] })
    });
    let document = object!({
        "asset": { "version": "2.0" }, "scene": 0,
        "scenes": [{ "nodes": (0..n).collect::<Vec<_>>() }],
        "nodes": (0..n).map(|i| object!({ "mesh": i })).collect::<Vec<_>>(),
        "meshes": meshes.collect::<Vec<_>>(), "accessors": accessors, "bufferViews": views,
        "buffers": [{ "byteLength": bytes.len() }],
    });
    let mut text = document.to_string();
    while !text.len().is_multiple_of(4) {
        text.push(' ');
    }
    let length = |n: usize| (n as u32).to_le_bytes();
    let total = 12 + 8 + text.len() + 8 + bytes.len();
    [
        &b"glTF"[..],
        &length(2),
        &length(total),
        &length(text.len()),
        b"JSON",
        text.as_bytes(),
        &length(bytes.len()),
        b"BIN\0",
        &bytes,
    ]
    .concat()
}

/// Turned about an axis, made so many times as large, and moved.
fn moved(p: [f32; 3], turn: f32, size: f32) -> [f32; 3] {
    let [x, y, z] = [p[0], 1.5 * p[1], 2.0 * p[2]];
    let (sin, cos) = turn.sin_cos();
    [
        size * (cos * x - sin * y) + turn,
        size * (sin * x + cos * y) - 0.5,
        size * z + 0.25,
    ]
}

/// Unwraps, and gives exit status, what was printed, and the report.
fn unwrap(
    folder: &Path,
    input: &[u8],
    name: &str,
    options: &[&str],
) -> (std::process::Output, Value) {
    let path = |name: &str| folder.join(name).to_string_lossy().into_owned();
    std::fs::write(path(name), input).expect("a file");
    let arguments = [
        "unwrap",
        &path(name),
        "-o",
        &path("out.glb"),
        "--report",
        &path("r.json"),
    ];
    let output = unwrapd(&[&arguments, options].concat());
    let report = std::fs::read(path("r.json")).expect("a report");
    (output, serde_json::from_slice(&report).expect("JSON"))
}

#[test]
fn padding_that_is_missed_is_not_certified_but_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let cards = cards(400);
    let (output, report) = unwrap(
        folder.path(),
        cards.as_bytes(),
        "cards.obj",
        &["--resolution", "32"],
    );
    assert_status(&output, 4);
    assert_eq!(report["certified"], false);
    assert_eq!(
        report["warnings"][0]["code"], "padding_missed",
        "{}",
        report["warnings"]
    );
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let reached = report["proven"]["padding"]["reached_texels"]
        .as_f64()
        .expect("a distance");
    for words in [
        "padding of 2 texels at 32",
        &format!("nearest at {reached:.3}"),
        "chart ",
        "not certified, but written: charts closer",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    assert!(!String::from_utf8_lossy(&output.stdout).contains("certified"));
    let out = folder.path().join("out.glb").to_string_lossy().into_owned();
    // The file says what was asked of it; named by its set it is judged by what `verify` is asked alone.
    assert_status(&unwrapd(&["verify", &out, "--bijective"]), 4);
    assert_status(
        &unwrapd(&["verify", &out, "--texcoord", "0", "--bijective"]),
        0,
    );
    assert_status(
        &unwrapd(&["verify", &out, "--padding", "2", "--resolution", "32"]),
        4,
    );
}

#[test]
fn what_repacking_leaves_flipped_is_named_and_not_certified() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    // Two triangles of a square, one of which is folded over in UV.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0.9 0.05\n\
                f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    std::fs::write(path("in.obj"), text).expect("a file");
    let arguments = ["repack", &path("in.obj"), "-o", &path("out.obj")];
    let output = unwrapd(&arguments);
    assert_status(&output, 4);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    for words in [
        "1 triangle flipped",
        "in chart 0",
        "not certified, but written: triangles flipped",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    assert_status(&unwrapd(&["verify", &path("out.obj")]), 4);
}

#[test]
fn a_bound_that_is_missed_is_a_warning_with_value_bound_and_chart() {
    let folder = tempfile::tempdir().expect("a folder");
    let ring = std::fs::read("tests/assets/moebius.obj").expect("an asset");
    let options = ["--max-charts", "1", "--max-distortion", "4.0001"];
    let (output, report) = unwrap(folder.path(), &ring, "ring.obj", &options);
    assert_status(&output, 0);
    assert_eq!(report["certified"], true);
    let bound = &report["groups"][0]["atlas"]["bound"];
    let measured = &report["groups"][0]["measures"]["sym_dirichlet_mean"];
    assert_eq!(
        (&bound["kept"], &bound["distortion"]),
        (&false.into(), measured)
    );
    assert_eq!(bound["worst_chart"]["chart"], 0);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let reached = measured.as_f64().expect("a mean");
    for words in [
        "exceeds the bound of 0.4 %",
        &format!("symmetric Dirichlet {reached:.4}, bound 4.0001"),
        "the worst is chart 0",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn equal_meshes_are_mapped_once_and_summed_up() {
    let folder = tempfile::tempdir().expect("a folder");
    // Equal, equal but for place and size, and one that is no box.
    let shape = |i: usize, p: [f32; 3]| match i {
        0..8 => moved(p, 0.0, 1.0),
        8..14 => moved(p, i as f32, i as f32 / 4.0),
        _ => [p[0] + 0.5 * p[1], p[1], 3.0 * p[2] - p[0]],
    };
    let glb = boxes(15, shape);
    let (output, report) = unwrap(folder.path(), &glb, "boxes.glb", &[]);
    assert_status(&output, 0);
    let groups = report["groups"].as_array().expect("groups");
    let same: Vec<&Value> = groups
        .iter()
        .map(|group| &group["atlas"]["same_as"])
        .collect();
    assert!(same[1..14].iter().all(|name| *name == "mesh0"), "{same:?}");
    assert!(same[0].is_null() && same[14].is_null(), "{same:?}");
    assert_eq!(groups[3]["label"], "Crate 3");
    let density = |i: usize| groups[i]["texels_per_unit"].as_f64().expect("a density");
    assert!((density(12) * 3.0 / density(0) - 1.0).abs() < 1e-4);
    // A head, ten lines, totals, what is certified, and what was written.
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines.len(), 14, "{said}");
    assert!(
        lines[1].starts_with("Crate 0") && lines[10].starts_with("6 others"),
        "{said}"
    );
    assert!(
        lines[11].starts_with("15 atlases") && lines[12].starts_with("certified: "),
        "{said}"
    );
    // Where a density is given only what has the same size has the same atlas.
    let (output, report) = unwrap(
        folder.path(),
        &glb,
        "boxes.glb",
        &["--texels-per-unit", "20"],
    );
    assert_status(&output, 0);
    let groups = report["groups"].as_array().expect("groups");
    assert_eq!(groups[7]["atlas"]["same_as"], "mesh0");
    assert!(groups[8]["atlas"]["same_as"].is_null());
}

#[test]
fn equal_meshes_get_places_of_their_own_in_one_atlas() {
    let folder = tempfile::tempdir().expect("a folder");
    let charts = |n: usize| {
        let glb = boxes(n, |_, p| moved(p, 0.0, 1.0));
        let (output, report) = unwrap(
            folder.path(),
            &glb,
            "boxes.glb",
            &["--group-by", "scene", "--seam-weight", "1e6"],
        );
        assert_status(&output, 0);
        report["groups"][0]["measures"]["charts"]
            .as_u64()
            .expect("a number")
    };
    let (one, five) = (charts(1), charts(5));
    assert_eq!(five, 5 * one);
    let out = folder.path().join("out.glb").to_string_lossy().into_owned();
    assert_status(
        &unwrapd(&[
            "verify",
            &out,
            "--group-by",
            "scene",
            "--bijective",
            "--padding",
            "2",
        ]),
        0,
    );
}

#[test]
fn many_meshes_come_out_the_same_for_any_number_of_threads() {
    let folder = tempfile::tempdir().expect("a folder");
    let glb = boxes(9, |i, p| {
        moved([p[0] + 0.1 * (i % 4) as f32 * p[1], p[1], p[2]], 0.0, 1.0)
    });
    let written = ["1", "2", "3"].map(|threads| {
        let (output, _) = unwrap(folder.path(), &glb, "boxes.glb", &["--threads", threads]);
        assert_status(&output, 0);
        std::fs::read(folder.path().join("out.glb")).expect("a result")
    });
    assert!(written[0] == written[1] && written[1] == written[2]);
}

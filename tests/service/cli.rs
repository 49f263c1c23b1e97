//! The command line: exit statuses, one-line errors, files whole or absent.

use std::process::{Command, Output, Stdio};

use serde_json::json;
use unwrapd::document::{Document, Upload};

pub use crate::places::asset;

pub fn unwrapd(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .args(arguments)
        .output()
        .expect("the binary runs")
}

#[track_caller]
pub fn assert_status(output: &Output, status: i32) {
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{error}");
}

/// The last line of standard error.
pub fn last_error(output: &Output) -> String {
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    error.lines().last().unwrap_or_default().to_owned()
}

#[test]
fn what_is_unwrapped_verifies() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    for (input, output) in [
        ("Box.glb", "box.glb"),
        ("spot.ply", "spot.gltf"),
        ("cat_head.obj", "cat.obj"),
    ] {
        let (input, output) = (asset(input), path(output));
        let (report, layout, heatmap) = (path("r.json"), path("l.png"), path("h.png"));
        let input = input.to_string_lossy();
        let arguments = [
            "unwrap",
            &input,
            "-o",
            &output,
            "--report",
            &report,
            "--layout",
            &layout,
            "--heatmap",
            &heatmap,
        ];
        assert_status(&unwrapd(&arguments), 0);
        let claims = ["--bijective", "--unmirrored", "--padding", "2"];
        assert_status(&unwrapd(&[&["verify", &*output], &claims[..]].concat()), 0);
        assert_status(&unwrapd(&["measure", &output, "--json"]), 0);
        let text = std::fs::read(&report).expect("a report");
        let report: serde_json::Value = serde_json::from_slice(&text).expect("a JSON report");
        assert_eq!(report["certified"], true);
        assert_eq!(report["proven"]["bijective"], true);
        assert_eq!(report["proven"]["padding"]["kept"], true);
        assert_eq!(report["groups"][0]["measures"]["flipped"], 0);
        for picture in [layout, heatmap] {
            let bytes = std::fs::read(picture).expect("a picture");
            assert!(bytes.starts_with(b"\x89PNG"));
        }
    }
}

#[test]
fn where_uvs_went_is_said_and_judged() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let truck = asset("gltf/CesiumMilkTruck-Draco/CesiumMilkTruck.gltf");
    let (truck, first, second) = (truck.to_string_lossy(), path("a.glb"), path("b.glb"));
    for (input, output) in [(&*truck, &first), (&*first, &second)] {
        let run = unwrapd(&["unwrap", input, "-o", output]);
        assert_status(&run, 0);
        let said = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(said.contains("are in UV set 1, because textures"), "{said}");
        let run = unwrapd(&["verify", output, "--bijective"]);
        assert_status(&run, 0);
        let said = String::from_utf8_lossy(&run.stdout).into_owned();
        assert!(said.starts_with("judged: UV set 1, "), "{said}");
        assert!(said.contains("2 texels apart at 1024"), "{said}");
        assert_status(&unwrapd(&["measure", output]), 0);
    }
    let bytes = |path: &str| std::fs::metadata(path).expect("a file").len();
    // Offsets may have more digits than they had.
    assert!(bytes(&second) < bytes(&first) + 64);
    let baked = path("c.gltf");
    assert_status(&unwrapd(&["unwrap", &truck, "-o", &baked, "--rebake"]), 0);
    assert_status(&unwrapd(&["verify", &baked, "--bijective"]), 0);
    let entries = std::fs::read_dir(folder.path()).expect("a folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    let names = names.map(|name| name.to_string_lossy().into_owned());
    let beside: Vec<String> = names.filter(|name| name.starts_with(['c', 'C'])).collect();
    // The old texture is not written, and the new ones are of its format.
    let extension = |name: &String| {
        std::path::Path::new(name)
            .extension()
            .map(ToOwned::to_owned)
    };
    let pictures = beside
        .iter()
        .filter_map(extension)
        .filter(|extension| extension == "jpg");
    assert_eq!(pictures.count(), beside.len() - 2, "{beside:?}");
    assert!(
        beside.iter().all(|name| name.starts_with('c')),
        "{beside:?}"
    );
}

#[test]
fn equal_input_gives_equal_bytes_for_any_number_of_threads() {
    let folder = tempfile::tempdir().expect("a folder");
    let written = |threads: &str| {
        let output = folder.path().join(format!("{threads}.glb"));
        let (input, text) = (asset("spot.ply"), output.to_string_lossy().into_owned());
        let input = input.to_string_lossy();
        assert_status(
            &unwrapd(&["unwrap", &input, "-o", &text, "--threads", threads]),
            0,
        );
        std::fs::read(output).expect("a result")
    };
    let one = written("1");
    assert!(one == written("2") && one == written("4"));
}

#[test]
fn each_kind_of_failure_has_its_exit_status_and_one_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let input = asset("cat_head.obj").to_string_lossy().into_owned();
    std::fs::write(path("points.obj"), "v 0 0 0\nv 1 0 0\n").expect("a file");
    let cases: &[(&[&str], i32, &str)] = &[
        (&["unwrap", &input], 2, ""),
        (
            &["unwrap", &input, "-o", &path("a.fbx")],
            2,
            ".glb, .gltf, .obj",
        ),
        (
            &["unwrap", &input, "-o", &path("a.glb"), "--padding", "9999"],
            2,
            "padding",
        ),
        (
            &[
                "unwrap",
                &input,
                "-o",
                &path("a.glb"),
                "--max-distortion",
                "4",
            ],
            2,
            "--max-distortion must lie between 4.0001 and 1000000, not 4",
        ),
        (
            &["unwrap", &path("absent.glb"), "-o", &path("a.glb")],
            3,
            "absent.glb",
        ),
        (
            &["unwrap", &path("points.obj"), "-o", &path("a.glb")],
            3,
            "no_triangles",
        ),
        (&["measure", &input], 3, "no_uvs"),
    ];
    for (arguments, status, words) in cases {
        let output = unwrapd(arguments);
        assert_status(&output, *status);
        assert!(
            last_error(&output).contains(words),
            "{}",
            last_error(&output)
        );
    }
    let leftovers: Vec<_> = std::fs::read_dir(folder.path())
        .expect("a folder")
        .filter_map(Result::ok)
        .map(|entry| entry.file_name())
        .filter(|name| name != "points.obj")
        .collect();
    assert!(leftovers.is_empty(), "{leftovers:?}");
}

#[test]
fn flipped_uvs_do_not_verify() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("flipped.obj");
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0.9 0.1\n\
                f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    std::fs::write(&path, text).expect("a file");
    let output = unwrapd(&["verify", &path.to_string_lossy()]);
    assert_status(&output, 4);
    assert!(String::from_utf8_lossy(&output.stdout).contains("1 flipped"));
}

#[test]
fn islands_of_a_file_are_repacked_and_verify() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (input, output, report) = (path("in.obj"), path("out.obj"), path("r.json"));
    // Two triangles that lie on top of each other, one of them twice as large.
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 5\nv 1 0 5\nv 0 1 5\n\
                vt 0 0\nvt 4 0\nvt 0 4\nvt 2 0\nvt 0 2\nf 1/1 2/2 3/3\nf 4/1 5/4 6/5\n";
    std::fs::write(&input, text).expect("a file");
    assert_status(&unwrapd(&["verify", &input, "--bijective"]), 4);
    let arguments = ["repack", &input, "-o", &output, "--report", &report];
    assert_status(&unwrapd(&arguments), 0);
    let claims = ["verify", &output, "--bijective", "--padding", "2"];
    assert_status(&unwrapd(&claims), 0);
    let text = std::fs::read(&report).expect("a report");
    let report: serde_json::Value = serde_json::from_slice(&text).expect("a JSON report");
    assert_eq!(report["groups"][0]["measures"]["charts"], 2);
    let texels = &report["groups"][0]["measures"]["density_p95_over_p5"];
    let texels = texels.as_f64().expect("a density");
    assert!(
        (texels - 2.0).abs() < 1e-4,
        "the sizes are as they were: {texels}"
    );
}

#[test]
fn a_chart_that_sets_the_scale_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    // A card of 40 × 1 and a square beside it, with their positions as UVs.
    let mut lines = Vec::new();
    for (x, width) in [(0, 40), (50, 1)] {
        for [u, v] in [[x, 0], [x + width, 0], [x + width, 1], [x, 1]] {
            lines.push(format!("v {u} {v} 0\nvt {u} {v}"));
        }
    }
    lines.push("f 1/1 2/2 3/3 4/4\nf 5/5 6/6 7/7 8/8".to_owned());
    std::fs::write(path("card.obj"), lines.join("\n")).expect("a file");
    let [input, output] = ["card.obj", "out.obj"].map(path);
    let output = unwrapd(&["repack", &input, "-o", &output]);
    assert_status(&output, 0);
    let text = String::from_utf8_lossy(&output.stdout);
    let named = "chart 0 is as long as the texture and sets the scale";
    assert!(text.contains(named), "{text}");
}

#[test]
fn what_is_asked_of_a_file_decides_its_verdict() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("charts.obj");
    // Two triangles 1/256 apart, on the grid, and one of them 1/4096 high.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 5\nv 1 1 5\nv 0 0 5\n\
                vt 0 0\nvt 0.25 0\nvt 0.25 0.5\nvt 0.25390625 0\nvt 0.75 0\nvt 0.75 0.000244140625\n\
                f 1/1 2/2 3/3\nf 4/4 5/5 6/6\n";
    std::fs::write(&path, text).expect("a file");
    let verify = |options: &[&str]| {
        let file = path.to_string_lossy();
        unwrapd(&[&["verify", &*file], options].concat())
    };
    for (options, status) in [
        (&[][..], 0),
        (&["--bijective", "--unmirrored"], 0),
        (&["--padding", "4", "--resolution", "1024"], 0),
        (&["--padding", "5", "--resolution", "1024"], 4),
        (&["--bits", "14"], 0),
        (&["--bits", "12"], 4),
        (&["--bits", "7"], 2),
        (&["--padding", "300", "--resolution", "1024"], 2),
    ] {
        assert_status(&verify(options), status);
    }
    let output = verify(&["--padding", "5", "--bits", "12", "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let proven = &report["proven"];
    assert_eq!(proven["bijective"], true);
    assert_eq!(proven["padding"]["kept"], false);
    assert_eq!(proven["padding"]["reached_texels"], 4.0);
    assert_eq!(proven["bits"]["hold"], false);
    assert_eq!(proven["safe_bits"], 14);
    let certificate = &report["groups"][0]["certificate"];
    assert_eq!(certificate["bits"]["offending_faces"][0], 1);
    assert_eq!(
        certificate["padding"]["offending_faces"][0],
        serde_json::json!([0, 1])
    );
}

#[test]
fn surfaces_are_deformed_in_a_cage() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let input = asset("MultiUVTest.glb").to_string_lossy().into_owned();
    let (handles, report) = (path("handles.json"), path("report.json"));
    let deform = |text: &str, output: &str| {
        std::fs::write(&handles, text).expect("a file");
        unwrapd(&[
            "deform",
            &input,
            "--cage",
            "6",
            "--handles",
            &handles,
            "-o",
            output,
            "--report",
            &report,
        ])
    };
    let everything = r#"{"handles": [{"center": [0, 0, 0], "radius": 1e3, "to": [1, 2, 3]}]}"#;
    assert_status(&deform(everything, &path("out.glb")), 0);
    let text = std::fs::read(&report).expect("a report");
    let report: serde_json::Value = serde_json::from_slice(&text).expect("a JSON report");
    assert_eq!(report["inverted"], 0);
    assert_eq!(report["tets"], 6 * report["voxels"].as_u64().expect("one"));
    assert!(report["surface_vertices"].as_u64() > Some(0));
    assert_eq!(report["crossings_before"]["pairs"], 0);
    assert_eq!(report["crossings_after"]["pairs"], 0);
    // The UVs are those of the input.
    let measured = |file: &str| unwrapd(&["verify", file]).status.code();
    assert_eq!(measured(&path("out.glb")), measured(&input));

    let vertex = r#"{"handles": [{"vertex": 0, "to": [1, 2, 3]}]}"#;
    let output = deform(vertex, &path("none.glb"));
    assert_status(&output, 3);
    assert!(last_error(&output).contains("vertex_of_cage"));
    assert_status(&deform(everything, &path("none.off")), 2);
    assert_status(&deform(everything, &path("none.obj")), 3);
    assert!(!folder.path().join("none.glb").exists());
}

#[test]
fn handles_pull_meshes_and_outlines() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let write = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("a file");
        path(name)
    };
    let drawing = write(
        "plate.svg",
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="60"><rect width="100" height="60"/></svg>"#,
    );
    let handles = write(
        "h.json",
        r#"{"handles": [{"center": [0, 30], "radius": 20, "to": [0, 30]}, {"at": [90, 30], "to": [60, 90]}]}"#,
    );
    let (output, report, trace) = (path("o.obj"), path("r.json"), path("t.csv"));
    let deform = |handles: &str, extra: &[&str]| {
        let arguments = [
            "deform",
            &drawing,
            "--handles",
            handles,
            "-o",
            &output,
            "--triangles",
            "500",
        ];
        unwrapd(&[&arguments, extra].concat())
    };
    assert_status(
        &deform(&handles, &["--report", &report, "--trace", &trace]),
        0,
    );
    let text = std::fs::read(&report).expect("a report");
    let report: serde_json::Value = serde_json::from_slice(&text).expect("JSON");
    assert_eq!(report["status"], "converged");
    assert_eq!(report["inverted"], 0);
    assert!(report["smallest_ever"].as_f64().is_some_and(|s| s > 0.0));
    let lines = std::fs::read_to_string(&trace)
        .expect("a trace")
        .lines()
        .count();
    assert_eq!(
        Some(lines as u64),
        report["iterations"].as_u64().map(|n| n + 2)
    );
    let outside = write(
        "far.json",
        r#"{"handles": [{"at": [900, 30], "to": [60, 90]}]}"#,
    );
    let refused = deform(&outside, &[]);
    assert_status(&refused, 3);
    assert!(last_error(&refused).contains("handle_outside"));
    let hencky = "log(s1)^2 + log(s2)^2";
    assert_status(&deform(&handles, &["--energy", hencky]), 0);
    for wrong in ["guesswork", "s1 - s2"] {
        assert_status(&deform(&handles, &["--energy", wrong]), 2);
    }
}

#[test]
fn every_energy_of_the_plane_unwraps() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = folder.path().join("o.glb").to_string_lossy().into_owned();
    let input = asset("Box.glb").to_string_lossy().into_owned();
    let unwrap = |energy| unwrapd(&["unwrap", &input, "-o", &output, "--energy", energy]);
    for energy in ["mips", "amips", "neo-hookean", "log(s1)^2 + log(s2)^2"] {
        assert_status(&unwrap(energy), 0);
        assert_status(&unwrapd(&["verify", &output, "--bijective"]), 0);
    }
    let spatial = "(s1 - 1)^2 + (s2 - 1)^2 + (s3 - 1)^2";
    for (wrong, cause) in [
        ("laplacian", "the formula does not know `laplacian`"),
        ("s1 - s2", "the energy is not symmetric"),
        (spatial, "the formula does not know"),
    ] {
        let refused = unwrap(wrong);
        assert_status(&refused, 2);
        assert!(last_error(&refused).contains(cause), "{refused:?}");
    }
}

#[test]
fn a_problem_file_is_solved_by_both_methods() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let mesh = "OFF\n6 4 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n";
    std::fs::write(folder.path().join("m.off"), mesh).expect("a mesh");
    let problem = r#"{"mesh": "m.off", "energy": "green", "barrier": "spline", "handles": [0, 3, 2],
        "targets": [[0, 0], [0, 1], [1.5, 0.5]]}"#;
    std::fs::write(folder.path().join("p.json"), problem).expect("a problem");
    let mut energies = Vec::new();
    for method in ["projected", "levenberg"] {
        let (problem, output, report) = (path("p.json"), path("x.txt"), path("r.json"));
        let solved = unwrapd(&[
            "solve", &problem, "-o", &output, "--method", method, "--report", &report,
        ]);
        assert_status(&solved, 0);
        let positions = std::fs::read_to_string(&output).expect("positions");
        assert_eq!(positions.split_ascii_whitespace().count(), 12);
        let text = std::fs::read(&report).expect("a report");
        let report: serde_json::Value = serde_json::from_slice(&text).expect("JSON");
        assert!(report["residual"].as_f64().is_some_and(|r| r < 1e-12));
        energies.push(report["energy"].as_f64().expect("an energy"));
    }
    assert!((energies[0] - energies[1]).abs() < 1e-4 * energies[0]);
    let missing = unwrapd(&["solve", &path("none.json"), "-o", &path("x.txt")]);
    assert_status(&missing, 3);
    let unknown = unwrapd(&["solve", &path("p.json"), "-o", &path("x.xyz")]);
    assert_status(&unknown, 2);
}

/// Handles of a problem file select by what the file of its mesh says; a mesh of another format has nothing to select by.
#[test]
fn handles_of_a_problem_file_select() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let obj = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\no left\nf 1 2 5\nf 1 5 4\no right\nf 2 3 6\nf 2 6 5\n";
    std::fs::write(path("m.obj"), obj).expect("a mesh");
    let off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
    std::fs::write(path("m.off"), off).expect("a mesh");
    let solve = |mesh: &str, object: &str| {
        let problem = format!(
            r#"{{"mesh": "{mesh}", "energy": "arap", "barrier": "spline",
                "handles": [{{"select": "object={object}", "by": [0.25, 0.5]}}, {{"vertex": 0, "to": [0, 0]}}]}}"#
        );
        std::fs::write(path("p.json"), problem).expect("a problem");
        let arguments = ["solve", &path("p.json"), "-o", &path("x.txt"), "--force"];
        unwrapd(&arguments)
    };
    assert_status(&solve("m.obj", "right"), 0);
    let text = std::fs::read_to_string(path("x.txt")).expect("positions");
    let x = text.split_ascii_whitespace().map(str::parse);
    let x: Vec<f64> = x.collect::<Result<_, _>>().expect("numbers");
    assert_eq!([x[4], x[5], x[10], x[11]], [2.25, 0.5, 2.25, 1.5]);
    assert_eq!([x[0], x[1]], [0.0, 0.0]);
    for (mesh, object, code) in [
        ("m.obj", "nowhere", "handle_outside"),
        ("m.off", "right", "malformed_handles"),
    ] {
        let refused = solve(mesh, object);
        assert_status(&refused, 3);
        assert!(last_error(&refused).contains(code), "{refused:?}");
    }
}

/// A square drawn out to twice its width returns to its shape from there.
#[test]
fn without_handles_a_body_is_minimized_from_its_start() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4\nf 1 4 3\n";
    std::fs::write(path("a.obj"), mesh).expect("a mesh");
    std::fs::write(path("start.txt"), "0 0\n2 0\n0 1\n2 1\n").expect("positions");
    let (mesh, start, output) = (path("a.obj"), path("start.txt"), path("o.txt"));
    let deformed = unwrapd(&["deform", &mesh, "--start", &start, "-o", &output]);
    assert_status(&deformed, 0);
    let text = std::fs::read_to_string(&output).expect("positions");
    let x: Vec<f64> = (text.split_ascii_whitespace())
        .map(|word| word.parse().expect("a number"))
        .collect();
    for [a, b] in [[0, 1], [0, 2], [1, 3], [2, 3]] {
        let length = (x[2 * a] - x[2 * b]).hypot(x[2 * a + 1] - x[2 * b + 1]);
        assert!((length - 1.0).abs() < 1e-3, "{text}");
    }
    // Without a start there is nothing to do without handles.
    assert_status(&unwrapd(&["deform", &mesh, "-o", &output, "--force"]), 2);
    std::fs::write(path("start.txt"), "0 0\n2 0\n").expect("positions");
    assert_status(
        &unwrapd(&["deform", &mesh, "--start", &start, "-o", &output, "--force"]),
        3,
    );
}

/// A folded mesh is written without inversions, and what cannot be is refused.
#[test]
fn a_folded_mesh_is_untangled() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let square = |middle: &str| {
        let border = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
        format!("{border}v {middle} 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n")
    };
    let (mesh, output, report) = (path("a.obj"), path("o.txt"), path("r.json"));
    std::fs::write(&mesh, square("3 0.5")).expect("a mesh");
    let run = unwrapd(&["untangle", &mesh, "-o", &output, "--report", &report]);
    assert_status(&run, 0);
    let text = std::fs::read_to_string(&output).expect("positions");
    let middle: Vec<f64> = (text.lines().next_back().expect("a vertex"))
        .split_ascii_whitespace()
        .map(|word| word.parse().expect("a number"))
        .collect();
    assert!(middle.iter().all(|x| (0.01..0.99).contains(x)), "{text}");
    let text = std::fs::read(&report).expect("a report");
    let report: serde_json::Value = serde_json::from_slice(&text).expect("JSON");
    assert_eq!(report["inverted_before"], 1);
    assert_eq!(report["moved"], 1);
    let late = [
        "untangle",
        &mesh,
        "-o",
        &output,
        "--force",
        "--time-budget",
        "0",
    ];
    let late = unwrapd(&late);
    assert_status(&late, 6);
    assert!(last_error(&late).contains("ended_early"), "{late:?}");
    // The border crosses itself: no place of the middle helps.
    let crossed = square("0.5 0.5").replacen("v 1 1 0\nv 0 1 0", "v 0 1 0\nv 1.2 1 0", 1);
    std::fs::write(&mesh, crossed).expect("a mesh");
    assert_status(&unwrapd(&["untangle", &mesh, "-o", &output, "--force"]), 3);
}

#[test]
fn a_picture_is_warped_and_proven() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let picture = asset("pictures/spot.png").to_string_lossy().into_owned();
    let warp = |handles: &str, more: &[&str]| {
        std::fs::write(path("h.json"), handles).expect("a file");
        let (handles, output, report) = (path("h.json"), path("out.png"), path("r.json"));
        let arguments = [
            "warp",
            &picture,
            "--handles",
            &handles,
            "-o",
            &output,
            "--report",
            &report,
        ];
        let run = unwrapd(&[&arguments[..], more].concat());
        let text = std::fs::read(&report).unwrap_or_default();
        let report: serde_json::Value = serde_json::from_slice(&text).unwrap_or_default();
        (run, report)
    };
    let pulled = r#"{"handles": [{"at": [300, 300], "to": [500, 400]}, {"at": [900, 400], "to": [800, 200]}]}"#;
    let (run, report) = warp(pulled, &["--fix-border"]);
    assert_status(&run, 0);
    assert_eq!(report["bijective"], true);
    assert_eq!(report["status"], "converged");
    assert!(report["residual"].as_f64().is_some_and(|r| r < 1e-9));
    let bytes = std::fs::read(path("out.png")).expect("a picture");
    assert!(bytes.starts_with(b"\x89PNG"));

    // Two places change: without a barrier the picture folds.
    let crossed = r#"{"handles": [{"at": [500, 300], "to": [800, 300]}, {"at": [800, 300], "to": [500, 300]}]}"#;
    let (run, report) = warp(crossed, &["--fix-border", "--grid=20", "--barrier=none"]);
    assert_status(&run, 4);
    assert_eq!(report["bijective"], false);
    let (run, report) = warp(crossed, &["--fix-border", "--grid=20"]);
    assert_status(&run, 0);
    assert_eq!(report["bijective"], true);

    // A place beyond the border that stays, and one that can be reached.
    let beyond = r#"{"handles": [{"at": [500, 300], "to": [-90, 300]}, {"at": [800, 300], "to": [780, 330]}]}"#;
    let (run, report) = warp(beyond, &["--fix-border", "--grid=20"]);
    assert_status(&run, 5);
    assert_eq!(
        (&report["bijective"], &report["status"]),
        (&true.into(), &"targets-unreachable".into())
    );
    let unreached = report["unreached"].as_array().expect("handles");
    assert_eq!(unreached.len(), 1);
    assert_eq!(unreached[0]["handle"], 0);
    let distance = unreached[0]["distance"].as_f64();
    assert!(distance.is_some_and(|pixels| pixels > 90.0), "{distance:?}");
    assert_eq!(report["warnings"][0]["code"], "targets_unreachable");

    for (handles, more, words) in [
        ("{}", "--grid=8", "malformed_handles"),
        (r#"{"handles": []}"#, "--grid=8", "handle_count"),
        (crossed, "--beta=-1", "bad_parameter"),
        (crossed, "--grid=1000", "invalid_setting"),
    ] {
        let (run, _) = warp(handles, &[more]);
        assert_status(&run, 3);
        assert!(last_error(&run).contains(words), "{}", last_error(&run));
    }
}

#[test]
fn an_end_before_all_is_done_has_its_exit_status() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let text = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1.1 0\nv 2 1 0\nf 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\n";
    std::fs::write(path("a.obj"), text).expect("a mesh");
    let handles = |to: f64| {
        format!(
            r#"{{"handles": [{{"vertex": 0, "to": [0, 0]}}, {{"vertex": 2, "to": [{to:e}, 1]}}]}}"#
        )
    };
    let deform = |to: f64, more: &[&str]| {
        std::fs::write(path("h.json"), handles(to)).expect("handles");
        let (mesh, handles, output, report) =
            (path("a.obj"), path("h.json"), path("o.txt"), path("r.json"));
        let arguments = [
            "deform",
            &mesh,
            "--handles",
            &handles,
            "-o",
            &output,
            "--report",
            &report,
            "--force",
        ];
        let run = unwrapd(&[&arguments[..], more].concat());
        let text = std::fs::read(&report).unwrap_or_else(|_| b"null".to_vec());
        let report: serde_json::Value = serde_json::from_slice(&text).expect("JSON");
        (run, report)
    };
    let (run, report) = deform(3.0, &[]);
    assert_status(&run, 0);
    assert_eq!(report["completion"], "complete");
    let (run, report) = deform(3.0, &["--time-budget", "1e-9"]);
    assert_status(&run, 6);
    assert_eq!(report["completion"], "ended-early");
    let warnings = report["warnings"].as_array().expect("warnings");
    let codes: Vec<&str> = warnings
        .iter()
        .filter_map(|warning| warning["code"].as_str())
        .collect();
    assert_eq!(codes, ["ended_early", "targets_missed"]);
    for far in [1e154, 1e300] {
        let (run, _) = deform(far, &[]);
        assert_status(&run, 3);
        assert!(last_error(&run).contains("bad_target"));
    }
}

#[test]
fn uvs_of_a_file_are_edited_and_proven() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let spot = asset("spot.ply").to_string_lossy().into_owned();
    let report = |name: &str| -> serde_json::Value {
        let text = std::fs::read(path(name)).expect("a report");
        serde_json::from_slice(&text).expect("JSON")
    };
    // Two faces far apart in the file, each pulled by half a texel: no chart comes upon another.
    let anchors = |file: &str| {
        let bytes = std::fs::read(file).expect("a file");
        let document = Document::read(&Upload::single(file, bytes)).expect("a mesh");
        let uvs = document.corner_uvs(0, 0).expect("a set").expect("UVs");
        let anchor = |face: usize| {
            let middle = |k: usize| uvs[face].iter().map(|uv| uv[k]).sum::<f64>() / 3.0;
            let [u, v] = [middle(0), middle(1)];
            json!({"at": [u, v], "to": [u + 5e-4, v]})
        };
        json!({"anchors": [anchor(0), anchor(uvs.len() / 2)]}).to_string()
    };
    for (first, second) in [("a.glb", "b.glb"), ("a.obj", "b.obj"), ("a.glb", "c.obj")] {
        let (first, second) = (path(first), path(second));
        assert_status(&unwrapd(&["unwrap", &spot, "-o", &first]), 0);
        std::fs::write(path("a.json"), anchors(&first)).expect("a file");
        for command in [["edit-uv", "--anchors"], ["texture-map", "--points"]] {
            let [command, option] = command;
            let run = unwrapd(&[
                command,
                &first,
                "-o",
                &second,
                option,
                &path("a.json"),
                "--boundary=free",
                "--report",
                &path("r.json"),
            ]);
            // Charts that take the shapes of the surface again may come upon others: the report and `verify` agree.
            let report = report("r.json");
            assert_eq!(report["proven"]["locally_injective"], true);
            assert_eq!(report["charts"][0]["inverted"], 0);
            let is_certified = report["certified"] == true;
            assert!(is_certified || command == "texture-map", "{report}");
            assert_status(&run, if is_certified { 0 } else { 4 });
            let verified = unwrapd(&["verify", &second, "--bijective"]);
            assert_status(&verified, if is_certified { 0 } else { 4 });
        }
    }
    let anchors = anchors(&path("a.glb"));
    let anchors = anchors.as_str();
    for (text, input, words) in [
        ("{}", path("a.glb"), "malformed_handles"),
        (r#"{"anchors": []}"#, path("a.glb"), "handle_count"),
        (anchors, spot.clone(), "no_uvs"),
    ] {
        std::fs::write(path("a.json"), text).expect("a file");
        let (anchors, output) = (path("a.json"), path("d.glb"));
        let run = unwrapd(&["edit-uv", &input, "-o", &output, "--anchors", &anchors]);
        assert_status(&run, 3);
        assert!(last_error(&run).contains(words), "{}", last_error(&run));
    }
}

#[test]
fn islands_stay_where_a_file_puts_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (mapped, output, islands) = (path("a.glb"), path("b.glb"), path("i.json"));
    let spot = asset("spot.ply").to_string_lossy().into_owned();
    assert_status(&unwrapd(&["unwrap", &spot, "-o", &mapped]), 0);
    let repack = ["repack", &mapped, "-o", &output, "--islands", &islands];
    std::fs::write(&islands, r#"{"islands": [{"face": 0}]}"#).expect("a file");
    assert_status(&unwrapd(&repack), 0);
    assert_status(&unwrapd(&["verify", &output, "--bijective"]), 0);
    for (text, code, words) in [
        ("[]", 3, "i.json"),
        (r#"{"islands": [{"face": -1}]}"#, 3, "i.json"),
        (r#"{"islands": [{"face": 0, "moves": [0, 0]}]}"#, 3, "moves"),
        (
            r#"{"islands": [{"face": 0, "scale": 0}]}"#,
            2,
            "islands[0].scale",
        ),
        (r#"{"islands": [{"face": 100000}]}"#, 3, "(unknown_face)"),
        (
            r#"{"islands": [{"face": 0}, {"face": 0}]}"#,
            3,
            "islands 0 and 1 are the same one",
        ),
    ] {
        std::fs::write(&islands, text).expect("a file");
        let run = unwrapd(&repack);
        assert_status(&run, code);
        assert!(last_error(&run).contains(words), "{}", last_error(&run));
    }
}

/// The example of the guide does what the guide says.
#[test]
fn rules_of_the_guide_hold_for_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    // Squares of side .2 in UV and 2 in space, of four materials; two of them are red.
    let mut lines = Vec::new();
    let materials = ["glass", "wood", "wood", "trim", "hero"];
    for (k, material) in materials.iter().enumerate() {
        let color = if matches!(k, 1 | 2) { "1 0 0" } else { "1 1 1" };
        for [x, y] in [[0, 0], [1, 0], [1, 1], [0, 1]] {
            lines.push(format!("v {} {} 0 {color}", 2 * x + 3 * k, 2 * y));
            let [u, v] = [
                x as f64 + (k % 4) as f64 * 1.1,
                y as f64 + (k / 4) as f64 * 1.1,
            ];
            lines.push(format!("vt {} {}", 0.05 + 0.2 * u, 0.05 + 0.2 * v));
        }
        let n = |corner: usize| 4 * k + corner;
        lines.push(format!(
            "usemtl {material}\nf {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n",
            n(1),
            n(2),
            n(3),
            n(4)
        ));
    }
    let names = ["IN.obj", "OUT.obj", "report.json"].map(|name| (name, path(name)));
    std::fs::write(&names[0].1, lines.join("\n")).expect("a file");
    // Run the command as it is written.
    let guide = include_str!("../../src/cli/guide.md");
    let command = guide
        .split("```sh\n")
        .find(|block| block.starts_with("unwrapd repack IN.obj"));
    let command = command
        .and_then(|block| block.split("```").next())
        .expect("an example");
    let words = command.replace("\\\n", " ");
    let words = words
        .trim()
        .split('\'')
        .enumerate()
        .flat_map(|(k, part)| match k % 2 {
            0 => part
                .split_whitespace()
                .map(str::to_owned)
                .collect::<Vec<_>>(),
            _ => vec![part.to_owned()],
        });
    let words: Vec<String> = words
        .skip(1)
        .map(|word| {
            names
                .iter()
                .find(|(name, _)| *name == word)
                .map_or(word, |(_, path)| path.clone())
        })
        .collect();
    let run = unwrapd(&words.iter().map(String::as_str).collect::<Vec<_>>());
    assert_status(&run, 0);
    let told = String::from_utf8_lossy(&run.stdout);
    assert!(
        told.contains("material=hero: density 400: 1 island, 400.0"),
        "{told}"
    );
    // Judge what it wrote.
    let bytes = std::fs::read(&names[1].1).expect("a file");
    let document = Document::read(&Upload::single("OUT.obj", bytes)).expect("a file");
    let faces = document.corner_uvs(0, 0).expect("a set").expect("UVs");
    let [a, b, c] = faces[0].map(|uv| uv.map(|x| x as f32));
    assert_eq!([a, b, c], [[0.05, 0.05], [0.25, 0.05], [0.25, 0.25]]);
    let apart = |f: usize, g: usize| {
        (faces[f][0][0] - faces[g][0][0]).hypot(faces[f][0][1] - faces[g][0][1])
    };
    let side = |f: usize| (faces[f][0][0] - faces[f][1][0]).hypot(faces[f][0][1] - faces[f][1][1]);
    assert!(
        (apart(2, 4) / side(2) - 1.1).abs() < 1e-4,
        "{}",
        apart(2, 4) / side(2)
    );
    assert!(faces[6..8].as_flattened().iter().all(|uv| uv[1] > 0.75));
    assert!(faces[8..10].as_flattened().iter().all(|uv| uv[0] > 1.0));
    assert!((side(8) * 1024.0 / 2.0 / 400.0 - 1.0).abs() < 1e-3);
    let report = std::fs::read(&names[2].1).expect("a report");
    let report: serde_json::Value = serde_json::from_slice(&report).expect("JSON");
    let rules = report["groups"][0]["rules"].as_array().expect("rules");
    assert_eq!(rules.len(), 5);
    assert_eq!(rules[4]["changed"].as_array().map(Vec::len), Some(1));
    // What cannot be done is one line and an exit status.
    for (rule, status, words) in [
        ("material=brass: lock", 3, "(unknown_material)"),
        ("color=00ff00: lock", 3, "(selects_nothing)"),
        ("material=trim: in nowhere", 2, "no --rectangle \"nowhere\""),
        ("material=trim: hide", 2, "no action"),
    ] {
        let run = unwrapd(&[
            "repack",
            &names[0].1,
            "-o",
            &path("no.obj"),
            "--control",
            rule,
        ]);
        assert_status(&run, status);
        let error = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(error.contains(words), "{error}");
    }
}

/// Borders of new islands are straightened unless that is declined; named islands that stay bent are reported.
#[test]
fn borders_become_straight_as_asked() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    // A belt around a cone.
    let mut lines = Vec::new();
    for i in 0..=12_u32 {
        let (sin, cos) = (f64::from(i) / 8.0).sin_cos();
        for r in [3.6, 4.0] {
            lines.push(format!("v {} {} {}", r * cos, r * sin, r / 2.0));
        }
    }
    lines.extend((0..12).map(|i| {
        let a = 2 * i + 1;
        format!("f {a} {} {} {}", a + 1, a + 3, a + 2)
    }));
    std::fs::write(path("belt.obj"), lines.join("\n")).expect("a file");
    let [input, output] = ["belt.obj", "out.obj"].map(path);
    let with = |more: &[&str]| unwrapd(&[&["unwrap", &input, "-o", &output], more].concat());
    let uvs = |more: &[&str]| {
        assert_status(&with(more), 0);
        let text = std::fs::read_to_string(&output).expect("a file");
        let uvs = text.lines().filter(|line| line.starts_with("vt "));
        uvs.map(str::to_owned).collect::<Vec<_>>()
    };
    let loose = ["--max-distortion", "4.5"];
    let bent = uvs(&[&loose[..], &["--straighten", "off"]].concat());
    assert_ne!(uvs(&[&loose[..], &["--straighten", "all"]].concat()), bent);
    let run = with(&["--straighten", "all", "--max-distortion", "4.001"]);
    assert_status(&run, 0);
    let text = String::from_utf8_lossy(&run.stderr);
    assert!(text.contains("keeps a bent border"), "{text}");
    let run = with(&["--straighten", "sideways"]);
    assert_status(&run, 2);
    let text = String::from_utf8_lossy(&run.stderr);
    assert!(text.contains("auto"), "{text}");
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .arg("openapi")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary runs");
    drop(child.stdout.take());
    assert_status(&child.wait_with_output().expect("an end"), 0);
}

//! The command line: exit statuses, one-line errors, files whole or absent.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/assets")
        .join(name)
}

fn unwrapd(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .args(arguments)
        .output()
        .expect("the binary runs")
}

#[track_caller]
fn assert_status(output: &Output, status: i32) {
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{error}");
}

/// The last line of standard error.
fn last_error(output: &Output) -> String {
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
        assert_status(&unwrapd(&["verify", &output]), 0);
        assert_status(&unwrapd(&["measure", &output, "--json"]), 0);
        let text = std::fs::read(&report).expect("a report");
        let report: serde_json::Value = serde_json::from_slice(&text).expect("a JSON report");
        assert_eq!(report["certified"], true);
        assert_eq!(report["groups"][0]["measures"]["flipped"], 0);
        for picture in [layout, heatmap] {
            let bytes = std::fs::read(picture).expect("a picture");
            assert!(bytes.starts_with(b"\x89PNG"));
        }
    }
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
            ".glb, .gltf or .obj",
        ),
        (
            &["unwrap", &input, "-o", &path("a.glb"), "--padding", "9999"],
            2,
            "padding",
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

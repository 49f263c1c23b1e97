//! Surfaces whose triangles are cut at the cells of their cage.

use serde_json::Value;

use crate::cli::{asset, unwrapd};

/// What `measure` says of the first atlas of a file.
fn measures(file: &str) -> Value {
    let run = unwrapd(&["measure", file, "--json"]);
    let report: Value = serde_json::from_slice(&run.stdout).expect("JSON");
    report["groups"][0]["measures"].clone()
}

#[test]
fn attributes_of_cut_triangles_are_interpolated() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    // A shift alone: whatever is interpolated right measures as before.
    let shift = r#"{"handles": [{"center": [0, 0, 0], "radius": 1e3, "to": [1, 2, 3]}]}"#;
    std::fs::write(path("h.json"), shift).expect("a file");
    let split = |name: &str| {
        let (input, handles) = (asset(name).to_string_lossy().into_owned(), path("h.json"));
        let output = path("out.glb");
        let run = unwrapd(&[
            "deform",
            &input,
            "--cage=5",
            "--split",
            "--handles",
            &handles,
            "-o",
            &output,
        ]);
        (input, output, run)
    };
    let (input, output, run) = split("MultiUVTest.glb");
    assert_eq!(run.status.code(), Some(0), "{run:?}");
    let (before, after) = (measures(&input), measures(&output));
    let number = |m: &Value, name: &str| m[name].as_f64().expect("a number");
    assert!(
        number(&after, "faces") > 2.0 * number(&before, "faces"),
        "{after}"
    );
    for name in ["area_3d", "sym_dirichlet_mean", "sym_dirichlet_max"] {
        let (before, after) = (number(&before, name), number(&after, name));
        assert!(
            (after - before).abs() < 1e-3 * before,
            "{name}: {before} {after}"
        );
    }

    for name in ["SimpleMorph.gltf", "SimpleSkin.gltf"] {
        let (_, _, run) = split(name);
        assert_eq!(run.status.code(), Some(3), "{name}: {run:?}");
        assert!(
            String::from_utf8_lossy(&run.stderr).contains("(indivisible)"),
            "{name}: {run:?}"
        );
    }
}

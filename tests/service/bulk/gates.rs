//! Gates: what assets must be, and how that is written.

use unwrapd::jobs::{GateError, Gates};

use super::Folders;
use crate::cli::{assert_status, asset};

#[test]
fn gates_name_the_part_that_is_wrong() {
    let value = |part: &str, expected| GateError::Value {
        part: part.to_owned(),
        expected,
    };
    let (count, number) = ("a whole number", "a number, 0 or more");
    for (text, error) in [
        ("", GateError::Unknown(String::new())),
        ("certified,,written", GateError::Unknown(String::new())),
        (
            "certified,max-charts=3",
            GateError::Unknown("max-charts=3".to_owned()),
        ),
        ("max_charts", value("max_charts", count)),
        ("written, max_charts=1.5", value("max_charts=1.5", count)),
        ("max_distortion=NaN", value("max_distortion=NaN", number)),
        ("max_seconds=-1", value("max_seconds=-1", number)),
        (
            "certified=yes",
            GateError::NoValue("certified=yes".to_owned()),
        ),
    ] {
        assert_eq!(text.parse::<Gates>(), Err(error), "{text}");
    }
    let run = Folders::of(1).batch(&["--accept", "certified,max_charts=few"]);
    assert_status(&run, 2);
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(
        said.contains("\"max_charts=few\" needs a whole number"),
        "{said}"
    );
}

#[test]
fn the_exit_status_is_decided_by_the_gates() {
    let folders = Folders::with(&["one.obj"]);
    // Two triangles without a common vertex are two charts.
    let two = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf 1 2 3\nf 4 5 6\n";
    folders.write("in/two.obj", two);
    for (gates, status, accepted) in [
        ("certified", 0, 2),
        ("max_charts=2,certified", 0, 2),
        ("max_charts=1", 4, 1),
        ("max_charts=0", 4, 0),
        (
            "max_distortion=4.01, max_stretch=1.1, max_seconds=1e6",
            0,
            2,
        ),
        ("max_distortion=3.9", 4, 0),
        ("max_symmetric_dirichlet=3.9", 4, 0),
        ("max_stretch=0.9", 4, 0),
        ("max_seconds=0", 4, 0),
    ] {
        assert_status(&folders.batch(&["--accept", gates]), status);
        let rows = folders.summary("summary.csv");
        let count = rows
            .values()
            .filter(|row| row["accepted"] == "true")
            .count();
        assert_eq!(count, accepted, "{gates}");
    }
    // Not certified, but written: the padding leaves no room for so many charts.
    folders.write("in/bad.obj", "v 0 0 0\n");
    assert_status(&folders.batch(&["--accept", "written"]), 4);
}

#[test]
fn what_is_not_certified_is_written_and_told() {
    let folders = Folders::of(1);
    let bare = ["--barrier", "none", "--cut", "disk"];
    let run = |gates| folders.batch(&[&bare[..], &["--accept", gates]].concat());
    let status = run("certified").status.code();
    let row = folders.summary("summary.csv")["000.obj"].clone();
    assert_eq!(row["status"], "written");
    assert_eq!(status == Some(0), row["certified"] == "true");
    assert_status(&run("written"), 0);
}

/// What `unwrap` ends with 7 for is told apart in the summary.
#[test]
fn what_is_partly_done_is_told_apart() {
    let folders = Folders::with(&["plain.obj"]);
    for name in ["22_vertex_color.gltf", "22_vertex_color.bin"] {
        let from = asset(&format!("gltf/22_vertex_color/{name}"));
        std::fs::copy(from, folders.path(&format!("in/{name}"))).expect("copied");
    }
    // Colors at vertices are not resampled.
    assert_status(&folders.batch(&["--rebake"]), 0);
    let summary = folders.summary("summary.csv");
    let told = |name: &str| summary[name]["partly_done"].as_str();
    assert_eq!(told("22_vertex_color.gltf"), "true");
    assert_eq!(told("plain.obj"), "false");
}

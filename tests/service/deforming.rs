//! The command line's deformations: what is preserved, frames, switches.

use std::path::PathBuf;
use std::process::Output;

use serde_json::Value;
use unwrapd::document::{Document, Upload};

use crate::cli::{assert_status, asset, unwrapd};

/// Two squares beside each other at z = 2, two triangles each.
const PLATE: &str = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n\
    element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 2\n1 0 2\n2 0 2\n0 1 2\n1 1 2\n2 1 2\n\
    3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n";

/// Its left edge stays, a corner goes up.
const PULL: &str = r#"{"handles": [{"at": [0, 0], "to": [0, 0]}, {"at": [0, 1], "to": [0, 1]}, {"at": [2, 0], "to": [2.5, 0.5]}]}"#;

/// The same with the corner pushed in, so that triangles feel the barrier.
const PUSH: &str = r#"{"handles": [{"at": [0, 0], "to": [0, 0]}, {"at": [0, 1], "to": [0, 1]}, {"at": [2, 0], "to": [0.8, 0.5]}]}"#;

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_string_lossy().into_owned()
    }

    fn write(&self, name: &str, text: &str) -> String {
        std::fs::write(self.0.path().join(name), text).expect("a file");
        self.path(name)
    }

    fn report(&self) -> Value {
        let text = std::fs::read(self.path("report.json")).expect("a report");
        serde_json::from_slice(&text).expect("JSON")
    }

    /// Runs `deform` with a report and frames.
    fn deform(&self, input: &str, handles: &str, output: &str, extra: &[&str]) -> Output {
        let handles = self.write("handles.json", handles);
        let (output, report, frames) = (
            self.path(output),
            self.path("report.json"),
            self.path("frames"),
        );
        let arguments = [
            "deform",
            input,
            "--handles",
            &handles,
            "-o",
            &output,
            "--report",
            &report,
            "--frames",
            &frames,
        ];
        unwrapd(&[&arguments, extra].concat())
    }

    fn frames(&self) -> Vec<PathBuf> {
        let entries = std::fs::read_dir(self.path("frames")).expect("frames");
        let mut paths: Vec<_> = entries.map(|entry| entry.expect("a file").path()).collect();
        paths.sort();
        paths
    }
}

fn document(path: &str) -> Document {
    let bytes = std::fs::read(path).expect("a file");
    Document::read(&Upload::single("a.glb", bytes)).expect("a document")
}

fn positions(document: &Document) -> Vec<[f32; 3]> {
    let primitives = document.primitives().iter();
    primitives.flat_map(|p| p.positions.clone()).collect()
}

/// The frames are those of every iteration, and the last shows the result.
#[track_caller]
fn assert_frames(folder: &Folder, result: &Document) {
    let frames = folder.frames();
    let iterations = folder.report()["iterations"].as_u64();
    assert_eq!(Some(frames.len() as u64), iterations.map(|n| n + 1));
    let last = document(&frames[frames.len() - 1].to_string_lossy());
    assert_eq!(positions(&last), positions(result));
}

#[test]
fn a_planar_document_keeps_everything_but_its_positions() {
    let folder = Folder::new();
    let (plate, unwrapped) = (folder.write("plate.ply", PLATE), folder.path("plate.glb"));
    assert_status(&unwrapd(&["unwrap", &plate, "-o", &unwrapped]), 0);
    assert_status(&folder.deform(&unwrapped, PULL, "moved.glb", &[]), 0);
    let (before, after) = (document(&unwrapped), document(&folder.path("moved.glb")));
    let uvs = |document: &Document| document.corner_uvs(0, 0).expect("a set");
    assert!(uvs(&before).is_some());
    assert_eq!(uvs(&before), uvs(&after));
    assert_eq!(
        before.primitives()[0].triangles,
        after.primitives()[0].triangles
    );
    for (from, to) in positions(&before).into_iter().zip(positions(&after)) {
        let goal = if from == [2.0, 0.0, 2.0] {
            Some([2.5, 0.5, 2.0])
        } else {
            (from[0] == 0.0).then_some(from)
        };
        assert_eq!(to[2], 2.0);
        if let Some(goal) = goal {
            assert!(
                (0..3).all(|k| (to[k] - goal[k]).abs() < 1e-5),
                "{from:?} {to:?}"
            );
        }
    }
    assert_frames(&folder, &after);

    // What is without a document becomes none, and frames are single files.
    assert_status(&folder.deform(&plate, PULL, "moved.glb", &[]), 0);
    assert_status(&folder.deform(&unwrapped, PULL, "moved.gltf", &[]), 2);
    let drawing = folder.write(
        "plate.svg",
        r#"<svg xmlns="http://www.w3.org/2000/svg"><rect width="2" height="1"/></svg>"#,
    );
    assert_status(&folder.deform(&drawing, PULL, "none.glb", &[]), 2);
}

#[test]
fn surfaces_in_a_cage_have_frames() {
    let folder = Folder::new();
    let input = asset("MultiUVTest.glb").to_string_lossy().into_owned();
    let everything = r#"{"handles": [{"center": [0, 0, 0], "radius": 1e3, "to": [1, 2, 3]}]}"#;
    assert_status(
        &folder.deform(&input, everything, "moved.glb", &["--cage", "4"]),
        0,
    );
    assert_frames(&folder, &document(&folder.path("moved.glb")));
}

#[test]
fn a_weaker_barrier_costs_less_and_its_bias_is_reported() {
    let folder = Folder::new();
    let plate = folder.write("plate.ply", PLATE);
    let energies = |switches: &[&str]| {
        let model = ["--energy", "green"];
        assert_status(
            &folder.deform(&plate, PUSH, "moved.obj", &[&model, switches].concat()),
            0,
        );
        let report = folder.report();
        (
            report["energy"].as_f64().expect("an energy"),
            report["energy_without_barrier"].as_f64(),
        )
    };
    let (energy, none) = energies(&[]);
    assert!(energy > 0.0 && none.is_none());
    let (with_bias, free) = energies(&["--bias"]);
    assert_eq!(with_bias, energy);
    assert!(free.is_some_and(|free| free < energy), "{free:?} {energy}");
    let (lowered, free) = energies(&["--barrier-continuation", "--bias"]);
    assert!(lowered < energy);
    assert!(
        free.is_some_and(|free| free <= lowered),
        "{free:?} {lowered}"
    );
}

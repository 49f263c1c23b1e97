//! Runs that follow others do what is missing, and nothing twice.

use std::fs;

use super::{Folders, mesh};
use crate::cli::{assert_status, unwrapd};
use crate::meshes;
use unwrapd::bulk::RunScratch;

#[test]
fn outputs_mirror_the_folder_and_a_second_run_does_nothing() {
    let folders = Folders::with(&["a.obj", "deep/er/a.obj", ".hidden.obj", "notes.txt"]);
    assert_status(&folders.batch(&["--report", "--layout"]), 0);
    let outputs = [
        "a.glb",
        "a.layout.png",
        "a.report.json",
        "deep/er/a.glb",
        "deep/er/a.layout.png",
        "deep/er/a.report.json",
    ];
    assert_eq!(folders.outputs(), outputs);
    for output in ["out/a.glb", "out/deep/er/a.glb"] {
        assert_status(&unwrapd(&["verify", &folders.text(output)]), 0);
    }
    let report = fs::read(folders.path("out/a.report.json")).expect("a report");
    let report: serde_json::Value = serde_json::from_slice(&report).expect("JSON");
    assert_eq!(report["certified"], true);
    let summary = folders.summary("summary.csv");
    assert_eq!(summary["a.obj"]["status"], "written");
    assert_eq!(summary["deep/er/a.obj"]["charts"], "1");

    let before = folders.written();
    let again = folders.batch(&["--report", "--layout"]);
    assert_status(&again, 0);
    assert_eq!(folders.written(), before);
    assert_eq!(folders.summary("summary.csv"), summary);
    assert!(String::from_utf8_lossy(&again.stdout).contains("0 done now, 2 before"));
}

#[test]
fn what_changed_or_went_away_is_done_again_and_nothing_else() {
    let folders = Folders::of(3);
    assert_status(&folders.batch(&[]), 0);
    let changed = |change: &dyn Fn(), arguments: &[&str]| {
        let before = folders.written();
        change();
        assert_status(&folders.batch(arguments), 0);
        let after = folders.written();
        let records = after
            .keys()
            .filter(|name| name.starts_with(".unwrapd/records"));
        let changed = records.filter(|name| before.get(*name) != after.get(*name));
        changed.cloned().collect::<Vec<_>>()
    };
    let record = |name: &str| format!(".unwrapd/records/{name}.glb.json");
    let input = || folders.write("in/001.obj", &mesh(17));
    assert_eq!(changed(&input, &[]), [record("001")]);
    let output = || fs::remove_file(folders.path("out/002.glb")).expect("a file");
    assert_eq!(changed(&output, &[]), [record("002")]);
    let new = || folders.write("in/003.obj", &mesh(18));
    assert_eq!(changed(&new, &[]), [record("003")]);
    assert_eq!(changed(&|| (), &["--padding", "3"]).len(), 4);
    // Results do not depend on threads and gates.
    let same = ["--padding", "3", "--threads", "1", "--accept", "written"];
    assert!(changed(&|| (), &same).is_empty());
}

#[test]
fn what_was_cut_short_is_done_again_where_it_has_more_time() {
    let folders = Folders::with(&[]);
    fs::write(folders.path("in/a.glb"), meshes::hills(100)).expect("a file");
    let within = |seconds: &str| {
        let run = folders.batch(&["--cut", "disk", "--asset-seconds", seconds]);
        assert_status(&run, 0);
        let said = String::from_utf8_lossy(&run.stdout).into_owned();
        said.contains("1 done now")
    };
    assert!(within("0.02"));
    assert!(!within("0.02"));
    assert!(!within("0.01"));
    assert!(within("0.03"));
    assert!(!within("0.03"));
}

#[test]
fn an_output_does_not_outlive_its_input() {
    let folders = Folders::of(2);
    assert_status(&folders.batch(&[]), 0);
    folders.write("in/001.obj", "v 0 0 0\n");
    assert_status(&folders.batch(&[]), 4);
    assert_eq!(folders.outputs(), ["000.glb"]);
    folders.write("in/001.obj", &mesh(1));
    assert_status(&folders.batch(&[]), 0);
    assert_eq!(folders.outputs(), ["000.glb", "001.glb"]);
}

#[test]
fn files_that_belong_to_an_output_count_as_its_input() {
    let folders = Folders::with(&[]);
    let text = |color: &str| format!("newmtl m\nKd {color}\n");
    folders.write("in/a.obj", &format!("mtllib m.mtl\nusemtl m\n{}", mesh(0)));
    folders.write("in/m.mtl", &text("1 0 0"));
    assert_status(&folders.batch(&["--format", "gltf"]), 0);
    assert_eq!(folders.outputs(), ["a.bin", "a.gltf"]);
    let before = folders.written();
    assert_status(&folders.batch(&["--format", "gltf"]), 0);
    assert_eq!(folders.written(), before);
    folders.write("in/m.mtl", &text("0 1 0"));
    assert_status(&folders.batch(&["--format", "gltf"]), 0);
    assert_ne!(folders.written()["a.gltf"], before["a.gltf"]);
}

/// A run that begins takes no folder for abandoned that another one is just making.
#[test]
fn scratch_folders_made_at_once_stay() {
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for _ in 0..200 {
                    let scratch = RunScratch::new().expect("a folder");
                    scratch.folder(0).expect("a subfolder");
                }
            });
        }
    });
}

#[test]
fn two_runs_at_once_leave_whole_outputs() {
    let folders = Folders::of(4);
    let runs = [0, 1].map(|_| {
        let mut command = folders.command(&["--quiet"]);
        command.spawn().expect("the binary runs")
    });
    for mut run in runs {
        assert!(run.wait().expect("an end").success());
    }
    assert_eq!(folders.outputs().len(), 4);
    assert_eq!(folders.summary("summary.csv").len(), 4);
    let before = folders.written();
    assert_status(&folders.batch(&[]), 0);
    assert_eq!(folders.written(), before);
}

//! One bad mesh is one row, whatever it does.

use std::fs;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use unwrapd::picture::Image;

use super::{Folders, mesh};
use crate::cli::{assert_status, last_error, unwrapd};
use crate::harness::children;
use crate::meshes;

#[test]
fn a_bad_mesh_is_a_row_with_its_code_and_stops_nothing() {
    let folders = Folders::with(&["good.obj"]);
    folders.write("in/empty.glb", "");
    folders.write("in/points.obj", "v 0 0 0\nv 1 0 0\n");
    std::os::unix::fs::symlink("loop.ply", folders.path("in/loop.ply")).expect("a link");
    std::os::unix::fs::symlink("..", folders.path("in/up")).expect("a link");
    let first = folders.batch(&[]);
    assert_status(&first, 4);
    let said = String::from_utf8_lossy(&first.stderr);
    assert!(
        said.contains("in/up is a link to a directory, which is not followed"),
        "{said}"
    );
    assert!(last_error(&first).contains("3 of 4 assets are not accepted: see "));
    let summary = folders.summary("summary.csv");
    let ended = |name: &str| {
        let row = &summary[name];
        (
            row["status"].as_str(),
            row["code"].as_str(),
            row["accepted"].as_str(),
        )
    };
    assert_eq!(ended("good.obj"), ("written", "", "true"));
    assert_eq!(ended("empty.glb"), ("failed", "invalid_gltf", "false"));
    assert_eq!(ended("points.obj"), ("failed", "no_triangles", "false"));
    assert_eq!(ended("loop.ply"), ("failed", "input_unreadable", "false"));
    assert_eq!(folders.outputs(), ["good.glb"]);

    // What will fail for the same reason is not tried again, unless that is asked for.
    for (arguments, words) in [
        (&[][..], "1 done now, 3 before"),
        (&["--retry-failed"], "3 done now, 1 before"),
    ] {
        let again = folders.batch(arguments);
        assert_status(&again, 4);
        let said = String::from_utf8_lossy(&again.stdout).into_owned();
        assert!(said.contains(words), "{said}");
    }
    folders.write("in/points.obj", &mesh(3));
    fs::write(folders.path("in/empty.glb"), meshes::hills(1)).expect("a file");
    fs::remove_file(folders.path("in/loop.ply")).expect("a link");
    assert_status(&folders.batch(&[]), 0);
}

#[test]
fn a_lack_of_memory_is_a_row_and_is_tried_again() {
    let folders = Folders::of(1);
    fs::write(folders.path("in/large.glb"), meshes::large()).expect("a file");
    let limited = ["--asset-memory-mib", "64", "--cut", "disk"];
    assert_status(&folders.batch(&limited), 4);
    let summary = folders.summary("summary.csv");
    assert_eq!(summary["large.glb"]["code"], "out_of_memory");
    assert_eq!(summary["000.obj"]["status"], "written");
    let again = folders.batch(&limited);
    let said = String::from_utf8_lossy(&again.stdout).into_owned();
    assert!(said.contains("1 done now, 1 before"), "{said}");
}

#[test]
fn a_child_that_does_not_end_is_a_row_and_is_tried_again() {
    let folders = Folders::with(&[]);
    fs::write(folders.path("in/large.glb"), meshes::large()).expect("a file");
    let mut command = folders.command(&["--asset-seconds", "1", "--quiet"]);
    let mut run = command.spawn().expect("the binary runs");
    let children = || children::within(&folders.path("tmp"));
    while children().is_empty() {
        std::thread::yield_now();
    }
    for child in children() {
        kill(Pid::from_raw(child), Signal::SIGSTOP).expect("it runs");
    }
    assert_eq!(run.wait().expect("an end").code(), Some(4));
    let summary = folders.summary("summary.csv");
    assert_eq!(summary["large.glb"]["code"], "timed_out");
    assert!(folders.outputs().is_empty() && children().is_empty());
    fs::write(folders.path("in/large.glb"), meshes::hills(1)).expect("a file");
    assert_status(&folders.batch(&[]), 0);
}

#[test]
fn a_file_of_another_output_is_not_replaced() {
    let folders = Folders::with(&[]);
    // Two inputs whose pictures have one name come into one folder.
    for (name, side) in [("x", 1), ("y", 2)] {
        let obj = format!("mtllib m.mtl\nusemtl m\n{}", mesh(0));
        folders.write(&format!("{name}/{name}.obj"), &obj);
        let material = "newmtl m\nKd 1 1 1\nmap_Kd t.png\n";
        folders.write(&format!("{name}/m.mtl"), material);
        let picture = Image::transparent(side, side).png();
        fs::write(folders.path(&format!("{name}/t.png")), picture).expect("a file");
    }
    folders.write("list", "x/x.obj\tx.gltf\ny/y.obj\ty.gltf\n");
    let (list, out) = (folders.text("list"), folders.text("out"));
    let arguments = ["batch", "--manifest", &list, "-o", &out, "--format", "gltf"];
    assert_status(&unwrapd(&[&arguments[..], &["--jobs", "1"]].concat()), 4);
    let summary = folders.summary("summary.csv");
    assert_eq!(summary["x/x.obj"]["status"], "written");
    assert_eq!(summary["y/y.obj"]["code"], "output_conflict");
    let there = fs::read(folders.path("out/t.png")).expect("a picture");
    assert_eq!(there, Image::transparent(1, 1).png());
    assert!(!folders.path("out/y.gltf").exists());
}

//! Inputs that are no files: they are rows of the summary, and nothing waits for them.

use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;

use super::Folders;
use crate::cli::{assert_status, unwrapd};

fn fifo(path: &str) {
    let made = Command::new("mkfifo").arg(path).status();
    assert!(made.expect("mkfifo").success());
}

/// Nobody writes to the pipe, and the device never ends.
#[test]
fn pipes_and_devices_are_rows_and_stop_nothing() {
    let folders = Folders::with(&["good.obj"]);
    fifo(&folders.text("in/pipe.obj"));
    symlink("/dev/zero", folders.path("in/zero.obj")).expect("a link");
    let large = fs::File::create(folders.path("in/large.obj")).expect("a file");
    large.set_len((4 << 30) + 1).expect("a sparse file");
    // What it refers to is no file either.
    let refers = "mtllib pipe.obj\n";
    folders.write("in/refers.obj", &format!("{refers}{}", super::mesh(1)));
    let output = folders.batch(&[]);
    assert_status(&output, 4);
    let summary = folders.summary("summary.csv");
    let code = |name: &str| summary[name]["code"].as_str();
    for name in ["pipe.obj", "zero.obj", "large.obj"] {
        assert_eq!(code(name), "input_unreadable", "{name}");
    }
    assert_eq!((code("good.obj"), code("refers.obj")), ("", ""));
}

/// A name may have characters that a terminal acts upon.
#[test]
fn control_characters_are_escaped() {
    let name = "a\u{1b}[31m\nb.obj";
    let folders = Folders::with(&[name]);
    folders.write(&format!("in/{name}"), "no mesh");
    let output = folders.batch(&[]);
    assert_status(&output, 4);
    let table = fs::read_to_string(folders.path("out/summary.csv")).expect("a summary");
    let said = [output.stdout, output.stderr].concat();
    for text in [String::from_utf8(said).expect("text"), table] {
        let is_active = |c: char| c.is_control() && c != '\n';
        assert!(!text.contains(is_active), "{text:?}");
        assert!(text.contains(r"a\u{1b}[31m\nb.obj"), "{text:?}");
    }
    // The same where one mesh is read.
    let input = folders.text(&format!("in/{name}"));
    let output = unwrapd(&["unwrap", &input, "-o", &folders.text("out.glb")]);
    assert_status(&output, 3);
    let said = String::from_utf8(output.stderr).expect("text");
    assert!(!said.contains('\u{1b}'), "{said:?}");
}

/// A pipe that is named on the command line is read; a device is not.
#[test]
fn one_mesh_may_come_from_a_pipe_and_not_from_a_device() {
    let folders = Folders::with(&["good.obj"]);
    let (pipe, output) = (folders.text("pipe.obj"), folders.text("out.glb"));
    fifo(&pipe);
    let from = folders.path("in/good.obj");
    let to = pipe.clone();
    let writer = std::thread::spawn(move || fs::copy(from, to));
    assert_status(&unwrapd(&["unwrap", &pipe, "-o", &output]), 0);
    writer.join().expect("no panic").expect("written");
    let refused = unwrapd(&["unwrap", "/dev/zero", "-o", &output]);
    assert_status(&refused, 3);
    let said = String::from_utf8(refused.stderr).expect("text");
    assert!(said.contains("/dev/zero: not a regular file"), "{said}");
}

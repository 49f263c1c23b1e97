//! Runs that are ended: what they finished stays, everything else is absent, and a later run does it.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Stdio};
use std::time::Instant;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use super::Folders;
use crate::cli::assert_status;
use crate::harness::children;
use crate::server::SOON;

const COUNT: usize = 8;

/// A run of which two assets are through.
fn started(folders: &Folders) -> (Child, BufReader<std::process::ChildStderr>) {
    let mut command = folders.command(&["--jobs", "2"]);
    let mut child = command
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .expect("the binary runs");
    let mut lines = BufReader::new(child.stderr.take().expect("piped"));
    for _ in 0..2 {
        let mut line = String::new();
        lines.read_line(&mut line).expect("a line");
        assert!(line.contains("certified"), "{line}");
    }
    (child, lines)
}

fn send(child: &Child, signal: Signal) {
    kill(Pid::from_raw(child.id() as i32), signal).expect("it runs");
}

fn assert_no_orphan(folders: &Folders) {
    let start = Instant::now();
    while !children::within(&folders.path("tmp")).is_empty() {
        assert!(start.elapsed() < SOON, "an orphan is left");
        std::thread::yield_now();
    }
}

/// Every output is a whole binary glTF, and each that has a record is not touched by the next run.
fn assert_resumed(folders: &Folders) {
    for name in folders.outputs() {
        let bytes = fs::read(folders.path("out").join(&name)).expect("an output");
        let told = u32::from_le_bytes(bytes[8..12].try_into().expect("4 bytes"));
        assert_eq!(told as usize, bytes.len(), "{name}");
    }
    let before = folders.written();
    let finished = |name: &&String| name.starts_with(".unwrapd/records");
    let n_finished = before.keys().filter(finished).count();
    assert!((2..COUNT).contains(&n_finished), "{n_finished} finished");
    let run = folders.batch(&[]);
    assert_status(&run, 0);
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    let words = format!("{} done now, {n_finished} before", COUNT - n_finished);
    assert!(said.contains(&words), "{said}");
    let after = folders.written();
    for record in before.keys().filter(finished) {
        assert_eq!(after[record], before[record], "{record} was done twice");
    }
    assert_eq!(folders.outputs().len(), COUNT);
    assert_eq!(folders.summary("summary.csv").len(), COUNT);
    let left = fs::read_dir(folders.path("tmp")).expect("a folder").count();
    assert_eq!(left, 0, "folders of killed runs are removed");
}

#[test]
fn a_run_that_is_killed_leaves_nothing_half_and_is_resumed() {
    let folders = Folders::of(COUNT);
    let (mut child, lines) = started(&folders);
    send(&child, Signal::SIGKILL);
    child.wait().expect("an end");
    drop(lines);
    assert_no_orphan(&folders);
    assert!(!folders.path("out/summary.csv").exists());
    assert_resumed(&folders);
}

#[test]
fn a_run_that_is_stopped_says_so_and_is_resumed() {
    for signal in [Signal::SIGTERM, Signal::SIGINT] {
        let folders = Folders::of(COUNT);
        let (mut child, mut lines) = started(&folders);
        send(&child, signal);
        assert_eq!(child.wait().expect("an end").code(), Some(1));
        let mut rest = String::new();
        while lines.read_line(&mut rest).expect("a line") > 0 {}
        assert_no_orphan(&folders);
        assert!(
            rest.contains("the same command goes on where it was"),
            "{rest}"
        );
        let left = fs::read_dir(folders.path("tmp")).expect("a folder").count();
        assert_eq!(left, 0, "it cleans up");
        assert_resumed(&folders);
    }
}

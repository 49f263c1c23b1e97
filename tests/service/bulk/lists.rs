//! What a run is to do: folders and manifests, and those that it refuses.

use std::io::Write;
use std::process::Stdio;

use super::{Folders, mesh};
use crate::cli::{assert_status, last_error, unwrapd};

#[test]
fn lists_that_cannot_be_done_are_refused_before_the_work() {
    let folders = Folders::with(&["a.obj", "a.ply", "b/c.obj"]);
    folders.write("empty/notes.txt", "");
    folders.write("twice", "in/a.obj\n\nin/a.obj\n");
    folders.write("climbs", "in/a.obj\t../a.glb\n");
    folders.write("named", "in/a.obj\ta.gltf\n");
    folders.write("fields", "in/a.obj\ta.glb\t12\n");
    folders.write("same", "in/a.obj\tx.glb\nin/b/c.obj\t./x.glb\n");
    folders.write("apart", "/x/a.obj\n/y/a.ply\n");
    let path = |name: &str| folders.text(name);
    let output = path("out");
    let manifest = |name: &str| vec!["--manifest".to_owned(), path(name)];
    for (list, status, words) in [
        (
            vec![path("in")],
            2,
            "a.obj and a.ply would both be written to a.glb",
        ),
        (vec![path("empty")], 3, "empty names no mesh"),
        (vec![path("absent")], 3, "absent: No such file"),
        (vec![path("in/a.obj")], 3, "a.obj: Not a directory"),
        (manifest("absent"), 3, "absent: No such file"),
        (manifest("twice"), 3, "line 3: in/a.obj is listed twice"),
        (
            manifest("climbs"),
            3,
            "line 1: the output ../a.glb must be a relative path",
        ),
        (
            manifest("named"),
            3,
            "line 1: the output a.gltf must be a relative path",
        ),
        (
            manifest("fields"),
            3,
            "line 1: expected INPUT, or INPUT and OUTPUT",
        ),
        (
            manifest("same"),
            2,
            "in/a.obj and in/b/c.obj would both be written to x.glb",
        ),
        (manifest("apart"), 2, "would both be written to"),
        (vec![], 2, ""),
    ] {
        let list: Vec<&str> = list.iter().map(String::as_str).collect();
        let run = unwrapd(&[&["batch", "-o", &output], &list[..]].concat());
        assert_status(&run, status);
        let error = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(error.contains(words), "{error}");
    }
    assert!(!folders.path("out").exists());
}

#[test]
fn inputs_are_neither_replaced_nor_read_from_the_output() {
    let folders = Folders::with(&["a.obj"]);
    let (input, inside) = (folders.text("in"), folders.text("in/out"));
    let same = ["batch", &input, "-o", &input, "--format", "obj"];
    let run = unwrapd(&same);
    assert_status(&run, 2);
    assert!(last_error(&run).contains("is an input and would be replaced"));
    let run = || {
        let output = unwrapd(&["batch", &input, "-o", &inside]);
        assert_status(&output, 0);
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    assert!(run().contains("1 assets: 1 written"));
    assert!(
        run().contains("1 assets: 1 written"),
        "outputs are no inputs"
    );
}

#[test]
fn manifests_name_inputs_and_outputs() {
    let folders = Folders::with(&["a.obj", "b c.obj"]);
    folders.write("lists/of.txt", "../in/a.obj\tx/y.glb\r\n../in/b c.obj\n");
    let (list, out) = (folders.text("lists/of.txt"), folders.text("out"));
    assert_status(&unwrapd(&["batch", "--manifest", &list, "-o", &out]), 0);
    assert_eq!(folders.outputs(), ["b c.glb", "x/y.glb"]);
    assert_eq!(
        folders.summary("summary.csv")["../in/a.obj"]["output"],
        "x/y.glb"
    );
}

#[test]
fn a_manifest_may_come_from_a_pipe() {
    let folders = Folders::with(&["a.obj", "b.obj"]);
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .args(["batch", "--manifest", "-", "-o", "out", "--json"])
        .current_dir(folders.path(""))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the binary runs");
    let mut input = child.stdin.take().expect("piped");
    input.write_all(b"in/b.obj\n").expect("a reader");
    drop(input);
    let output = child.wait_with_output().expect("an end");
    assert_status(&output, 0);
    let totals: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let expected = serde_json::json!({
        "assets": 1, "written": 1, "failed": 0, "missing": 0, "accepted": 1, "partly_done": 0
    });
    assert_eq!(totals, expected);
    assert_eq!(folders.outputs(), ["in/b.glb"]);
}

#[test]
fn options_are_those_of_unwrap_and_are_checked_before_the_work() {
    let folders = Folders::with(&["a.obj"]);
    for (arguments, words) in [
        (&["--padding", "9999"][..], "--padding"),
        (
            &["--cut", "fast", "--max-charts", "3"],
            "--max-charts requires --cut",
        ),
        (&["--heatmap-measure", "area"], "--heatmap"),
        (&["--seams", "S.json"], "normals"),
        (&["--jobs", "0"], "--jobs"),
        (&["--asset-seconds", "none"], "--asset-seconds"),
    ] {
        let run = folders.batch(arguments);
        assert_status(&run, 2);
        let error = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(error.contains(words), "{error}");
    }
    assert!(!folders.path("out").exists());
    folders.write("in/a.obj", &mesh(1));
    assert_status(&folders.batch(&["--format", "obj", "--max-charts", "1"]), 0);
    assert_eq!(folders.outputs(), ["a.obj"]);
}

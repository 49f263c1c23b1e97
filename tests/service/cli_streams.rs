//! The command line in pipes: `-`, named pipes, what a shell opens for `<(…)` and `>(…)`.

use std::fs::{self, File};
use std::io::{Read, Write};
use std::process::{Command, Output, Stdio};

use crate::cli::{assert_status, asset, last_error, unwrapd};

/// Runs with something on standard input.
fn fed(arguments: &[&str], input: Vec<u8>) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary runs");
    let mut stdin = child.stdin.take().expect("a pipe");
    let writer = std::thread::spawn(move || stdin.write_all(&input));
    let output = child.wait_with_output().expect("an end");
    // A command that is refused reads nothing.
    let _ = writer.join().expect("a thread");
    output
}

#[test]
fn a_mesh_goes_through_a_pipe() {
    let arguments = ["unwrap", "-", "-o", "-", "--format", "glb"];
    for name in ["Box.glb", "cat_head.obj", "spot.ply"] {
        let run = fed(&arguments, fs::read(asset(name)).expect("a mesh"));
        assert_status(&run, 0);
        assert!(
            run.stdout.starts_with(b"glTF"),
            "{name}: nothing but the result"
        );
        let said = String::from_utf8_lossy(&run.stderr);
        assert!(said.contains("certified"), "{said}");
        let verified = fed(&["verify", "-", "--bijective"], run.stdout);
        assert_status(&verified, 0);
        assert!(String::from_utf8_lossy(&verified.stdout).contains("valid"));
    }
}

#[test]
fn a_pipe_gives_what_files_give() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let input = asset("Box.glb").to_string_lossy().into_owned();
    assert_status(
        &unwrapd(&["unwrap", &input, "-o", &path("mesh.glb"), "--quiet"]),
        0,
    );
    let bytes = fs::read(path("mesh.glb")).expect("a result");
    let piped = ["unwrap", "-", "-o", "-", "--format", "glb", "--quiet"];
    let piped = fed(&piped, fs::read(&input).expect("a mesh"));
    assert_status(&piped, 0);
    assert!(piped.stderr.is_empty());
    assert!(piped.stdout == bytes);

    // As a shell has them for <(…) and >(…), and by name: each is opened once.
    let script = r#""$0" unwrap <(cat "$1") -o >(cat > "$2") --format glb --quiet && wait $!"#;
    let (program, out) = (env!("CARGO_BIN_EXE_unwrapd"), path("substituted"));
    let shell = Command::new("bash")
        .args(["-c", script, program, &input, &out])
        .output()
        .expect("a shell");
    assert_status(&shell, 0);
    assert!(fs::read(&out).expect("a result") == bytes);

    let (from, to) = (path("from"), path("to"));
    mkfifo(&from);
    mkfifo(&to);
    let written = bytes_of(&input);
    let writer = std::thread::spawn({
        let from = from.clone();
        move || File::create(from).expect("a reader").write_all(&written)
    });
    let reader = std::thread::spawn({
        let to = to.clone();
        move || bytes_of(&to)
    });
    let arguments = ["unwrap", &from, "-o", &to, "--format", "glb", "--quiet"];
    assert_status(&unwrapd(&arguments), 0);
    writer.join().expect("a thread").expect("all is read");
    assert!(reader.join().expect("a thread") == bytes);
}

fn mkfifo(path: &str) {
    let made = Command::new("mkfifo").arg(path).status();
    assert!(made.expect("mkfifo runs").success());
}

fn bytes_of(path: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut file = File::open(path).expect("a writer");
    file.read_to_end(&mut bytes).expect("bytes");
    bytes
}

#[test]
fn streams_that_make_no_sense_are_refused() {
    let refused = |arguments: &[&str], words: &str| {
        let run = fed(arguments, Vec::new());
        assert_status(&run, 2);
        assert!(last_error(&run).contains(words), "{}", last_error(&run));
        assert!(run.stdout.is_empty());
    };
    refused(&["unwrap", "-", "-o", "-"], "--format");
    refused(
        &["unwrap", "-", "-o", "-", "--format", "gltf"],
        "several files",
    );
    refused(
        &["unwrap", "-", "-o", "-", "--format", "glb", "--json"],
        "one result",
    );
    refused(
        &["unwrap", "-", "-o", "a.glb", "--format", "obj"],
        "contradicts",
    );
    refused(
        &[
            "edit-uv",
            "-",
            "--anchors",
            "-",
            "-o",
            "-",
            "--format",
            "glb",
        ],
        "standard input",
    );
    let nothing = fed(&["unwrap", "-", "-o", "-", "--format", "glb"], Vec::new());
    assert_status(&nothing, 3);
    assert!(last_error(&nothing).contains("unknown_format"));
}

#[test]
fn other_commands_take_pipes_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let handles = folder.path().join("h.json");
    let handles = handles.to_string_lossy();
    fs::write(
        &*handles,
        r#"{"handles": [{"at": [30, 30], "to": [38, 34]}]}"#,
    )
    .expect("a file");
    let picture = fs::read(asset("pictures/spot.png")).expect("a picture");
    let warped = ["warp", "-", "--handles", &handles, "-o", "-", "--grid", "8"];
    let warped = fed(&warped, picture);
    assert_status(&warped, 0);
    assert!(warped.stdout.starts_with(b"\x89PNG"));

    let drawing =
        br#"<svg xmlns="http://www.w3.org/2000/svg"><rect width="100" height="60"/></svg>"#;
    let deform = [
        "deform",
        "-",
        "--handles",
        &handles,
        "-o",
        "-",
        "--format",
        "off",
    ];
    let deformed = fed(
        &[&deform[..], &["--triangles", "200"]].concat(),
        drawing.to_vec(),
    );
    assert_status(&deformed, 0);
    assert!(deformed.stdout.starts_with(b"OFF"));
}

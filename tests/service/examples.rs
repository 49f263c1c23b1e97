//! The example of every command runs and ends as it should.

use std::process::Command;

use crate::places;

/// Runs the example of a command in `tests/examples/commands`.
fn example(command: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    let picture = folder.path().join("picture.png");
    let output = Command::new(places::python())
        .arg(places::repository("tests/examples/commands"))
        .args(["--unwrapd", env!("CARGO_BIN_EXE_unwrapd"), "--picture"])
        .args([picture.as_os_str(), command.as_ref()])
        .output()
        .expect("a Python");
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.starts_with(&format!("{command}: unwrapd ")), "{text}");
    let drawn = std::fs::read(&picture).expect("a picture");
    assert!(drawn.starts_with(b"\x89PNG"));
}

macro_rules! examples {
    ($($test:ident: $command:literal,)*) => {$(
        #[test]
        fn $test() {
            example($command);
        }
    )*};
}

examples! {
    unwrap: "unwrap",
    repack: "repack",
    measure: "measure",
    verify: "verify",
    batch: "batch",
    deform: "deform",
    solve: "solve",
    untangle: "untangle",
    warp: "warp",
    edit_uv: "edit-uv",
    texture_map: "texture-map",
}

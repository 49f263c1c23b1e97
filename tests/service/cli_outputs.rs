//! Where the command line writes is checked before the work, and nothing is lost that was there.

use std::fs;
use std::os::unix::fs::{MetadataExt, symlink};
use std::path::Path;

use crate::cli::{assert_status, asset, last_error, unwrapd};

/// A folder with a mesh, and what names its files.
fn folder() -> (tempfile::TempDir, impl Fn(&str) -> String) {
    let folder = tempfile::tempdir().expect("a folder");
    fs::copy(asset("Box.glb"), folder.path().join("in.glb")).expect("a file");
    let path = folder.path().to_path_buf();
    let named = move |name: &str| path.join(name).to_string_lossy().into_owned();
    (folder, named)
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = entries
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

/// Refused with this status and words, without having begun: not even the input was read.
#[track_caller]
fn assert_refused(arguments: &[&str], status: i32, words: &str) {
    let output = unwrapd(arguments);
    assert_status(&output, status);
    let error = last_error(&output);
    assert!(error.contains(words), "{error}");
    assert_eq!(String::from_utf8_lossy(&output.stderr).lines().count(), 1);
}

#[test]
fn what_cannot_be_written_is_found_before_the_work() {
    let (folder, path) = folder();
    fs::write(path("file"), "").expect("a file");
    fs::create_dir(path("folder.glb")).expect("a folder");
    // There is no such input: whoever reads it first fails with status 3.
    let input = path("absent.glb");
    for (output, words) in [
        (path("none/out.glb"), "does not exist"),
        (path("none/deeper/out.glb"), "does not exist"),
        (path("file/out.glb"), "does not exist"),
        (path("folder.glb"), "it is a directory"),
        ("/proc/out.glb".to_owned(), "cannot write /proc/out.glb"),
    ] {
        assert_refused(&["unwrap", &input, "-o", &output], 1, words);
        assert_refused(&["repack", &input, "-o", &output], 1, words);
    }
    let (output, beside) = (path("out.glb"), path("none/r.json"));
    for option in ["--report", "--layout", "--heatmap"] {
        let arguments = ["unwrap", &input, "-o", &output, option, &beside];
        assert_refused(&arguments, 1, "does not exist");
    }
    let frames = path("none/frames");
    let handles = path("absent.json");
    let arguments = ["deform", &input, "--handles", &handles, "-o", &output];
    let with_frames = [&arguments[..], &["--frames", &frames]].concat();
    assert_refused(&with_frames, 1, "cannot create");
    let picture = path("out.jpg");
    let arguments = ["warp", &input, "--handles", &handles, "-o", &picture];
    assert_refused(&arguments, 2, ".png");
    assert_eq!(names(folder.path()), ["file", "folder.glb", "in.glb"]);
}

#[test]
fn an_input_is_replaced_only_by_force() {
    let (folder, path) = folder();
    let input = path("in.glb");
    let before = fs::read(&input).expect("a mesh");
    symlink(&input, path("link.glb")).expect("a link");
    fs::hard_link(&input, path("hard.glb")).expect("a link");
    let dotted = folder
        .path()
        .join("./../")
        .join(folder.path().file_name().expect("a name"));
    let dotted = dotted.join("in.glb").to_string_lossy().into_owned();
    for output in [&input, &path("link.glb"), &path("hard.glb"), &dotted] {
        assert_refused(&["unwrap", &input, "-o", output], 2, "--force");
    }
    assert_refused(&["unwrap", &dotted, "-o", &input], 2, "--force");
    let arguments = ["unwrap", &input, "-o", &path("out.glb"), "--report", &input];
    assert_refused(&arguments, 2, "--force");
    assert_eq!(fs::read(&input).expect("a mesh"), before);

    // Through a link the file is replaced, not the link.
    let arguments = ["unwrap", &input, "-o", &path("link.glb"), "--force"];
    assert_status(&unwrapd(&arguments), 0);
    assert!(
        fs::symlink_metadata(path("link.glb"))
            .expect("it")
            .is_symlink()
    );
    assert_ne!(fs::read(&input).expect("a mesh"), before);
    assert_status(&unwrapd(&["verify", &input, "--quiet"]), 0);
}

#[test]
fn two_results_are_two_files() {
    let (_folder, path) = folder();
    let (input, output) = (path("in.glb"), path("out.glb"));
    let dotted = path("./out.glb");
    let arguments = ["unwrap", &input, "-o", &output, "--report", &dotted];
    assert_refused(&arguments, 2, "same file");
}

#[test]
fn a_run_that_fails_leaves_an_old_result_as_it_was() {
    let (folder, path) = folder();
    let output = path("out.obj");
    fs::write(&output, "an old result").expect("a file");
    fs::write(path("points.obj"), "v 0 0 0\nv 1 0 0\n").expect("a file");
    let inode = || fs::metadata(&output).expect("a file").ino();
    let before = inode();
    assert_status(&unwrapd(&["unwrap", &path("points.obj"), "-o", &output]), 3);
    // The mesh is done, but the report has no place any more: a device that is full.
    let input = path("in.glb");
    let full = ["unwrap", &input, "-o", &output, "--report", "/dev/full"];
    let run = unwrapd(&full);
    assert_status(&run, 1);
    assert!(last_error(&run).contains("cannot write /dev/full"));
    assert_eq!(fs::read(&output).expect("a file"), b"an old result");
    assert_eq!(inode(), before);
    assert_eq!(names(folder.path()), ["in.glb", "out.obj", "points.obj"]);
    assert_status(&unwrapd(&["unwrap", &input, "-o", &output, "--quiet"]), 0);
    assert!(fs::read_to_string(&output).expect("text").contains("\nvt "));
}

#[test]
fn files_that_an_input_references_are_not_replaced_either() {
    let (folder, path) = folder();
    let parts = folder.path().join("parts");
    fs::create_dir(&parts).expect("a folder");
    let part = |name: &str| parts.join(name).to_string_lossy().into_owned();
    let (first, second) = (part("first.gltf"), part("second.gltf"));
    let run = ["unwrap", &path("in.glb"), "-o", &first, "--quiet"];
    assert_status(&unwrapd(&run), 0);
    // The second is to have a buffer of the name that the first has.
    fs::rename(part("first.bin"), part("second.bin")).expect("it");
    let text = fs::read_to_string(&first).expect("text");
    let text = text.replace("first.bin", "second.bin");
    fs::write(&first, text).expect("a file");
    let buffer = fs::read(part("second.bin")).expect("a buffer");
    let run = unwrapd(&["unwrap", &first, "-o", &second, "--padding", "8", "--quiet"]);
    assert_status(&run, 2);
    assert!(
        last_error(&run).contains("second.bin"),
        "{}",
        last_error(&run)
    );
    assert_eq!(fs::read(part("second.bin")).expect("a buffer"), buffer);
    assert_eq!(names(&parts), ["first.gltf", "second.bin"]);
}

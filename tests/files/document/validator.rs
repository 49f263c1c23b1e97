//! What is written passes the Khronos validator, which `tests/run` installs.
use crate::documents::{gltf_files, grid_uvs, new_uvs, options, upload};
use crate::places;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use unwrapd_files::document::{Document, OutputFormat};

/// The error codes of each file.
fn errors(folder: &Path, paths: &[PathBuf]) -> Vec<Vec<String>> {
    let mut node = Command::new("node")
        .arg("validate.mjs")
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut list = node.stdin.take().unwrap();
    for path in paths {
        writeln!(list, "{}", path.display()).unwrap();
    }
    drop(list);
    let output = node.wait_with_output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let errors: Vec<Vec<String>> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(
        errors.len(),
        paths.len(),
        "the validator answers, once installed"
    );
    errors
}

#[test]
fn outputs_have_no_error_that_their_input_did_not_have() {
    assert_no_new_errors(&places::asset(""));
}

/// No output has an error of a kind that its input has not; copies of a vertex copy its faults. In every way of writing.
fn assert_no_new_errors(folder: &Path) {
    let validator = places::repository("tests/validator");
    let output = tempfile::tempdir().unwrap();
    let (mut inputs, mut outputs) = (Vec::new(), Vec::new());
    for (number, path) in gltf_files(folder).into_iter().enumerate() {
        let Ok(document) = Document::read(&upload(&path)) else {
            continue;
        };
        for (way, (period, format, overwrite)) in [
            (usize::MAX, OutputFormat::Glb, false),
            (4, OutputFormat::Glb, false),
            (4, OutputFormat::Glb, true),
            (1, OutputFormat::Gltf, false),
        ]
        .into_iter()
        .enumerate()
        {
            let grid = grid_uvs(&document, 12, period);
            let mut options = options(format);
            options.overwrite = overwrite;
            let written = document.write(&new_uvs(&grid, 12), &options).unwrap();
            let folder = output.path().join(format!("{number}-{way}"));
            for (name, bytes) in &written.files {
                let path = folder.join(name);
                std::fs::create_dir_all(path.parent().unwrap()).unwrap();
                std::fs::write(path, bytes).unwrap();
            }
            inputs.push(path.clone());
            outputs.push(folder.join(&written.files[0].0));
        }
    }
    let before = errors(&validator, &inputs);
    let after = errors(&validator, &outputs);
    let mut worse = Vec::new();
    for ((input, before), after) in inputs.iter().zip(&before).zip(&after) {
        for code in after.iter().filter(|code| !before.contains(code)) {
            // The validator cannot see into compressed inputs, and one of them has normals of length 1/16 inside.
            let is_known = code == "ACCESSOR_VECTOR3_NON_UNIT"
                && input.ends_with("Duck-vp-12-vt-12-vn-12.glb");
            // All buffers of this one are without content, so that there is nothing to be wrong.
            if is_known || input.ends_with("unused_objects.gltf") {
                continue;
            }
            worse.push(format!("{}: {code}", input.display()));
        }
    }
    worse.dedup();
    assert!(worse.is_empty(), "{worse:#?}");
}

mod shared {
    use super::{assert_no_new_errors, places};

    #[test]
    #[ignore = "needs ../shared"]
    fn outputs_have_no_error_that_their_input_did_not_have() {
        assert_no_new_errors(&places::shared("data/gltf"));
    }
}

//! The npm package, with the addon that cargo builds for these tests: each file of tests here is one of Node's runner, beside
//! the package as it would be installed.

#[path = "../native.rs"]
mod native;

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

use native::{module, passed, repository};

/// Puts what the package consists of, and what the tests need beside it, into a folder.
fn install(folder: &Path) {
    let (package, modules) = (repository("src/node"), folder.join("node_modules"));
    let installed = modules.join("unwrapd");
    fs::create_dir_all(&installed).expect("a folder");
    let manifest = fs::read_to_string(package.join("package.json")).expect("text");
    let manifest: serde_json::Value = serde_json::from_str(&manifest).expect("JSON");
    let named = manifest["files"].as_array().expect("an array");
    let files = named.iter().map(|name| name.as_str().expect("a name"));
    // Another addon may be there: one that was built to be published.
    let files = files.filter(|name| *name != "unwrapd.node");
    for name in files.chain(["package.json", "README.md"]) {
        if package.join(name).is_file() {
            fs::copy(package.join(name), installed.join(name)).expect("a copy");
        }
    }
    symlink(module("unwrapd_node"), installed.join("unwrapd.node")).expect("a link");
    for entry in fs::read_dir(repository("tests/node/node_modules")).expect("npm install") {
        let path = entry.expect("an entry").path();
        symlink(&path, modules.join(path.file_name().expect("a name"))).expect("a link");
    }
    for entry in fs::read_dir(repository("tests/node")).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_file() {
            fs::copy(&path, folder.join(path.file_name().expect("a name"))).expect("a copy");
        }
    }
}

/// Asserts that all tests in a file pass.
fn passes(file: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    install(folder.path());
    let output = Command::new("node")
        .args(["--test", "--test-reporter=tap"])
        .arg(format!("{file}.test.mjs"))
        .current_dir(folder.path())
        .env("UNWRAPD_REPOSITORY", repository(""))
        .env("UNWRAPD_VERSION", env!("CARGO_PKG_VERSION"))
        .output()
        .expect("Node");
    let text = passed(&output);
    assert!(
        text.contains("\n# skipped 0\n") && !text.contains("\n# pass 0\n"),
        "{text}"
    );
}

native::tests_of_files!(
    addon,
    crate::passes,
    native::files("tests/node", "", ".test.mjs"),
    [atlas, bytes, document, types]
);

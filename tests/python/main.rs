//! The Python package, with the extension that cargo builds for these tests: each file of tests here is one of pytest.

#[path = "../native.rs"]
mod native;

use std::process::Command;

use native::{module, passed, repository};

/// Asserts that all tests in a file pass.
fn passes(file: &str) {
    let output = Command::new(repository("tests/.venv/bin/python"))
        .args(["-m", "pytest", "-q", "-p", "no:cacheprovider"])
        .arg(repository("tests/python").join(format!("test_{file}.py")))
        .current_dir(repository("tests/python"))
        .env("UNWRAPD_NATIVE", module("unwrapd_native"))
        .output()
        .expect("a Python");
    let text = passed(&output);
    assert!(
        text.contains(" passed") && !text.contains("skipped"),
        "{text}"
    );
}

native::tests_of_files!(
    pytest,
    crate::passes,
    native::files("tests/python", "test_", ".py"),
    [
        arrays,
        bake,
        blender_layout,
        calls,
        client,
        comfyui,
        command,
        energy,
        errors,
        examples,
        files,
        leaks,
        pipelines,
        problem,
        readme,
        session,
        trimesh,
        untangle,
        words,
        xatlas
    ]
);

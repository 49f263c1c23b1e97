//! The Python package, with the extension that cargo builds for these tests: each file of tests here is one of pytest.

use std::path::PathBuf;
use std::process::Command;

/// A file or folder of the repository.
fn repository(path: &str) -> PathBuf {
    let package = std::env::var_os("CARGO_MANIFEST_DIR").expect("tests are run by cargo");
    PathBuf::from(package).join("../..").join(path)
}

/// The extension, which lies beside this program.
fn extension() -> PathBuf {
    let program = std::env::current_exe().expect("a path");
    let name = format!(
        "{}unwrapd_native{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    );
    program.with_file_name(name)
}

/// Asserts that all tests in a file pass.
fn passes(file: &str) {
    let output = Command::new(repository("tests/.venv/bin/python"))
        .args(["-m", "pytest", "-q", "-p", "no:cacheprovider"])
        .arg(repository("tests/python").join(format!("test_{file}.py")))
        .env("UNWRAPD_NATIVE", extension())
        .output()
        .expect("a Python");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success(),
        "{text}{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert!(
        text.contains(" passed") && !text.contains("skipped"),
        "{text}"
    );
}

macro_rules! pytest {
    ($($file:ident),*) => {
        const FILES: &[&str] = &[$(stringify!($file)),*];

        mod pytest {
            $(#[test]
            fn $file() {
                super::passes(stringify!($file));
            })*
        }
    };
}

pytest!(
    arrays, bake, calls, comfyui, errors, examples, files, leaks, pipelines, problem, readme, session,
    trimesh, xatlas
);

#[test]
fn no_file_is_left_out() {
    let entries = std::fs::read_dir(repository("tests/python")).expect("a folder");
    let names = entries.map(|entry| {
        entry
            .expect("an entry")
            .file_name()
            .into_string()
            .expect("text")
    });
    let tests =
        names.filter_map(|name| Some(name.strip_prefix("test_")?.strip_suffix(".py")?.to_owned()));
    let mut found: Vec<String> = tests.collect();
    found.sort_unstable();
    assert_eq!(found, FILES);
}

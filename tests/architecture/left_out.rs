//! Which tests may be left out: those in modules named `shared`, where the data beside the repository is absent, and those in
//! `server`, `cluster`, `browser` and `figures`, in a run without them.

use std::fs;
use std::path::{Path, PathBuf};

use crate::places;

const IGNORED: &str = "#[ignore = \"needs ../shared\"]";

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// What a file of tests has outside of its module `shared`, and what inside.
fn parts(text: &str) -> (String, &str) {
    let Some(start) = text.find("\nmod shared {\n") else {
        return (text.to_owned(), "");
    };
    let rest = &text[start..];
    let end = rest.find("\n}\n").map_or(rest.len(), |at| at + 3);
    (format!("{}{}", &text[..start], &rest[end..]), &rest[..end])
}

#[test]
fn only_tests_of_shared_data_are_ignored() {
    let mut files = Vec::new();
    for folder in [
        "tests/method",
        "tests/maps",
        "tests/layout",
        "tests/files",
        "tests/deform",
        "tests/pipeline",
        "tests/service",
    ] {
        sources(&places::repository(folder), &mut files);
    }
    let mut n_shared = 0;
    for file in files.iter().filter(|file| !file.ends_with("left_out.rs")) {
        let text = fs::read_to_string(file).expect("text");
        let (outside, inside) = parts(&text);
        for word in [
            "#[ignore",
            "places::shared(",
            "../shared",
            "env!(\"CARGO_MANIFEST_DIR\")",
        ] {
            assert!(!outside.contains(word), "{}: {word}", file.display());
        }
        let n_tests = inside.matches("test]\n").count();
        assert_eq!(
            inside.matches(IGNORED).count(),
            n_tests,
            "{}",
            file.display()
        );
        n_shared += n_tests;
    }
    assert!(n_shared > 10, "{n_shared}");
}

#[test]
fn servers_and_browsers_are_where_runs_without_them_look() {
    let mut files = Vec::new();
    sources(&places::repository("tests/service"), &mut files);
    let (apart, others): (Vec<_>, Vec<_>) = files.iter().partition(|file| {
        file.iter().any(|part| {
            ["server", "browser", "cluster", "losses"].contains(&part.to_str().unwrap_or_default())
        })
    });
    assert!(apart.len() > 10, "{apart:?}");
    for file in others {
        let text = fs::read_to_string(file).expect("text");
        for word in ["Server::", "\"serve\"", "chromium", "\"node\""] {
            assert!(!text.contains(word), "{}: {word}", file.display());
        }
    }
}

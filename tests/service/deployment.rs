//! The files that deploy the service, judged by validators.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::Command;

use crate::cli::{assert_status, unwrapd};
use crate::places;

/// The files of a folder of `docker`, by their ending.
fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(places::repository(folder)).expect("a folder");
    let paths = entries.map(|entry| entry.expect("a file").path());
    let found: Vec<PathBuf> = paths
        .filter(|path| path.to_string_lossy().ends_with(ending))
        .collect();
    assert!(!found.is_empty(), "{folder} has none");
    found
}

#[test]
fn kubernetes_files_are_valid() {
    for file in files("docker/kubernetes", ".yaml") {
        if file.ends_with("kustomization.yaml") {
            continue;
        }
        let mut validator = Command::new(places::python());
        validator.args(["-m", "kubernetes_validate", "--strict"]);
        let output = validator.arg(&file).output().expect("the validator runs");
        assert_status(&output, 0);
    }
}

/// The parts are named, and nothing else is in the folder.
#[test]
fn kustomize_lists_every_file() {
    let folder = places::repository("docker/kubernetes");
    let list = std::fs::read_to_string(folder.join("kustomization.yaml")).expect("a file");
    for file in files("docker/kubernetes", ".yaml") {
        let name = file.file_name().expect("a name").to_string_lossy();
        let is_listed = list.lines().any(|line| line == format!("  - {name}"));
        assert_eq!(is_listed, name != "kustomization.yaml", "{name}");
    }
}

#[test]
fn compose_files_are_valid() {
    for file in ["compose.yaml", "compose.scaled.yaml"] {
        let mut compose = Command::new("docker-compose");
        compose.args(["--file", file, "config", "--quiet"]);
        compose
            .current_dir(places::repository("docker"))
            .env("POSTGRES_PASSWORD", "secret");
        assert_status(&compose.output().expect("docker-compose runs"), 0);
    }
}

/// A variable that no option reads would be set in vain.
#[test]
fn every_variable_is_that_of_an_option() {
    let of = |line: &str| unwrapd(&line.split(' ').collect::<Vec<_>>()).stdout;
    let help = ["serve --help", "worker --help"].map(of);
    let help = String::from_utf8(help.concat()).expect("text");
    let mut named = BTreeSet::new();
    let deployed = [
        files("docker", ".yaml"),
        files("docker/kubernetes", ".yaml"),
    ];
    for file in deployed.iter().flatten() {
        let text = std::fs::read_to_string(file).expect("a file");
        let words = text.split(|c: char| !(c.is_ascii_uppercase() || c == '_'));
        let variables = words.filter(|word| word.starts_with("UNWRAPD_"));
        named.extend(variables.map(str::to_owned));
    }
    assert!(6 <= named.len(), "{named:?}");
    for name in named {
        assert!(help.contains(&format!("[env: {name}")), "{name}");
    }
}

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

/// The service of the files comes up: a key is added before it starts, metrics need none, and all run the version that this is.
#[test]
fn kubernetes_has_a_key_and_metrics() {
    let text = |name: &str| {
        let path = places::repository("docker/kubernetes").join(name);
        std::fs::read_to_string(path).expect("a file")
    };
    for name in ["api.yaml", "worker.yaml"] {
        let text = text(name);
        assert!(text.contains("UNWRAPD_METRICS_LISTEN"), "{name}");
        assert!(text.contains("name: metrics"), "{name}");
        assert!(text.contains("topologySpreadConstraints"), "{name}");
    }
    let tag = format!("newTag: \"{}\"", env!("CARGO_PKG_VERSION"));
    assert!(text("kustomization.yaml").contains(&tag), "{tag}");

    // What the pods of the service do, one after the other and at once, each with a folder of its own, as if they shared it.
    let api = text("api.yaml");
    let line = api.lines().find(|line| line.contains("args: [keys, add"));
    let line = line.expect("a key is added").trim();
    let arguments = line.trim_start_matches("args: [").trim_end_matches(']');
    let arguments: Vec<&str> = arguments.split(", ").collect();
    let folder = tempfile::tempdir().expect("a folder");
    let key = format!("uw_{}_{}", "0a".repeat(8), "5b".repeat(32));
    let add = |key: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_unwrapd"));
        command.args(&arguments).env("UNWRAPD_INITIAL_KEY", key);
        command.env("UNWRAPD_DATA", folder.path());
        command.output().expect("the program runs")
    };
    assert_status(&add(&key), 0);
    assert_status(&add(&key), 0);
    let other = format!("uw_{}_{}", "0a".repeat(8), "5c".repeat(32));
    assert_status(&add(&other), 1);
    assert_status(&add("secret"), 2);
    let data = folder.path().to_str().expect("text");
    let listed = unwrapd(&["keys", "list", "--data", data]);
    let listed = String::from_utf8(listed.stdout).expect("text");
    assert_eq!(listed.lines().count(), 2, "{listed}");
    assert!(
        listed.contains("valid\tadmin\tread,write,admin"),
        "{listed}"
    );
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
    let help = ["serve --help", "worker --help", "keys add --help"].map(of);
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

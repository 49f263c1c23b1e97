//! The layers of `src/`: who may import whom, and which outside crates a module may name.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use crate::places;

/// Module, the modules it builds on directly (what those may use it may use too), and the outside crates it may name.
/// Derives of `serde`, `utoipa`, `clap` and `thiserror` are allowed anywhere: the words of an option
/// are the variants of an enum, which is declared where it is used.
const LAYERS: &[(&str, &[&str], &[&str])] = &[
    ("options", &[], &["serde_json"]),
    ("numerics", &[], &["faer", "feral_metis", "robust", "rayon"]),
    ("mesh", &["numerics"], &["robust", "spade"]),
    ("cut", &["mesh"], &[]),
    ("energy", &["mesh"], &[]),
    ("barrier", &["energy"], &[]),
    ("solver", &["energy", "barrier"], &[]),
    ("embed", &["solver"], &["rayon"]),
    ("certificate", &["mesh"], &["rayon"]),
    ("charts", &["cut", "embed", "certificate"], &["rayon"]),
    ("atlas", &["embed", "certificate"], &["rayon"]),
    ("measure", &["certificate"], &["rayon"]),
    (
        "document",
        &["measure"],
        &[
            "serde_json",
            "draco_core",
            "meshopt",
            "bevy_mikktspace",
            "base64",
            "percent_encoding",
            "sha2",
        ],
    ),
    ("picture", &["measure"], &["image", "rayon"]),
    ("bake", &["document", "picture"], &["rayon"]),
    (
        "deform",
        &["embed", "picture", "options"],
        &["spade", "kurbo", "roxmltree", "serde_json"],
    ),
    (
        "pipeline",
        &["charts", "atlas", "bake", "deform"],
        &["serde_json", "rayon"],
    ),
    (
        "jobs",
        &["pipeline"],
        &[
            "tokio",
            "tokio_util",
            "serde_json",
            "uuid",
            "tracing",
            "nix",
            "futures_util",
        ],
    ),
    (
        "store",
        &["jobs"],
        &["sqlx", "tokio", "serde_json", "futures_util"],
    ),
    (
        "http",
        &["jobs"],
        &[
            "axum",
            "utoipa_axum",
            "tokio",
            "tokio_util",
            "tower_http",
            "serde_json",
            "tracing",
            "futures_util",
            "sha2",
            "percent_encoding",
        ],
    ),
    (
        "cli",
        &["http", "store"],
        &[
            "clap",
            "clap_complete",
            "clap_mangen",
            "indicatif",
            "serde_json",
            "tokio",
            "tokio_util",
            "tracing",
            "tracing_subscriber",
        ],
    ),
    ("lib", &["cli"], &[]),
    ("main", &["cli"], &["clap", "tikv_jemallocator"]),
];

const ANYWHERE: &[&str] = &[
    "crate",
    "self",
    "super",
    "std",
    "core",
    "alloc",
    "serde",
    "utoipa",
    "thiserror",
];

#[test]
fn nothing_is_imported_upwards() {
    let modules: BTreeSet<&str> = LAYERS.iter().map(|layer| layer.0).collect();
    let mut faults = Vec::new();
    for (module, _, crates) in LAYERS {
        let allowed = reachable(module);
        for file in files_of(module) {
            let text = fs::read_to_string(&file).expect("a source file is text");
            for (number, line) in text.lines().enumerate() {
                for name in crate_paths(line).filter(|name| modules.contains(name)) {
                    if !allowed.contains(name) {
                        faults.push(format!(
                            "{}:{}: {module} -> {name}",
                            file.display(),
                            number + 1
                        ));
                    }
                }
                if let Some(name) = imported_crate(line)
                    && !ANYWHERE.contains(&name)
                    && !crates.contains(&name)
                    && !is_local(&text, name)
                {
                    faults.push(format!(
                        "{}:{}: {module} -> {name}",
                        file.display(),
                        number + 1
                    ));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_module_has_a_layer() {
    let listed: BTreeSet<String> = LAYERS.iter().map(|layer| layer.0.to_string()).collect();
    let found: BTreeSet<String> = fs::read_dir(source())
        .expect("src can be listed")
        .filter_map(Result::ok)
        .filter_map(|entry| Some(entry.path().file_stem()?.to_str()?.to_string()))
        .collect();
    assert_eq!(listed, found);
}

fn source() -> PathBuf {
    places::repository("src")
}

/// The module and everything below it.
fn reachable(module: &str) -> BTreeSet<&'static str> {
    let direct: BTreeMap<&str, (&'static str, &[&'static str])> = LAYERS
        .iter()
        .map(|(name, below, _)| (*name, (*name, *below)))
        .collect();
    let mut found = BTreeSet::new();
    let mut open = vec![module];
    while let Some(name) = open.pop() {
        let (name, below) = direct[name];
        if found.insert(name) {
            open.extend(below);
        }
    }
    found
}

fn files_of(module: &str) -> Vec<PathBuf> {
    let single = source().join(format!("{module}.rs"));
    if single.is_file() {
        return vec![single];
    }
    let mut files = Vec::new();
    let mut folders = vec![source().join(module)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder)
            .expect("a module is a folder")
            .filter_map(Result::ok)
        {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// Names directly after `crate::` outside of comments.
fn crate_paths(line: &str) -> impl Iterator<Item = &str> {
    let code = line.split("//").next().unwrap_or("");
    code.split("crate::").skip(1).filter_map(|rest| {
        rest.split(|c: char| !c.is_alphanumeric() && c != '_')
            .next()
    })
}

/// The crate a `use` declaration names.
fn imported_crate(line: &str) -> Option<&str> {
    let path = line
        .trim_start()
        .trim_start_matches("pub ")
        .strip_prefix("use ")?;
    path.split(|c: char| !c.is_alphanumeric() && c != '_')
        .find(|name| !name.is_empty())
}

/// `use name::…` of a module or type the same file declares.
fn is_local(text: &str, name: &str) -> bool {
    text.lines().any(|line| {
        let line = line
            .trim_start()
            .trim_start_matches("pub(super) ")
            .trim_start_matches("pub ");
        ["mod ", "enum ", "struct "].iter().any(|kind| {
            line.strip_prefix(kind)
                .is_some_and(|rest| rest.trim_end_matches([';', '{', ' ']) == name)
        })
    })
}

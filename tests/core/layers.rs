//! The layers of `src/`: who may import whom, and which outside crates a module may name.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;
use std::rc::Rc;

use crate::places;

/// Module, the modules it builds on directly (what those may use it may use too), and the outside crates it may name.
/// Derives of `serde`, `utoipa`, `clap` and `thiserror` are allowed anywhere: the words of an option
/// are the variants of an enum, which is declared where it is used.
const LAYERS: &[(&str, &[&str], &[&str])] = &[
    ("options", &[], &["serde_json"]),
    (
        "numerics",
        &[],
        &["faer", "feral_metis", "pulp", "robust", "rayon"],
    ),
    ("mesh", &["numerics"], &["spade"]),
    ("plane", &["numerics"], &["static_aabb2d_index"]),
    ("cut", &["mesh"], &[]),
    ("energy", &["numerics"], &[]),
    ("barrier", &["energy"], &[]),
    ("solver", &["energy"], &[]),
    ("embed", &["mesh", "plane", "solver", "barrier"], &["rayon"]),
    ("charts", &["plane", "cut", "embed"], &["rayon"]),
    ("atlas", &["plane", "mesh", "solver", "barrier"], &["rayon"]),
    ("certificate", &["mesh"], &[]),
    ("measure", &["certificate"], &[]),
    (
        "document",
        &["mesh"],
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
    ("picture", &["mesh", "measure"], &["image"]),
    ("bake", &["document", "picture"], &["rayon"]),
    (
        "deform",
        &["plane", "embed", "picture", "options"],
        &["spade", "kurbo", "roxmltree", "serde_json"],
    ),
    (
        "pipeline",
        &[
            "charts",
            "atlas",
            "certificate",
            "measure",
            "bake",
            "deform",
        ],
        &["rayon"],
    ),
    (
        "jobs",
        &["pipeline"],
        &[
            "tokio",
            "tokio_util",
            "serde_json",
            "uuid",
            "metrics",
            "tracing",
            "nix",
            "futures_util",
            "getrandom",
            "sha2",
            "subtle",
            "url",
        ],
    ),
    (
        "store",
        &["jobs"],
        &[
            "sqlx",
            "object_store",
            "rustls",
            "tokio",
            "tracing",
            "tokio_util",
            "serde_json",
            "futures_util",
            "percent_encoding",
            "uuid",
        ],
    ),
    (
        "sessions",
        &["jobs"],
        &["tokio", "tokio_util", "serde_json", "tracing"],
    ),
    (
        "webhooks",
        &["jobs"],
        &[
            "base64",
            "hmac",
            "metrics",
            "reqwest",
            "rustls",
            "sha2",
            "tokio",
            "tokio_util",
            "tracing",
            "url",
        ],
    ),
    (
        "bulk",
        &["jobs"],
        &["tokio", "serde_json", "csv", "uuid", "reqwest", "rustls"],
    ),
    (
        "http",
        &["sessions", "webhooks"],
        &[
            "axum",
            "utoipa_axum",
            "hyper",
            "humantime",
            "hyper_util",
            "tokio",
            "tokio_io_timeout",
            "tokio_util",
            "tower_http",
            "serde_json",
            "metrics",
            "metrics_exporter_prometheus",
            "tracing",
            "tungstenite",
            "futures_util",
            "sha2",
            "flate2",
            "percent_encoding",
            "zip",
        ],
    ),
    (
        "cli",
        &["http", "store", "bulk"],
        &[
            "clap",
            "clap_complete",
            "clap_mangen",
            "humantime",
            "indicatif",
            "nix",
            "percent_encoding",
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

/// The judge, which [`JUDGES`] build on, and what it may name of the module that it shares with
/// those it judges: exact predicates.
const JUDGE: &str = "certificate";
const JUDGES: &str = "measure";
const SHARED: (&str, &str) = ("numerics", "predicates");

/// Crates whose derives may stand anywhere.
const ANYWHERE: &[&str] = &["clap", "serde", "utoipa", "thiserror"];

#[test]
fn nothing_is_imported_upwards() {
    let modules: BTreeSet<&str> = LAYERS.iter().map(|layer| layer.0).collect();
    let dependencies = dependencies();
    let mut faults = Vec::new();
    for (module, _, crates) in LAYERS {
        let allowed = reachable(module);
        for (place, text, code) in code_of(module) {
            let crates_named = dependencies.iter().filter(|name| {
                let is_allowed = |name| ANYWHERE.contains(&name) || crates.contains(&name);
                names_crate(&code, name) && !is_allowed(name.as_str()) && !is_local(&text, name)
            });
            let modules_named = crate_paths(&code).filter(|name| !allowed.contains(name));
            let named = crates_named.map(String::as_str);
            let named = named.chain(modules_named.filter(|name| modules.contains(name)));
            faults.extend(named.map(|name| format!("{place}: {module} -> {name}")));
            if code.contains("crate::{") {
                faults.push(format!("{place}: one `use` for each module"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// What is permitted is needed, so that the table shows how things are.
#[test]
fn nothing_is_permitted_in_vain() {
    let mut faults = Vec::new();
    for (module, below, crates) in LAYERS
        .iter()
        .filter(|layer| !["lib", "main"].contains(&layer.0))
    {
        let lines = code_of(module);
        for name in *below {
            let is_used = |(_, _, code): &(_, _, String)| crate_paths(code).any(|n| n == *name);
            if !lines.iter().any(is_used) {
                faults.push(format!("{module} does not import {name}"));
            }
        }
        for name in *crates {
            let is_used = |(_, _, code): &(_, _, String)| names_crate(code, name);
            if !lines.iter().any(is_used) {
                faults.push(format!("{module} does not name {name}"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The judge names the exact predicates and the types of meshes, and nothing else that makers of
/// UVs use.
#[test]
fn the_judge_shares_predicates_only() {
    let (module, only) = SHARED;
    let path = format!("crate::{module}::");
    for (place, _, code) in code_of(JUDGE) {
        let is_shared = |rest: &str| rest.starts_with(only);
        assert!(code.split(&path).skip(1).all(is_shared), "{place}: {code}");
    }
}

/// Handlers see as far as their callers.
#[test]
fn no_handler_sees_everything() {
    let all = code_of("http").into_iter();
    let everything =
        all.filter(|(_, _, code)| code.contains("Reach::") || code.contains("anonymous()"));
    let places: Vec<String> = everything.map(|(place, _, _)| place).collect();
    assert!(places.is_empty(), "{places:?}");
}

#[test]
fn every_module_has_a_layer() {
    let listed: BTreeSet<String> = LAYERS.iter().map(|layer| layer.0.to_string()).collect();
    let found: BTreeSet<String> = fs::read_dir(source())
        .expect("src can be listed")
        .filter_map(Result::ok)
        // A folder with a manifest is a crate of its own, one with `__init__.py` a package of Python.
        .filter(|entry| {
            let has = |name: &str| entry.path().join(name).is_file();
            !has("Cargo.toml") && !has("__init__.py")
        })
        .filter_map(|entry| Some(entry.path().file_stem()?.to_str()?.to_string()))
        .collect();
    assert_eq!(listed, found);
}

fn source() -> PathBuf {
    places::repository("src")
}

/// The module and everything below it; the judge is not passed on by those who build on it to
/// judge.
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
            let is_own = name == module || name != JUDGES;
            open.extend(below.iter().filter(|below| is_own || **below != JUDGE));
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

/// Every line of a module: where it stands, the text of its file, the line without comment.
fn code_of(module: &str) -> Vec<(String, Rc<str>, String)> {
    let mut lines = Vec::new();
    for file in files_of(module) {
        let text: Rc<str> = fs::read_to_string(&file)
            .expect("a source file is text")
            .into();
        for (number, line) in (1..).zip(text.lines()) {
            let place = format!("{}:{number}", file.display());
            let code = line.split("//").next().unwrap_or_default();
            lines.push((place, Rc::clone(&text), code.to_owned()));
        }
    }
    lines
}

/// Names directly after `crate::`.
fn crate_paths(code: &str) -> impl Iterator<Item = &str> {
    let after = code.split("crate::").skip(1);
    after.filter_map(|rest| rest.split(|c: char| !is_of_name(c)).next())
}

/// The crates that `Cargo.toml` lists, as code names them.
fn dependencies() -> Vec<String> {
    let manifest = fs::read_to_string(places::repository("Cargo.toml")).expect("a manifest");
    let after = manifest
        .lines()
        .skip_while(|line| *line != "[dependencies]")
        .skip(1);
    let listed = after.take_while(|line| !line.starts_with('['));
    let names = listed.filter_map(|line| line.split_once(" = "));
    names.map(|(name, _)| name.replace('-', "_")).collect()
}

/// Whether a line names a crate: in a path that begins with it, or in a `use` of its own.
fn names_crate(code: &str, name: &str) -> bool {
    code.match_indices(name).any(|(at, _)| {
        let (before, after) = (&code[..at], &code[at + name.len()..]);
        let is_within =
            |text: &str| text.ends_with(|c: char| is_of_name(c) || c == ':' || c == '>');
        // A path may begin with `::`.
        let before = before
            .strip_suffix("::")
            .filter(|b| !is_within(b))
            .unwrap_or(before);
        let is_alone = before.trim_end().ends_with("use") && after.starts_with([';', ' ']);
        !is_within(before) && (after.starts_with("::") || is_alone)
    })
}

fn is_of_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Whether `name::…` is a module or type that the same file declares.
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

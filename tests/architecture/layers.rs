//! Imports between the modules of each crate in `src/`. Between crates the manifests decide.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use crate::places;

/// A crate's folder, and its modules with those that each may import.
type Crate = (
    &'static str,
    &'static [(&'static str, &'static [&'static str])],
);

const LAYERS: &[Crate] = &[
    (
        "src/method/src",
        &[
            ("numerics", &[]),
            ("energy", &["numerics"]),
            ("barrier", &["numerics", "energy"]),
            ("solver", &["numerics", "energy"]),
        ],
    ),
    (
        "src/maps/src",
        &[
            ("mesh", &[]),
            ("plane", &[]),
            ("cut", &["mesh"]),
            ("embed", &["mesh", "plane"]),
            ("certificate", &["mesh"]),
            ("measure", &["mesh", "certificate"]),
        ],
    ),
    (
        "src/layout/src",
        &[("charts", &[]), ("atlas", &[]), ("search", &["charts"])],
    ),
    (
        "src/files/src",
        &[
            ("polygon", &[]),
            ("io", &["polygon"]),
            ("document", &["io", "polygon"]),
            ("picture", &[]),
            ("bake", &["document", "picture"]),
        ],
    ),
    ("src/api/src", &[("options", &[])]),
    (
        "src/server/src",
        &[
            ("jobs", &[]),
            ("store", &["jobs"]),
            ("sessions", &["jobs"]),
            ("webhooks", &["jobs"]),
            ("http", &["jobs", "sessions", "webhooks"]),
        ],
    ),
    ("src", &[("bulk", &[]), ("cli", &["bulk"])]),
];

/// The judge of maps shares only exact predicates with those that make them.
const JUDGE: &str = "certificate";
const SHARED: &str = "predicates";

#[test]
fn modules_import_only_those_below() {
    let mut faults = Vec::new();
    for (folder, modules) in LAYERS {
        let names: Vec<&str> = modules.iter().map(|(name, _)| *name).collect();
        for (module, below) in *modules {
            for (place, code) in code_of(folder, module) {
                let named = after(&code, "crate::");
                let upward = named
                    .filter(|name| names.contains(name) && name != module && !below.contains(name));
                faults.extend(upward.map(|name| format!("{place}: {module} -> {name}")));
                if code.contains("crate::{") {
                    faults.push(format!("{place}: one `use` for each module"));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A permission that nobody needs would hide how things are.
#[test]
fn every_permission_is_used() {
    let mut faults = Vec::new();
    for (folder, modules) in LAYERS {
        for (module, below) in *modules {
            let lines = code_of(folder, module);
            let is_used = |name: &str| {
                (lines.iter()).any(|(_, code)| after(code, "crate::").any(|named| named == name))
            };
            let vain = below.iter().filter(|name| !is_used(name));
            faults.extend(vain.map(|name| format!("{module} does not import {name}")));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_judge_shares_predicates_only() {
    for (place, code) in code_of("src/maps/src", JUDGE) {
        let mut shared = after(&code, "unwrapd_method::numerics::");
        assert!(shared.all(|name| name == SHARED), "{place}: {code}");
        let mut others = after(&code, "unwrapd_method::");
        assert!(others.all(|name| name == "numerics"), "{place}: {code}");
    }
}

#[test]
fn makers_of_maps_do_not_ask_the_judge() {
    for module in ["charts", "atlas", "search"] {
        for (place, code) in code_of("src/layout/src", module) {
            let mut named = after(&code, "unwrapd_maps::");
            assert!(named.all(|name| name != JUDGE), "{place}: {code}");
        }
    }
}

/// Handlers reach only the jobs that their callers may see.
#[test]
fn no_handler_sees_everything() {
    let all = code_of("src/server/src", "http").into_iter();
    let everything =
        all.filter(|(_, code)| code.contains("Visibility::") || code.contains("anonymous()"));
    let places: Vec<String> = everything.map(|(place, _)| place).collect();
    assert!(places.is_empty(), "{places:?}");
}

#[test]
fn every_module_has_a_layer() {
    for (folder, modules) in LAYERS {
        let listed: BTreeSet<String> = modules.iter().map(|(name, _)| (*name).to_owned()).collect();
        let found: BTreeSet<String> = fs::read_dir(places::repository(folder))
            .expect("a crate has sources")
            .filter_map(Result::ok)
            .map(|entry| entry.path())
            .filter_map(|path| {
                let name = path.file_stem()?.to_str()?.to_owned();
                // A listed module may be one file; files beside it are part of no module.
                let is_module = path.join("mod.rs").is_file() || listed.contains(&name);
                is_module.then_some(name)
            })
            .collect();
        assert_eq!(listed, found, "{folder}");
    }
}

/// Every line of a module without its comment, and where it stands.
fn code_of(folder: &str, module: &str) -> Vec<(String, String)> {
    let mut lines = Vec::new();
    let mut folders = vec![places::repository(folder).join(module)];
    let mut files: Vec<PathBuf> = Vec::new();
    let alone = folders[0].with_extension("rs");
    if alone.is_file() {
        folders.clear();
        files.push(alone);
    }
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder)
            .expect("a module is a folder")
            .flatten()
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
    for file in files {
        let text = fs::read_to_string(&file).expect("a source file is text");
        for (number, line) in (1..).zip(text.lines()) {
            let code = line.split("//").next().unwrap_or_default();
            lines.push((format!("{}:{number}", file.display()), code.to_owned()));
        }
    }
    lines
}

/// Names directly after a prefix.
fn after<'a>(code: &'a str, prefix: &'a str) -> impl Iterator<Item = &'a str> {
    let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
    (code.split(prefix).skip(1)).filter_map(move |rest| rest.split(|c: char| !is_of_name(c)).next())
}

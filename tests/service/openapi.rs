//! The OpenAPI document.

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::Value;

use crate::places;

const STORED: &str = include_str!("../../openapi/openapi.json");

pub fn stored() -> Value {
    serde_json::from_str(STORED).expect("JSON")
}

#[test]
fn the_stored_document_is_fresh() {
    let fresh = unwrapd::http::openapi();
    let (fresh, stored) = (
        fresh.lines().collect::<Vec<_>>(),
        STORED.lines().collect::<Vec<_>>(),
    );
    let differs = fresh.iter().zip(&stored).find(|(new, old)| new != old);
    let hint = "run: unwrapd openapi > openapi/openapi.json";
    assert_eq!((differs, fresh.len()), (None, stored.len()), "{hint}");
}

#[test]
fn every_operation_says_what_it_answers() {
    let document = stored();
    assert!(
        document["openapi"]
            .as_str()
            .is_some_and(|version| version.starts_with("3.1"))
    );
    let mut ids = Vec::new();
    for (path, methods) in document["paths"].as_object().expect("paths") {
        for (method, operation) in methods.as_object().expect("methods") {
            ids.push(operation["operationId"].as_str().expect("an id"));
            assert!(operation["summary"].is_string(), "{method} {path}");
            for (status, answer) in operation["responses"].as_object().expect("answers") {
                let described = answer["description"].as_str();
                assert!(
                    described.is_some_and(|text| !text.is_empty()),
                    "{method} {path} {status}"
                );
            }
        }
    }
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count, "each has its own id");
}

/// The words of every `fn code(&self)` in the sources.
fn codes(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            codes(&path, found);
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("text");
        let bodies = text.split("fn code(&self) -> &'static str {").skip(1);
        let bodies = bodies.map(|rest| rest.split("\n    }\n").next().unwrap_or_default());
        let words = bodies.flat_map(|body| body.split("=> \"").skip(1));
        let words = words.filter_map(|rest| rest.split_once('"'));
        found.extend(words.map(|(word, _)| word.to_owned()));
    }
}

#[test]
fn every_code_of_an_input_is_in_the_table() {
    let document = stored();
    let table = document["x-problems"].as_array().expect("a table").iter();
    let table: Vec<&str> = table.filter_map(|row| row["code"].as_str()).collect();
    let mut found = BTreeSet::new();
    codes(&places::repository("src"), &mut found);
    assert!(
        found.contains("unknown_handle") && found.contains("folded_mesh"),
        "{found:?}"
    );
    let missing: Vec<_> = found
        .iter()
        .filter(|word| !table.contains(&word.as_str()))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
    let distinct: BTreeSet<_> = table.iter().collect();
    assert_eq!(distinct.len(), table.len(), "a code has one meaning");
}

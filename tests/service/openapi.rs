//! The OpenAPI document.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde_json::Value;

use crate::places;

const STORED: &str = include_str!("../../openapi/openapi.json");

pub fn stored() -> Value {
    serde_json::from_str(STORED).expect("JSON")
}

#[test]
fn the_stored_document_is_fresh() {
    let fresh = unwrapd::http::openapi(&unwrapd_worker::Computations);
    let (fresh, stored) = (
        fresh.lines().collect::<Vec<_>>(),
        STORED.lines().collect::<Vec<_>>(),
    );
    let differs = fresh.iter().zip(&stored).find(|(new, old)| new != old);
    let hint = "run: unwrapd openapi > openapi/openapi.json";
    assert_eq!((differs, fresh.len()), (None, stored.len()), "{hint}");
}

#[test]
fn every_schema_that_is_named_exists() {
    let document = stored();
    let named = STORED.split("\"#/components/schemas/").skip(1);
    let named: BTreeSet<&str> = named.filter_map(|rest| rest.split('"').next()).collect();
    assert!(20 < named.len());
    let schemas = &document["components"]["schemas"];
    let missing: Vec<_> = named
        .iter()
        .filter(|name| schemas[name].is_null())
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
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

/// The codes that the sources produce: the words of every `fn code(&self)`, those of failures made
/// in place, and those of the service's own that its handlers name.
fn produced_codes() -> BTreeSet<String> {
    let own = own_codes();
    let mut found = BTreeSet::new();
    for text in sources(&places::repository("src")) {
        let bodies = text.split("fn code(&self) -> &'static str {").skip(1);
        let bodies = bodies.filter_map(|rest| rest.split("\n    }\n").next());
        let lines = bodies.flat_map(str::lines);
        for line in lines.filter(|line| !line.trim_start().starts_with("#[")) {
            found.extend(line.split('"').nth(1).map(str::to_owned));
        }
        for failure in text.split("Failure::new(").skip(1).map(str::trim_start) {
            let literal = failure.strip_prefix('"');
            found.extend(
                literal
                    .and_then(|rest| rest.split('"').next())
                    .map(str::to_owned),
            );
        }
        for argument in text.split("::new(").skip(1).map(str::trim_start) {
            let variant = argument.strip_prefix("Code::");
            found.extend(variant.map(|rest| own[identifier(rest)].clone()));
        }
    }
    found
}

/// The words of the service's own codes, by their variants.
fn own_codes() -> BTreeMap<String, String> {
    let path = places::repository("src/server/src/http/problem.rs");
    let text = std::fs::read_to_string(path).expect("text");
    let rows = text.split("\ncodes! {\n").nth(1).expect("a table");
    let rows = rows.lines().filter(|line| line.contains(" => ("));
    let word = |name: &str| {
        let row = text.split(&format!("    {name} => (")).nth(1);
        row.and_then(|row| row.split('"').nth(1))
            .expect("a word")
            .to_owned()
    };
    rows.map(|row| identifier(row.trim_start()))
        .map(|name| (name.to_owned(), word(name)))
        .collect()
}

fn identifier(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_alphanumeric());
    &text[..end.unwrap_or(text.len())]
}

fn sources(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(std::fs::read_to_string(&path).expect("text"));
        }
    }
    found
}

#[test]
fn the_codes_documented_are_those_produced() {
    let document = stored();
    let rows = document["x-problems"].as_array().expect("a table").iter();
    let table: Vec<String> = rows
        .filter_map(|row| row["code"].as_str().map(str::to_owned))
        .collect();
    let documented: BTreeSet<String> = table.iter().cloned().collect();
    assert_eq!(documented.len(), table.len(), "a code has one meaning");
    let produced = produced_codes();
    let missing: Vec<_> = produced.difference(&documented).collect();
    assert!(missing.is_empty(), "not documented: {missing:?}");
    let stale: Vec<_> = documented.difference(&produced).collect();
    assert!(stale.is_empty(), "produced nowhere: {stale:?}");
}

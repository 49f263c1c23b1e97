//! Selection of the files that an input references. A job keeps its files for weeks, and unused ones would waste
//! space.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

use serde_json::Value;

use super::problem::Problem;
use unwrapd_api::{Catalog, Content, Format, Kind, START, Upload};

/// Lock that lets only one input at a time be in memory to find its references: it may be as large as an upload.
static ONE_INPUT: Mutex<()> = Mutex::new(());

/// Returns the names among `known` that an input of a kind references. `input` reads the input, and `material` a
/// material file by name. An input without other files is not read.
pub(super) fn referenced(
    catalog: &dyn Catalog,
    kind: Kind,
    name: &str,
    known: &BTreeSet<String>,
    input: impl FnOnce() -> Result<Vec<u8>, Problem>,
    material: impl FnMut(&str) -> Result<Vec<u8>, Problem>,
) -> Result<BTreeSet<String>, Problem> {
    if known.is_empty() {
        return Ok(BTreeSet::new());
    }
    let _one_input = ONE_INPUT.lock().unwrap_or_else(PoisonError::into_inner);
    let bytes = input()?;
    let mut names = match kind.reads() {
        Content::Problem => of_problem(&bytes, known),
        _ => of_surface(catalog, Upload::single(name, bytes), known, material)?,
    };
    names.insert(START.to_owned());
    Ok(names.intersection(known).cloned().collect())
}

/// Returns the references of a mesh and of its material files. Only OBJ has material files.
fn of_surface(
    catalog: &dyn Catalog,
    mut upload: Upload,
    known: &BTreeSet<String>,
    mut material: impl FnMut(&str) -> Result<Vec<u8>, Problem>,
) -> Result<BTreeSet<String>, Problem> {
    let names = catalog.references(&upload);
    if catalog.format_of(&upload) != Some(Format::Obj) {
        return Ok(names);
    }
    for name in names.intersection(known) {
        let content = material(name)?;
        upload.resources.insert(name.clone(), content);
    }
    Ok(catalog.references(&upload))
}

/// Returns the files named by the strings of a problem file, by path or by name alone. If it is not JSON, returns all
/// files; it is rejected later.
fn of_problem(bytes: &[u8], known: &BTreeSet<String>) -> BTreeSet<String> {
    let Ok(problem) = serde_json::from_slice::<Value>(bytes) else {
        return known.clone();
    };
    let mut words = BTreeSet::new();
    gather_words(&problem, &mut words);
    let names = words
        .iter()
        .flat_map(|word| [Some(*word), word.rsplit('/').next()]);
    let names: BTreeSet<&str> = names.flatten().collect();
    let is_named = |name: &&String| names.contains(name.as_str());
    known.iter().filter(is_named).cloned().collect()
}

fn gather_words<'a>(value: &'a Value, words: &mut BTreeSet<&'a str>) {
    match value {
        Value::String(word) => drop(words.insert(word)),
        Value::Array(values) => values.iter().for_each(|value| gather_words(value, words)),
        Value::Object(members) => members
            .values()
            .for_each(|value| gather_words(value, words)),
        _ => {}
    }
}

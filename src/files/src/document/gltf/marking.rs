//! The mark in `asset.extras`.
use super::json::{object_mut, remove};
use crate::document::mark::Mark;
use crate::document::{DocumentError, Warning};
use serde_json::{Map, Value};

/// Member of `asset.extras`.
const NAME: &str = "unwrapd";

/// Returns the value in the place of a mark.
pub(super) fn mark(json: &Value) -> Option<&Value> {
    json.get("asset")?.get("extras")?.get(NAME)
}

/// Sets the mark of the document. Returns a warning if the extras are not an object and so have no place for one.
pub(super) fn set(json: &mut Value, mark: &Mark) -> Result<Option<Warning>, DocumentError> {
    let extras = object_mut(&mut json["asset"])?.entry("extras");
    let extras = extras.or_insert_with(|| Value::Object(Map::new()));
    if let Value::Object(members) = extras {
        members.insert(NAME.to_owned(), mark.value());
        return Ok(None);
    }
    Ok(Some(Warning::new(
        "not_marked",
        "`asset.extras` is not an object, so the file cannot record which UVs were written: give `verify` the UV set",
    )))
}

/// Removes the mark, and extras that had nothing else.
pub(super) fn clear(json: &mut Value) {
    let Some(extras) = json.pointer_mut("/asset/extras") else {
        return;
    };
    if remove(extras, NAME).is_some() && extras.as_object().is_some_and(Map::is_empty) {
        remove(&mut json["asset"], "extras");
    }
}

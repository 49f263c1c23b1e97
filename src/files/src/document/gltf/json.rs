//! Checked access to the JSON document: every member may be missing or of the wrong type.
use crate::document::DocumentError;
use serde_json::{Map, Value};

/// Creates an error that names the broken rule of glTF.
pub(super) fn invalid(message: impl Into<String>) -> DocumentError {
    DocumentError::InvalidGltf(message.into())
}

/// Returns the elements of an array member; an empty slice if it is missing.
pub(super) fn items<'a>(parent: &'a Value, key: &str) -> Result<&'a [Value], DocumentError> {
    match parent.get(key) {
        None => Ok(&[]),
        Some(Value::Array(items)) => Ok(items),
        Some(_) => Err(invalid(format!("`{key}` is not an array"))),
    }
}

/// Returns object `index` of the top-level array `collection`.
pub(super) fn item<'a>(
    root: &'a Value,
    collection: &str,
    index: usize,
) -> Result<&'a Value, DocumentError> {
    items(root, collection)?
        .get(index)
        .filter(|item| item.is_object())
        .ok_or_else(|| invalid(format!("{collection}[{index}] does not exist")))
}

/// Returns a member that is an index, a count or a code; `None` if it is missing.
pub(super) fn unsigned(parent: &Value, key: &str) -> Result<Option<usize>, DocumentError> {
    parent
        .get(key)
        .map(|value| {
            as_unsigned(value).ok_or_else(|| invalid(format!("`{key}` is not a whole number")))
        })
        .transpose()
}

/// Like [`unsigned`], for a member that glTF requires.
pub(super) fn required(parent: &Value, key: &str) -> Result<usize, DocumentError> {
    unsigned(parent, key)?.ok_or_else(|| invalid(format!("`{key}` is missing")))
}

/// Returns a whole number, also if it is written as `1.0`.
pub(super) fn as_unsigned(value: &Value) -> Option<usize> {
    let whole = |number: &f64| (0.0..9.0e15).contains(number) && number.fract() == 0.0;
    value
        .as_u64()
        .or_else(|| value.as_f64().filter(whole).map(|number| number as u64))
        .and_then(|number| usize::try_from(number).ok())
}

/// Returns the extension `name` of an object.
pub(super) fn extension<'a>(parent: &'a Value, name: &str) -> Option<&'a Value> {
    parent.get("extensions")?.get(name)
}

/// Removes the extension `name` of an object, and the `extensions` member with the last of them.
pub(super) fn remove_extension(parent: &mut Value, name: &str) -> Option<Value> {
    let extensions = parent.get_mut("extensions")?.as_object_mut()?;
    let removed = extensions.shift_remove(name)?;
    if extensions.is_empty() {
        remove(parent, "extensions");
    }
    Some(removed)
}

/// Removes a member and keeps the order of the others.
pub(super) fn remove(parent: &mut Value, key: &str) -> Option<Value> {
    parent.as_object_mut()?.shift_remove(key)
}

/// Returns the array member `key`, creating it if it is missing.
pub(super) fn array_mut<'a>(
    parent: &'a mut Value,
    key: &str,
) -> Result<&'a mut Vec<Value>, DocumentError> {
    object_mut(parent)?
        .entry(key)
        .or_insert_with(|| Value::Array(Vec::new()))
        .as_array_mut()
        .ok_or_else(|| invalid(format!("`{key}` is not an array")))
}

/// Returns element `index` of the top-level array `collection` for modification.
pub(super) fn item_mut<'a>(
    root: &'a mut Value,
    collection: &str,
    index: usize,
) -> Result<&'a mut Value, DocumentError> {
    array_mut(root, collection)?
        .get_mut(index)
        .filter(|item| item.is_object())
        .ok_or_else(|| invalid(format!("{collection}[{index}] does not exist")))
}

/// Returns the members of an object for modification.
pub(super) fn object_mut(value: &mut Value) -> Result<&mut Map<String, Value>, DocumentError> {
    value
        .as_object_mut()
        .ok_or_else(|| invalid("a value that must be an object has another type"))
}

/// Returns primitive `primitive` of mesh `mesh` for modification.
pub(super) fn primitive_mut(
    root: &mut Value,
    mesh: usize,
    primitive: usize,
) -> Result<&mut Value, DocumentError> {
    array_mut(item_mut(root, "meshes", mesh)?, "primitives")?
        .get_mut(primitive)
        .filter(|item| item.is_object())
        .ok_or_else(|| invalid(format!("mesh {mesh} has no primitive {primitive}")))
}

//! Modes of primitives.
use super::json::{invalid, unsigned};
use crate::document::DocumentError;
use serde_json::Value;

/// Arrangement of vertices into faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    Triangles,
    Strip,
    Fan,
}

/// Returns the mode of a primitive; `None` for points and lines.
pub(super) fn mode(primitive: &Value) -> Result<Option<Mode>, DocumentError> {
    Ok(match unsigned(primitive, "mode")?.unwrap_or(4) {
        4 => Some(Mode::Triangles),
        5 => Some(Mode::Strip),
        6 => Some(Mode::Fan),
        0..=3 => None,
        _ => return Err(invalid("unknown primitive `mode`")),
    })
}

/// Returns the POSITION accessor of a primitive with faces.
pub(super) fn position_accessor(primitive: &Value) -> Result<Option<usize>, DocumentError> {
    if mode(primitive)?.is_none() {
        return Ok(None);
    }
    match primitive.get("attributes") {
        None => Ok(None),
        Some(attributes) if attributes.is_object() => unsigned(attributes, "POSITION"),
        Some(_) => Err(invalid("`attributes` is not an object")),
    }
}

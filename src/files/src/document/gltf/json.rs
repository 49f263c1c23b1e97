//! Checked access to the JSON document: every member may be missing or of the wrong type.

use crate::document::DocumentError;
use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};
use std::fmt;
use std::ops::AddAssign;

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
    value
        .as_u64()
        .or_else(|| {
            value
                .as_f64()
                .filter(|number: &f64| (0.0..9.0e15).contains(number) && number.fract() == 0.0)
                .map(|number| number as u64)
        })
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

// Memory of a document's JSON, computed before it is read.

/// Most bytes of the JSON as read and as written, which exist at the same time.
const MOST: usize = 960 << 20;

/// Size of a value.
const VALUE: usize = size_of::<Value>();
/// Size of a member of an object without its value: its name, and its hash.
const MEMBER: usize = size_of::<String>() + 8;
/// Least allocation for a name.
const NAME: usize = 16;

/// Bytes of values in memory.
#[derive(Clone, Copy, Default)]
pub(super) struct MemorySize {
    /// After parsing a text: arrays grow by doubling.
    read: usize,
    /// After copying: arrays have their exact length.
    copied: usize,
}

/// Parses the JSON of a text; refuses it beforehand if it would take too much memory.
pub(super) fn parse(text: &[u8]) -> Result<Value, DocumentError> {
    let not_json = |error: serde_json::Error| invalid(format!("not JSON: {error}"));
    let size: MemorySize = serde_json::from_slice(text).map_err(not_json)?;
    size.check()?;
    serde_json::from_slice(text).map_err(not_json)
}

impl MemorySize {
    /// Returns the size of an existing value.
    pub fn of(value: &Value) -> Self {
        let mut size = Self::VALUE;
        match value {
            Value::Array(items) => {
                for item in items {
                    size += Self::of(item);
                }
                size.hold_items(items.len());
            }
            Value::Object(members) => {
                for (name, member) in members {
                    size += Self::of(member);
                    size.hold_name(name.len());
                }
                size.hold_members(members.len());
            }
            _ => {}
        }
        size
    }

    /// Returns `n` times the size.
    pub fn times(self, n: usize) -> Self {
        Self {
            read: self.read.saturating_mul(n),
            copied: self.copied.saturating_mul(n),
        }
    }

    /// Refuses sizes beyond the limit.
    pub fn check(self) -> Result<(), DocumentError> {
        let total = self.read.saturating_add(self.copied);
        if total <= MOST {
            return Ok(());
        }
        let [takes, most] = [total, MOST].map(|bytes| bytes.div_ceil(1 << 20));
        Err(DocumentError::LimitExceeded(format!(
            "the JSON needs {takes} MiB of memory; the limit is {most} MiB"
        )))
    }

    /// A value without contents. Text is as long as in the file, and not counted.
    const VALUE: Self = Self {
        read: VALUE,
        copied: VALUE,
    };

    /// Adds the unused capacity of an array of `n` items; the items themselves are counted elsewhere.
    fn hold_items(&mut self, n: usize) {
        if n > 0 {
            self.read += VALUE * (n.next_power_of_two().max(4) - n);
        }
    }

    /// Adds the table, keys and unused capacity of an object of `n` members; their values are counted elsewhere.
    fn hold_members(&mut self, n: usize) {
        if n > 0 {
            let slots = (n * 8 / 7 + 1).next_power_of_two().max(4);
            let table = slots * 9 + 16;
            let room = (slots / 8 * 7).max(3).max(n);
            self.read += table + MEMBER * room + VALUE * (room - n);
            self.copied += table + MEMBER * n;
        }
    }

    fn hold_name(&mut self, length: usize) {
        let length = length.max(NAME);
        self.read += length;
        self.copied += length;
    }
}

impl AddAssign for MemorySize {
    fn add_assign(&mut self, other: Self) {
        self.read = self.read.saturating_add(other.read);
        self.copied = self.copied.saturating_add(other.copied);
    }
}

impl<'de> Deserialize<'de> for MemorySize {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Counter)
    }
}

/// Visitor that adds up sizes.
struct Counter;

impl<'de> Visitor<'de> for Counter {
    type Value = MemorySize;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("JSON")
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<MemorySize, E> {
        Ok(MemorySize::VALUE)
    }

    fn visit_i64<E: Error>(self, _: i64) -> Result<MemorySize, E> {
        Ok(MemorySize::VALUE)
    }

    fn visit_u64<E: Error>(self, _: u64) -> Result<MemorySize, E> {
        Ok(MemorySize::VALUE)
    }

    fn visit_f64<E: Error>(self, _: f64) -> Result<MemorySize, E> {
        Ok(MemorySize::VALUE)
    }

    fn visit_str<E: Error>(self, _: &str) -> Result<MemorySize, E> {
        Ok(MemorySize::VALUE)
    }

    fn visit_unit<E: Error>(self) -> Result<MemorySize, E> {
        Ok(MemorySize::VALUE)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<MemorySize, A::Error> {
        let (mut size, mut n) = (MemorySize::VALUE, 0);
        while let Some(item) = items.next_element::<MemorySize>()? {
            size += item;
            n += 1;
        }
        size.hold_items(n);
        Ok(size)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut members: A) -> Result<MemorySize, A::Error> {
        let (mut size, mut n) = (MemorySize::VALUE, 0);
        while members.next_key::<IgnoredAny>()?.is_some() {
            size += members.next_value::<MemorySize>()?;
            size.hold_name(0);
            n += 1;
        }
        size.hold_members(n);
        Ok(size)
    }
}

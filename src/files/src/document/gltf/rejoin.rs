//! Joins vertices that were split at the seams of a replaced UV set.
use super::GltfDocument;
use super::accessor::Accessor;
use super::json::{as_unsigned, invalid, items};
use crate::document::DocumentError;
use serde_json::Value;
use std::collections::HashMap;
use std::hash::Hash;

/// Vertices after joining.
pub(super) struct Rejoined {
    /// Old vertices that stay, in increasing order.
    pub kept: Vec<u32>,
    /// New number of each old vertex.
    pub numbers: Vec<u32>,
}

/// Joins the vertices of primitive `index` that differ only in the attributes missing from `changed`, its new JSON.
/// Vertices that were duplicates before the split stay so: among those that agree in everything except the old UVs, the
/// first of each UV are joined, then the second, and so on. Returns `None` if there is nothing to join.
pub(super) fn rejoined(
    document: &GltfDocument,
    index: usize,
    changed: &Value,
) -> Result<Option<Rejoined>, DocumentError> {
    let primitive = &document.primitives[index];
    let old = document.object(primitive)?;
    if old.get("indices").is_none() {
        return Ok(None);
    }
    let n = primitive.positions.len();
    let used = document.used[index].as_deref();
    let element = |vertex: usize| used.map_or(vertex, |used| used[vertex] as usize);
    let mut classes = vec![0; n];
    let mut seen = vec![false; n];
    for &vertex in primitive.triangles.as_flattened() {
        seen[vertex as usize] = true;
    }
    // A vertex without a face was not split, and is in a class of its own.
    classes = refined(&classes, |v| (!seen[v]).then_some(v));
    let rest = accessors(changed)?;
    for &accessor in &rest {
        let (packed, size) = packed(document, accessor)?;
        classes = refined(&classes, |v| &packed[element(v) * size..][..size]);
    }
    let mut of_set = vec![0; n];
    for accessor in accessors(old)?.into_iter().filter(|a| !rest.contains(a)) {
        let (packed, size) = packed(document, accessor)?;
        of_set = refined(&of_set, |v| &packed[element(v) * size..][..size]);
    }
    let mut twins: HashMap<(u32, u32), u32> = HashMap::new();
    let ranks: Vec<u32> = (0..n)
        .map(|v| {
            let rank = twins.entry((classes[v], of_set[v])).or_default();
            *rank += 1;
            *rank
        })
        .collect();
    let numbers = refined(&classes, |v| ranks[v]);
    let mut kept: Vec<u32> = Vec::new();
    for (vertex, &number) in numbers.iter().enumerate() {
        if number as usize == kept.len() {
            kept.push(vertex as u32);
        }
    }
    Ok((kept.len() < n).then_some(Rejoined { kept, numbers }))
}

/// Divides classes by a key, numbered in the order of their first members.
fn refined<K: Eq + Hash>(classes: &[u32], key: impl Fn(usize) -> K) -> Vec<u32> {
    let mut numbers = HashMap::with_capacity(classes.len());
    let of = |(v, class): (usize, &u32)| {
        let next = numbers.len() as u32;
        *numbers.entry((*class, key(v))).or_insert(next)
    };
    classes.iter().enumerate().map(of).collect()
}

/// Returns the bytes of an accessor and the size of one element.
fn packed(document: &GltfDocument, index: usize) -> Result<(Vec<u8>, usize), DocumentError> {
    let accessor = Accessor::open(&document.body, index)?;
    Ok((accessor.packed()?, accessor.element_size))
}

/// Returns the accessors of all attributes and morph targets.
fn accessors(primitive: &Value) -> Result<Vec<usize>, DocumentError> {
    let sets = std::iter::once(&primitive["attributes"]).chain(items(primitive, "targets")?);
    let values = sets
        .filter_map(Value::as_object)
        .flat_map(|set| set.values());
    values
        .map(|value| {
            as_unsigned(value).ok_or_else(|| invalid("an attribute is not an accessor index"))
        })
        .collect()
}

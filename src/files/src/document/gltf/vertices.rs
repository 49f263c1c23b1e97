//! Vertex data and indices of a primitive whose vertices change.
use super::GltfDocument;
use super::accessor::Accessor;
use super::body::{Body, Target};
use super::bounds;
use super::component::Component;
use super::json::{as_unsigned, invalid, item, remove, required, unsigned};
use super::mode::{Mode, mode};
use super::primitives;
use crate::document::{DocumentError, PrimitiveNote};
use serde_json::{Value, json};
use std::collections::HashMap;

/// Replaces every attribute and morph target by new accessors with the vertices `gather`.
pub(super) fn gather_vertices(
    document: &GltfDocument,
    body: &mut Body,
    primitive: &mut Value,
    gather: &[u32],
) -> Result<(), DocumentError> {
    let mut done: HashMap<usize, usize> = HashMap::new();
    let mut sets = vec![primitive["attributes"].take()];
    if let Some(Value::Array(targets)) = primitive.get_mut("targets") {
        sets.append(targets);
    }
    let members = sets.iter_mut().filter_map(Value::as_object_mut);
    for index in members.flat_map(|set| set.values_mut()) {
        let old =
            as_unsigned(index).ok_or_else(|| invalid("an attribute is not an accessor index"))?;
        let new = match done.get(&old) {
            Some(new) => *new,
            None => gathered(&document.body, body, old, gather)?,
        };
        done.insert(old, new);
        *index = json!(new);
    }
    let mut sets = sets.into_iter();
    primitive["attributes"] = sets.next().unwrap_or_default();
    if let Some(Value::Array(targets)) = primitive.get_mut("targets") {
        targets.extend(sets);
    }
    Ok(())
}

/// Creates an accessor with the elements `gather` of accessor `index`, byte for byte. If these include all elements,
/// `min` and `max` stay valid; else they are computed. An accessor without data stays so.
fn gathered(
    source: &Body,
    body: &mut Body,
    index: usize,
    gather: &[u32],
) -> Result<usize, DocumentError> {
    let accessor = Accessor::open(source, index)?;
    let mut object = item(&source.json, "accessors", index)?.clone();
    object["count"] = json!(gather.len());
    if !accessor.has_data() {
        return body.push_accessor(object);
    }
    let size = accessor.element_size;
    let all = accessor.packed()?;
    let mut packed = Vec::with_capacity(gather.len() * size);
    for &vertex in gather {
        let start = vertex as usize * size;
        let element = all.get(start..start + size);
        packed.extend_from_slice(element.ok_or_else(|| invalid("a vertex has no element"))?);
    }
    for member in ["byteOffset", "sparse"] {
        remove(&mut object, member);
    }
    if object.get("min").is_some() && !covers(gather, accessor.count) {
        bounds::set(&mut object, &packed, accessor.component, accessor.width);
    }
    object["bufferView"] = json!(body.push_vertices(&packed, size)?);
    body.push_accessor(object)
}

/// Returns whether every vertex is among `gather`.
fn covers(gather: &[u32], n_vertices: usize) -> bool {
    let mut seen = vec![false; n_vertices];
    for &vertex in gather {
        seen[vertex as usize] = true;
    }
    seen.into_iter().all(|seen| seen)
}

/// New indices of a primitive.
pub(super) struct NewIndices<'a> {
    /// `true` if faces got vertices of their own, so that strips and fans must become lists.
    pub is_split: bool,
    pub triangles: &'a [[u32; 3]],
    /// Elements of the accessors that were the primitive's vertices, if it uses only some of them.
    pub used: Option<&'a [u32]>,
    /// New numbers of the primitive's vertices, if some were joined.
    pub joined: Option<&'a [u32]>,
}

/// Writes new indices, as wide as the vertices need and at least as wide as the old ones.
pub(super) fn write_indices(
    document: &GltfDocument,
    body: &mut Body,
    primitive: &mut Value,
    new: &NewIndices,
    note: &mut PrimitiveNote,
) -> Result<(), DocumentError> {
    let mut indices = old_indices(document, primitive, new)?;
    if new.is_split {
        let is_list = mode(primitive)? == Some(Mode::Triangles);
        // Lists keep the indices behind their last whole face.
        let rest = if is_list { indices.len() % 3 } else { 0 };
        indices.drain(..indices.len() - rest);
        indices.splice(..0, new.triangles.iter().flatten().copied());
        if !is_list {
            primitive["mode"] = json!(4);
            note.converted_to_triangles = true;
        }
    }
    // Choose the type, and keep the other properties of an old accessor.
    let needed = Component::for_indices(note.vertices_after);
    let (mut object, component) = match unsigned(primitive, "indices")? {
        Some(old) => {
            let object = item(&document.body.json, "accessors", old)?.clone();
            let stated = Component::from_code(required(&object, "componentType")?);
            let component = stated.filter(|stated| stated.size() >= needed.size());
            note.indices_widened = component.is_none();
            (object, component.unwrap_or(needed))
        }
        None => (json!({}), needed),
    };
    // Write the indices to a new view and accessor.
    let mut packed = Vec::with_capacity(indices.len() * component.size());
    for index in &indices {
        component.push(f64::from(*index), &mut packed);
    }
    for member in ["byteOffset", "sparse", "min", "max"] {
        remove(&mut object, member);
    }
    object["bufferView"] = json!(body.push_view(&packed, None, Target::Indices)?);
    object["componentType"] = json!(component.code());
    object["count"] = json!(indices.len());
    object["type"] = json!("SCALAR");
    primitive["indices"] = json!(body.push_accessor(object)?);
    Ok(())
}

/// Returns the old indices in terms of the primitive's own vertices.
fn old_indices(
    document: &GltfDocument,
    primitive: &Value,
    new: &NewIndices,
) -> Result<Vec<u32>, DocumentError> {
    let position = required(&primitive["attributes"], "POSITION")?;
    let n_vertices = Accessor::open(&document.body, position)?.count;
    let mut indices = primitives::indices(&document.body, primitive, n_vertices)?;
    if let Some(used) = new.used {
        for index in &mut indices {
            *index = used.partition_point(|vertex| vertex < index) as u32;
        }
    }
    if let Some(numbers) = new.joined {
        for index in &mut indices {
            *index = numbers[*index as usize];
        }
    }
    Ok(indices)
}

/// Creates an accessor of f32 vectors.
pub(super) fn push_floats(
    body: &mut Body,
    values: impl Iterator<Item = f32>,
    count: usize,
    kind: &str,
) -> Result<usize, DocumentError> {
    let packed: Vec<u8> = values.flat_map(f32::to_le_bytes).collect();
    let view = body.push_view(&packed, None, Target::Vertices)?;
    body.push_accessor(json!({
        "bufferView": view,
        "componentType": Component::F32.code(),
        "count": count,
        "type": kind,
    }))
}

//! One primitive with its new UV set.
use super::GltfDocument;
use super::accessor::Accessor;
use super::body::{Body, Target};
use super::component::Component;
use super::json::{
    as_unsigned, invalid, item, object_mut, primitive_mut, remove, required, unsigned,
};
use super::primitives::{self, Mode};
use super::split::{Split, split};
use super::tangents::{CornerTangents, corner_tangents};
use super::texcoord_set::Choice;
use crate::document::{DocumentError, Primitive, PrimitiveNote, TangentsNote};
use serde_json::{Value, json};
use std::collections::HashMap;

/// What must agree for corners to share a vertex: grid coordinates, and the bits of the tangent where it is new.
type Key = ([i32; 2], [u32; 4]);

/// The UVs of one primitive.
#[derive(Clone, Copy)]
pub(super) struct PrimitiveUvs<'a> {
    pub grid_bits: u32,
    pub corners: &'a [[[i32; 2]; 3]],
}

impl PrimitiveUvs<'_> {
    /// i / 2ᵏ, exact in f32.
    fn stored(&self, coordinate: i32) -> f32 {
        coordinate as f32 / (1u32 << self.grid_bits) as f32
    }

    /// u and v as glTF stores them: v points down.
    fn texcoord(&self, [u, v]: [i32; 2]) -> [f32; 2] {
        [self.stored(u), self.stored((1 << self.grid_bits) - v)]
    }
}

/// Writes the UVs of `primitive` into `body`, a copy of the document's.
pub(super) fn rewrite(
    document: &GltfDocument,
    body: &mut Body,
    primitive: &Primitive,
    uvs: PrimitiveUvs,
    choice: &Choice,
) -> Result<PrimitiveNote, DocumentError> {
    let object = document.object(primitive)?;
    let (tangents, tangents_note) = new_tangents(document, primitive, uvs, choice)?;
    let split = split(
        primitive.positions.len(),
        &primitive.triangles,
        &keys(uvs.corners, tangents.as_deref()),
    );
    let mut changed = object.clone();
    drop_stale(&mut changed, choice, tangents_note)?;
    let mut note = PrimitiveNote {
        mesh: primitive.mesh,
        primitive: primitive.primitive,
        texcoord: choice.set,
        replaced: choice.had_set,
        vertices_before: primitive.positions.len(),
        vertices_after: split.keys.len(),
        indices_widened: false,
        converted_to_triangles: false,
        tangents: tangents_note,
    };
    if !split.copies.is_empty() {
        copy_vertices(document, body, &mut changed, &split.copies)?;
        write_indices(document, body, &mut changed, &split, &mut note)?;
    }
    let texcoords = split.keys.iter().flat_map(|key| match key {
        Some((uv, _)) => uvs.texcoord(*uv),
        None => [0.0; 2],
    });
    let n_vertices = split.keys.len();
    let accessor = push_floats(body, texcoords, n_vertices, "VEC2")?;
    let attributes = object_mut(&mut changed["attributes"])?;
    for set in choice.missing.iter().chain([&choice.set]) {
        attributes.insert(format!("TEXCOORD_{set}"), json!(accessor));
    }
    if tangents.is_some() {
        let tangents = split.keys.iter().flat_map(|key| match key {
            Some((_, bits)) => bits.map(f32::from_bits),
            None => [1.0, 0.0, 0.0, 1.0],
        });
        let accessor = push_floats(body, tangents, n_vertices, "VEC4")?;
        object_mut(&mut changed["attributes"])?.insert("TANGENT".to_owned(), json!(accessor));
    }
    *primitive_mut(&mut body.json, primitive.mesh, primitive.primitive)? = changed;
    Ok(note)
}

/// Tangents where the old ones belonged to a set that is replaced.
fn new_tangents(
    document: &GltfDocument,
    primitive: &Primitive,
    uvs: PrimitiveUvs,
    choice: &Choice,
) -> Result<(Option<Vec<CornerTangents>>, TangentsNote), DocumentError> {
    let object = document.object(primitive)?;
    let has_tangents = object["attributes"].get("TANGENT").is_some();
    if !has_tangents || !choice.replaced.iter().any(|texture| texture.is_normal_map) {
        return Ok((None, TangentsNote::Untouched));
    }
    let upward: Vec<[[f32; 2]; 3]> = uvs
        .corners
        .iter()
        .map(|corners| corners.map(|uv| uv.map(|coordinate| uvs.stored(coordinate))))
        .collect();
    let tangents = corner_tangents(&document.body, primitive, object, &upward)?;
    let note = match tangents {
        Some(_) => TangentsNote::Recomputed,
        None => TangentsNote::Dropped,
    };
    Ok((tangents, note))
}

fn keys(corners: &[[[i32; 2]; 3]], tangents: Option<&[CornerTangents]>) -> Vec<[Key; 3]> {
    let key = |face: usize, corner: usize| {
        let tangent = tangents.map_or([0; 4], |tangents| tangents[face][corner].map(f32::to_bits));
        (corners[face][corner], tangent)
    };
    (0..corners.len())
        .map(|face| std::array::from_fn(|corner| key(face, corner)))
        .collect()
}

/// Removes what belonged to the replaced set: the attribute, tangents, and their deltas in morph targets.
fn drop_stale(
    primitive: &mut Value,
    choice: &Choice,
    tangents: TangentsNote,
) -> Result<(), DocumentError> {
    let mut stale = vec![format!("TEXCOORD_{}", choice.set)];
    if tangents != TangentsNote::Untouched {
        stale.push("TANGENT".to_owned());
    }
    for name in stale {
        remove(&mut primitive["attributes"], &name);
        let Some(Value::Array(targets)) = primitive.get_mut("targets") else {
            continue;
        };
        for target in targets {
            let target = object_mut(target)?;
            // A target without any attribute would be invalid.
            if target.len() > 1 {
                target.shift_remove(&name);
            }
        }
    }
    Ok(())
}

/// Appends copies of split vertices to every attribute and morph target, in new accessors.
fn copy_vertices(
    document: &GltfDocument,
    body: &mut Body,
    primitive: &mut Value,
    copies: &[u32],
) -> Result<(), DocumentError> {
    let mut done: HashMap<usize, usize> = HashMap::new();
    let mut sets = vec![primitive["attributes"].take()];
    if let Some(Value::Array(targets)) = primitive.get_mut("targets") {
        sets.append(targets);
    }
    for index in sets
        .iter_mut()
        .filter_map(Value::as_object_mut)
        .flat_map(|set| set.values_mut())
    {
        let old = as_unsigned(index).ok_or_else(|| invalid("an attribute is no index"))?;
        let new = match done.get(&old) {
            Some(new) => *new,
            None => extend(&document.body, body, old, copies)?,
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

/// A new accessor with the elements of accessor `index` and those of `copies`, byte for byte. `min` and `max` stay true.
fn extend(
    source: &Body,
    body: &mut Body,
    index: usize,
    copies: &[u32],
) -> Result<usize, DocumentError> {
    let accessor = Accessor::open(source, index)?;
    let size = accessor.element_size;
    let mut packed = accessor.packed()?;
    for &vertex in copies {
        let start = vertex as usize * size;
        packed.extend_from_within(start..start + size);
    }
    let mut object = item(&source.json, "accessors", index)?.clone();
    for member in ["byteOffset", "sparse"] {
        remove(&mut object, member);
    }
    object["bufferView"] = json!(body.push_vertices(&packed, size)?);
    object["count"] = json!(accessor.count + copies.len());
    body.push_accessor(object)
}

/// Replaces the indices of a primitive by those of the split faces, as a triangle list.
fn write_indices(
    document: &GltfDocument,
    body: &mut Body,
    primitive: &mut Value,
    split: &Split<Key>,
    note: &mut PrimitiveNote,
) -> Result<(), DocumentError> {
    let n_vertices = split.keys.len();
    let needed = Component::for_indices(n_vertices);
    let old = unsigned(primitive, "indices")?;
    let (mut object, component) = match old {
        Some(old) => {
            let object = item(&document.body.json, "accessors", old)?.clone();
            let stated = Component::from_code(required(&object, "componentType")?);
            let component = stated.filter(|stated| stated.size() >= needed.size());
            note.indices_widened = component.is_none();
            (object, component.unwrap_or(needed))
        }
        None => (json!({}), needed),
    };
    let mut indices: Vec<u32> = split.triangles.iter().flatten().copied().collect();
    if primitives::mode(primitive)? == Some(Mode::Triangles) {
        // Indices beyond the last whole face.
        let all = primitives::indices(&document.body, primitive, note.vertices_before)?;
        indices.extend(all.get(indices.len()..).unwrap_or_default());
    } else {
        primitive["mode"] = json!(4);
        note.converted_to_triangles = true;
    }
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

/// A new accessor of f32 vectors.
fn push_floats(
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

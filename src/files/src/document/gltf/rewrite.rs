//! One primitive with its new UV set.

use super::accessor::{self, Accessor, Component};
use super::body::{GltfBody, Target};
use super::document::GltfDocument;
use super::json::{
    as_unsigned, invalid, item, items, object_mut, primitive_mut, remove, required, unsigned,
};
use super::primitives::{self, PrimitiveMode, mode};
use super::tangents::corner_tangents;
use super::texcoord_set::Choice;
use crate::document::{
    BakedTextures, CornerTangents, Corners, DocumentError, Primitive, PrimitiveNote, TangentsNote,
};
use serde_json::{Value, json};
use std::borrow::Cow;
use std::collections::HashMap;
use std::hash::Hash;

/// Attributes in which corners must agree to share a vertex: the bits of the UV, and of the tangent if it is new.
type VertexKey = ([u32; 2], [u32; 4]);

/// Writes the UVs of primitive `index`, v down, into `body`, a copy of the document's.
pub(super) fn rewrite(
    document: &GltfDocument,
    body: &mut GltfBody,
    index: usize,
    uvs: &[Corners],
    choice: &Choice,
    baked: Option<&BakedTextures>,
) -> Result<PrimitiveNote, DocumentError> {
    let primitive = &document.primitives[index];
    // Remove what belonged to the replaced set, and join vertices that it had split.
    let (tangents, tangents_note) = match baked {
        Some(baked) if baked.plan.is_normal_mapped(index) => baked_tangents(baked, index),
        _ => new_tangents(document, index, uvs, choice)?,
    };
    let mut changed = document.object(primitive)?.clone();
    drop_stale(&mut changed, choice, tangents_note)?;
    let joined = if choice.is_marked {
        rejoined(document, index, &changed)?
    } else {
        None
    };
    // Split vertices at the seams of the new set.
    let vertices = PrimitiveVertices::new(primitive, joined.as_ref());
    let split = split(
        vertices.kept.len(),
        &vertices.triangles,
        &keys(uvs, tangents.as_deref()),
    );
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
        sources: None,
    };
    // Write indices and attributes if vertices have changed.
    let used = document.used[index].as_deref();
    let is_split = !split.copies.is_empty() || joined.is_some();
    if is_split || used.is_some() {
        let indices = NewIndices {
            is_split,
            triangles: &split.triangles,
            used,
            joined: joined.as_ref().map(|joined| joined.numbers.as_slice()),
        };
        write_indices(document, body, &mut changed, &indices, &mut note)?;
        let copies = split.copies.iter();
        let own = copies.map(|&vertex| vertices.kept[vertex as usize]);
        let gather: Vec<u32> = (vertices.kept.iter().copied())
            .chain(own)
            .map(|vertex| used.map_or(vertex, |used| used[vertex as usize]))
            .collect();
        gather_vertices(document, body, &mut changed, &gather)?;
        note.sources = Some(gather);
    }
    // Write the new UVs, and the tangents if they are new.
    let texcoords = split.keys.iter().flat_map(|key| match key {
        Some((bits, _)) => bits.map(f32::from_bits),
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

/// Vertices of a primitive before they are split.
struct PrimitiveVertices<'a> {
    /// Vertices of the file that remain.
    kept: Vec<u32>,
    /// Faces in terms of these.
    triangles: Cow<'a, [[u32; 3]]>,
}

impl<'a> PrimitiveVertices<'a> {
    fn new(primitive: &'a Primitive, joined: Option<&Rejoined>) -> Self {
        match joined {
            None => Self {
                kept: (0..primitive.positions.len() as u32).collect(),
                triangles: Cow::Borrowed(&primitive.triangles),
            },
            Some(joined) => Self {
                kept: joined.kept.clone(),
                triangles: (primitive.triangles.iter())
                    .map(|face| face.map(|vertex| joined.numbers[vertex as usize]))
                    .collect(),
            },
        }
    }
}

/// Returns the tangents for which a normal map was made.
fn baked_tangents(
    baked: &BakedTextures,
    index: usize,
) -> (Option<Vec<CornerTangents>>, TangentsNote) {
    match &baked.tangents[index] {
        Some(tangents) => (Some(tangents.clone()), TangentsNote::Recomputed),
        None => (None, TangentsNote::Dropped),
    }
}

/// Computes new tangents if the old ones belonged to a replaced set.
fn new_tangents(
    document: &GltfDocument,
    index: usize,
    uvs: &[Corners],
    choice: &Choice,
) -> Result<(Option<Vec<CornerTangents>>, TangentsNote), DocumentError> {
    let object = document.object(&document.primitives[index])?;
    let has_tangents = object["attributes"].get("TANGENT").is_some();
    if !has_tangents || !choice.had_normal_map {
        return Ok((None, TangentsNote::Untouched));
    }
    let upward: Vec<Corners> = (uvs.iter())
        .map(|face| face.map(|[u, v]| [u, 1.0 - v]))
        .collect();
    let tangents = corner_tangents(document, index, &upward)?;
    let note = match tangents {
        Some(_) => TangentsNote::Recomputed,
        None => TangentsNote::Dropped,
    };
    Ok((tangents, note))
}

fn keys(corners: &[Corners], tangents: Option<&[CornerTangents]>) -> Vec<[VertexKey; 3]> {
    let key = |face: usize, corner: usize| {
        let tangent = tangents.map_or([0; 4], |tangents| tangents[face][corner].map(f32::to_bits));
        (corners[face][corner].map(f32::to_bits), tangent)
    };
    (0..corners.len())
        .map(|face| std::array::from_fn(|corner| key(face, corner)))
        .collect()
}

/// Removes the parts that belonged to the replaced set: the attribute, tangents, and their deltas in morph targets.
fn drop_stale(
    primitive: &mut Value,
    choice: &Choice,
    tangents: TangentsNote,
) -> Result<(), DocumentError> {
    let sets = choice.missing.iter().chain([&choice.set]);
    let mut stale: Vec<String> = sets.map(|set| format!("TEXCOORD_{set}")).collect();
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

// Joins vertices that were split at the seams of a replaced UV set.

/// Vertices after joining.
struct Rejoined {
    /// Old vertices that stay, in increasing order.
    pub kept: Vec<u32>,
    /// New number of each old vertex.
    pub numbers: Vec<u32>,
}

/// Joins the vertices of primitive `index` that differ only in the attributes missing from `changed`, its new JSON.
/// Vertices that were duplicates before the split stay so: among those that agree in everything except the old UVs, the
/// first of each UV are joined, then the second, and so on. Returns `None` if there is nothing to join.
fn rejoined(
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
    // Divide the vertices by everything that stays.
    let rest = accessors(changed)?;
    for &accessor in &rest {
        let (packed, size) = packed(document, accessor)?;
        classes = refined(&classes, |v| &packed[element(v) * size..][..size]);
    }
    // Divide them by what was removed.
    let mut of_set = vec![0; n];
    for accessor in accessors(old)?.into_iter().filter(|a| !rest.contains(a)) {
        let (packed, size) = packed(document, accessor)?;
        of_set = refined(&of_set, |v| &packed[element(v) * size..][..size]);
    }
    // Rank the vertices that agree in both, and join those of equal rank that agree in what stays.
    let mut twins: HashMap<(u32, u32), u32> = HashMap::new();
    let ranks: Vec<u32> = (0..n)
        .map(|v| {
            let rank = twins.entry((classes[v], of_set[v])).or_default();
            *rank += 1;
            *rank
        })
        .collect();
    let numbers = refined(&classes, |v| ranks[v]);
    // Keep the first vertex of each number.
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
    classes
        .iter()
        .enumerate()
        .map(|(v, class): (usize, &u32)| {
            let next = numbers.len() as u32;
            *numbers.entry((*class, key(v))).or_insert(next)
        })
        .collect()
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

// Splitting of vertices whose corners differ.

/// Vertices after a split: the old ones keep their places, the copies follow.
struct Split<K> {
    /// Old vertex of each copy.
    pub copies: Vec<u32>,
    /// Faces with the new vertices.
    pub triangles: Vec<[u32; 3]>,
    /// Common key of the corners of each vertex; `None` for vertices without a face.
    pub keys: Vec<Option<K>>,
}

/// Splits `n_vertices` vertices so that all corners of a vertex have the same key. The first key found stays with the
/// vertex.
fn split<K: Copy + Eq + Hash>(
    n_vertices: usize,
    triangles: &[[u32; 3]],
    keys_of_corners: &[[K; 3]],
) -> Split<K> {
    let mut keys: Vec<Option<K>> = vec![None; n_vertices];
    let mut copies = Vec::new();
    let mut copy_of: HashMap<(u32, K), u32> = HashMap::new();
    let mut new_triangles = Vec::with_capacity(triangles.len());
    for (face, corners) in triangles.iter().zip(keys_of_corners) {
        new_triangles.push(std::array::from_fn(|corner| {
            let (vertex, key) = (face[corner], corners[corner]);
            match keys[vertex as usize] {
                Some(first) if first == key => vertex,
                None => {
                    keys[vertex as usize] = Some(key);
                    vertex
                }
                Some(_) => *copy_of.entry((vertex, key)).or_insert_with(|| {
                    copies.push(vertex);
                    keys.push(Some(key));
                    keys.len() as u32 - 1
                }),
            }
        }));
    }
    Split {
        copies,
        triangles: new_triangles,
        keys,
    }
}

// Vertex data and indices of a primitive whose vertices change.

/// Replaces every attribute and morph target by new accessors with the vertices `gather`.
fn gather_vertices(
    document: &GltfDocument,
    body: &mut GltfBody,
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
    source: &GltfBody,
    body: &mut GltfBody,
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
        accessor::set(&mut object, &packed, accessor.component, accessor.width);
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
struct NewIndices<'a> {
    /// `true` if faces got vertices of their own, so that strips and fans must become lists.
    pub is_split: bool,
    pub triangles: &'a [[u32; 3]],
    /// Elements of the accessors that were the primitive's vertices, if it uses only some of them.
    pub used: Option<&'a [u32]>,
    /// New numbers of the primitive's vertices, if some were joined.
    pub joined: Option<&'a [u32]>,
}

/// Writes new indices, as wide as the vertices need and at least as wide as the old ones.
fn write_indices(
    document: &GltfDocument,
    body: &mut GltfBody,
    primitive: &mut Value,
    new: &NewIndices,
    note: &mut PrimitiveNote,
) -> Result<(), DocumentError> {
    let mut indices = old_indices(document, primitive, new)?;
    if new.is_split {
        let is_list = mode(primitive)? == Some(PrimitiveMode::Triangles);
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
fn push_floats(
    body: &mut GltfBody,
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

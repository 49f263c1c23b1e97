//! One primitive with its new UV set.

use super::GltfDocument;
use super::accessor::Accessor;
use super::body::Body;
use super::json::{as_unsigned, invalid, items, object_mut, primitive_mut, remove};
use super::tangents::corner_tangents;
use super::texcoord_set::Choice;
use super::vertices::{NewIndices, gather_vertices, push_floats, write_indices};
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
    body: &mut Body,
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

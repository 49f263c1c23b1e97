//! One primitive with its new UV set.
use super::GltfDocument;
use super::body::Body;
use super::json::{object_mut, primitive_mut, remove};
use super::rejoin::{Rejoined, rejoined};
use super::split::split;
use super::tangents::corner_tangents;
use super::texcoord_set::Choice;
use super::vertices::{NewIndices, gather_vertices, push_floats, write_indices};
use crate::document::{
    BakedTextures, CornerTangents, Corners, DocumentError, Primitive, PrimitiveNote, TangentsNote,
};
use serde_json::{Value, json};
use std::borrow::Cow;

/// Attributes in which corners must agree to share a vertex: the bits of the UV, and of the tangent if it is new.
type Key = ([u32; 2], [u32; 4]);

/// Writes the UVs of primitive `index`, v down, into `body`, a copy of the document's.
pub(super) fn rewrite(
    document: &GltfDocument,
    body: &mut Body,
    index: usize,
    uvs: &[Corners],
    (choice, baked): (&Choice, Option<&BakedTextures>),
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
    let vertices = Vertices::new(primitive, joined.as_ref());
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
struct Vertices<'a> {
    /// Vertices of the file that remain.
    kept: Vec<u32>,
    /// Faces in terms of these.
    triangles: Cow<'a, [[u32; 3]]>,
}

impl<'a> Vertices<'a> {
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

fn keys(corners: &[Corners], tangents: Option<&[CornerTangents]>) -> Vec<[Key; 3]> {
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

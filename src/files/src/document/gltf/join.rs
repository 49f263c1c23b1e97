//! Joining of primitives that got one material.
//!
//! Primitives of a mesh with one material, the same attributes and the same morph targets are one draw call: their
//! vertices and indices follow one another in new accessors. The others stay as they are. Blended primitives are never
//! joined, since renderers sort them by their distances.

use super::accessor::{self, Accessor, Component};
use super::body::{GltfBody, Target};
use super::document::GltfDocument;
use super::json::{as_unsigned, invalid, item, item_mut, items, required, unsigned};
use super::primitives::{self, PrimitiveMode, mode};
use crate::document::bake::MergedPlanes;
use crate::document::{DocumentError, JoinedPart, JoinedPrimitive};
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, HashMap};

/// Joins the primitives of merged materials. Returns the triangle primitives of the body; `None` if none were joined.
pub(super) fn join(
    document: &GltfDocument,
    body: &mut GltfBody,
    merged: &[MergedPlanes],
) -> Result<Option<Vec<JoinedPrimitive>>, DocumentError> {
    // Collect the primitives of each mesh that may be joined.
    let mut of_mesh: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let joinable = merged
        .iter()
        .filter(|planes| planes.material["alphaMode"] != "BLEND");
    for &index in joinable.flat_map(|planes| &planes.primitives) {
        let primitive = &document.primitives[index];
        of_mesh
            .entry(primitive.mesh)
            .or_default()
            .push(primitive.primitive);
    }
    // Join those that agree; the first of them stands for all.
    let mut parts: HashMap<[usize; 2], Vec<usize>> = HashMap::new();
    for (&mesh, candidates) in &mut of_mesh {
        candidates.sort_unstable();
        for alike in alike(body, mesh, candidates)? {
            let all = items(item(&body.json, "meshes", mesh)?, "primitives")?;
            let all: Vec<Value> = alike
                .iter()
                .map(|&primitive| all[primitive].clone())
                .collect();
            let one = joined(body, &all)?;
            let primitives = &mut item_mut(&mut body.json, "meshes", mesh)?["primitives"];
            primitives[alike[0]] = one;
            for &gone in &alike[1..] {
                primitives[gone] = Value::Null;
            }
            parts.insert([mesh, alike[0]], alike);
        }
    }
    if parts.is_empty() {
        return Ok(None);
    }
    renumbered(document, body, &parts).map(Some)
}

/// Removes the primitives that became parts of others, and returns the triangle primitives that remain.
fn renumbered(
    document: &GltfDocument,
    body: &mut GltfBody,
    parts: &HashMap<[usize; 2], Vec<usize>>,
) -> Result<Vec<JoinedPrimitive>, DocumentError> {
    let indices: HashMap<[usize; 2], usize> = (document.primitives.iter().enumerate())
        .map(|(index, primitive)| ([primitive.mesh, primitive.primitive], index))
        .collect();
    let mut remaining = Vec::new();
    for mesh in 0..items(&body.json, "meshes")?.len() {
        let mesh_object = item_mut(&mut body.json, "meshes", mesh)?;
        let primitives = mesh_object.get_mut("primitives");
        let Some(primitives) = primitives.and_then(Value::as_array_mut) else {
            continue;
        };
        let old = std::mem::take(primitives);
        for (number, primitive) in old.into_iter().enumerate() {
            if primitive.is_null() {
                continue;
            }
            let alone = [number];
            let all = parts.get(&[mesh, number]).map_or(&alone[..], Vec::as_slice);
            let part = |&part: &usize| {
                let primitive = *indices.get(&[mesh, part])?;
                let n_faces = document.primitives[primitive].triangles.len();
                Some(JoinedPart { primitive, n_faces })
            };
            let all: Option<Vec<JoinedPart>> = all.iter().map(part).collect();
            // Points and lines are not among the document's primitives.
            if let Some(parts) = all {
                remaining.push(JoinedPrimitive {
                    mesh,
                    primitive: primitives.len(),
                    parts,
                });
            }
            primitives.push(primitive);
        }
    }
    Ok(remaining)
}

/// Groups primitives of a mesh that can be joined; leaves out those that cannot be joined with any.
fn alike(
    body: &GltfBody,
    mesh: usize,
    candidates: &[usize],
) -> Result<Vec<Vec<usize>>, DocumentError> {
    let mesh = item(&body.json, "meshes", mesh)?;
    // Extensions of meshes and primitives may number vertices.
    if mesh.get("extensions").is_some() {
        return Ok(Vec::new());
    }
    let all = items(mesh, "primitives")?;
    let mut groups: Vec<(Value, Vec<usize>)> = Vec::new();
    for &candidate in candidates {
        let primitive = &all[candidate];
        let is_list = mode(primitive)? == Some(PrimitiveMode::Triangles);
        if !is_list || primitive.get("extensions").is_some() {
            continue;
        }
        let signature = signature(body, primitive)?;
        match groups.iter_mut().find(|(known, _)| *known == signature) {
            Some((_, members)) => members.push(candidate),
            None => groups.push((signature, vec![candidate])),
        }
    }
    let several = groups.into_iter().map(|(_, members)| members);
    Ok(several.filter(|members| members.len() > 1).collect())
}

/// Returns everything in which joined primitives must agree: all but vertices and indices.
fn signature(body: &GltfBody, primitive: &Value) -> Result<Value, DocumentError> {
    let kinds = |set: &Value| -> Result<BTreeMap<String, Value>, DocumentError> {
        let set = set
            .as_object()
            .ok_or_else(|| invalid("a set of attributes is not an object"))?;
        let kind = |(name, index): (&String, &Value)| {
            let accessor = Accessor::open(body, accessor_index(index)?)?;
            let (component, width) = (accessor.component.code(), accessor.kind());
            let kind = json!([component, width, accessor.is_normalized()]);
            Ok((name.clone(), kind))
        };
        set.iter().map(kind).collect()
    };
    let targets: Vec<_> = (items(primitive, "targets")?.iter())
        .map(kinds)
        .collect::<Result<_, _>>()?;
    Ok(json!({
        "material": primitive.get("material"),
        "extras": primitive.get("extras"),
        "attributes": kinds(&primitive["attributes"])?,
        "targets": targets,
    }))
}

fn accessor_index(value: &Value) -> Result<usize, DocumentError> {
    as_unsigned(value).ok_or_else(|| invalid("an attribute is not an accessor index"))
}

/// Returns one primitive with the vertices and faces of all.
fn joined(body: &mut GltfBody, all: &[Value]) -> Result<Value, DocumentError> {
    let mut one = all[0].clone();
    // Attributes, those of morph targets too. Attributes that share accessors still do.
    let mut done = HashMap::new();
    one["attributes"] = joined_set(body, all, &["attributes"], &mut done)?;
    for target in 0..items(&one, "targets")?.len() {
        let place = ["targets", &target.to_string()];
        one["targets"][target] = joined_set(body, all, &place, &mut done)?;
    }
    // Indices, which count the vertices of all.
    let mut indices: Vec<u32> = Vec::new();
    let mut first = 0;
    for primitive in all {
        let position = required(&primitive["attributes"], "POSITION")?;
        let n_vertices = Accessor::open(body, position)?.count;
        let own = primitives::indices(body, primitive, n_vertices)?;
        let whole = own.len() - own.len() % 3;
        indices.extend(own[..whole].iter().map(|index| first + index));
        first += n_vertices as u32;
    }
    let component = Component::for_indices(first as usize);
    let mut packed = Vec::with_capacity(indices.len() * component.size());
    for &index in &indices {
        component.push(f64::from(index), &mut packed);
    }
    let view = body.push_view(&packed, None, Target::Indices)?;
    one["indices"] = json!(body.push_accessor(json!({
        "bufferView": view,
        "componentType": component.code(),
        "count": indices.len(),
        "type": "SCALAR",
    }))?);
    Ok(one)
}

/// Joins a set of attributes at the same place of all primitives; `done` has the accessors that were joined already.
fn joined_set(
    body: &mut GltfBody,
    all: &[Value],
    place: &[&str],
    done: &mut HashMap<Vec<usize>, usize>,
) -> Result<Value, DocumentError> {
    let pointer = format!("/{}", place.join("/"));
    let set = |primitive: &Value| primitive.pointer(&pointer).cloned().unwrap_or_default();
    let sets: Vec<Value> = all.iter().map(set).collect();
    let names = sets[0].as_object().into_iter().flat_map(Map::keys);
    let mut one = Map::new();
    for name in names {
        let accessors: Vec<usize> = (sets.iter())
            .map(|set| unsigned(set, name)?.ok_or_else(|| invalid("an attribute is gone")))
            .collect::<Result<_, _>>()?;
        let accessor = match done.get(&accessors) {
            Some(accessor) => *accessor,
            None => joined_accessor(body, &accessors, name == "POSITION")?,
        };
        done.insert(accessors, accessor);
        one.insert(name.clone(), json!(accessor));
    }
    Ok(Value::Object(one))
}

/// Creates an accessor with the elements of all, byte for byte.
fn joined_accessor(
    body: &mut GltfBody,
    all: &[usize],
    has_bounds: bool,
) -> Result<usize, DocumentError> {
    let mut packed = Vec::new();
    let mut count = 0;
    for &index in all {
        let accessor = Accessor::open(body, index)?;
        packed.extend(accessor.packed()?);
        count += accessor.count;
    }
    let first = Accessor::open(body, all[0])?;
    let (component, width, size) = (first.component, first.width, first.element_size);
    let mut object = json!({
        "componentType": component.code(),
        "count": count,
        "type": first.kind(),
    });
    if first.is_normalized() {
        object["normalized"] = json!(true);
    }
    if has_bounds {
        accessor::set(&mut object, &packed, component, width);
    }
    object["bufferView"] = json!(body.push_vertices(&packed, size)?);
    body.push_accessor(object)
}

//! A primitive whose triangles are cut into pieces.
use super::GltfDocument;
use super::accessor::Accessor;
use super::body::{Body, Target};
use super::bounds;
use super::component::Component;
use super::json::{as_unsigned, invalid, object_mut, primitive_mut};
use crate::document::subdivision::{AddedVertex, Subdivision};
use crate::document::{DocumentError, Primitive};
use serde_json::{Value, json};

/// Writes the pieces of primitive `index` into `body`, a copy of the document's, as a list of triangles over new
/// accessors of f32. Attributes are kept, and interpolated at added vertices. Morph targets, skins and whole numbers of
/// unknown meaning are refused, as they cannot be interpolated.
pub(super) fn subdivide(
    document: &GltfDocument,
    body: &mut Body,
    index: usize,
    cut: &Subdivision,
) -> Result<(), DocumentError> {
    if cut.added.is_empty() {
        return Ok(());
    }
    let primitive = &document.primitives[index];
    let mut changed = document.object(primitive)?.clone();
    if changed.get("targets").is_some() {
        return Err(DocumentError::Indivisible("morph targets".to_owned()));
    }
    // Attributes of own and added vertices.
    for (name, index_of) in object_mut(&mut changed["attributes"])? {
        let old = as_unsigned(index_of)
            .ok_or_else(|| invalid("an attribute is not an accessor index"))?;
        let accessor = Accessor::open(&document.body, old)?;
        let values = if name == "POSITION" {
            let added = cut.added.iter().map(|vertex| &vertex.position);
            let positions = primitive.positions.iter().chain(added);
            positions.flatten().copied().collect()
        } else {
            let own = own_values(primitive, document.used[index].as_deref(), &accessor)?;
            interpolated(name, &accessor, own, &cut.added)?
        };
        *index_of = json!(push(body, &accessor, name == "POSITION", &values)?);
    }
    // Triangles as a list.
    let indices: Vec<u8> = (cut.triangles.iter().flatten())
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let view = body.push_view(&indices, None, Target::Indices)?;
    let accessor = json!({
        "bufferView": view,
        "componentType": Component::U32.code(),
        "count": 3 * cut.triangles.len(),
        "type": "SCALAR",
    });
    changed["indices"] = json!(body.push_accessor(accessor)?);
    changed["mode"] = json!(4);
    *primitive_mut(&mut body.json, primitive.mesh, primitive.primitive)? = changed;
    Ok(())
}

/// Returns the numbers of the primitive's own vertices, one after another.
fn own_values(
    primitive: &Primitive,
    used: Option<&[u32]>,
    accessor: &Accessor,
) -> Result<Vec<f64>, DocumentError> {
    let (all, width) = (accessor.values()?, accessor.width);
    let mut own = Vec::with_capacity(primitive.positions.len() * width);
    for vertex in 0..primitive.positions.len() {
        let element = used.map_or(vertex, |used| used[vertex] as usize);
        let numbers = all.get(element * width..(element + 1) * width);
        own.extend_from_slice(numbers.ok_or_else(|| invalid("a vertex has no element"))?);
    }
    Ok(own)
}

/// Returns the numbers of all vertices. Normals and tangents keep length 1; a tangent gets the handedness of its
/// nearest corner.
fn interpolated(
    name: &str,
    accessor: &Accessor,
    own: Vec<f64>,
    added: &[AddedVertex],
) -> Result<Vec<f32>, DocumentError> {
    // Refuse numbers that have no mean.
    if name.starts_with("JOINTS") || name.starts_with("WEIGHTS") {
        return Err(DocumentError::Indivisible("a skin".to_owned()));
    }
    if accessor.component != Component::F32 && !accessor.is_normalized() {
        return Err(DocumentError::Indivisible(name.to_owned()));
    }
    let width = accessor.width;
    let mut values = own;
    // Append the weighted means of the added vertices.
    for vertex in added {
        let at = |corner: usize, k: usize| values[vertex.corners[corner] as usize * width + k];
        let mean = |k| (0..3).map(|c| vertex.weights[c] * at(c, k)).sum::<f64>();
        let mut numbers: Vec<f64> = (0..width).map(mean).collect();
        // Directions keep length 1; a tangent takes its handedness from the nearest corner.
        if name == "NORMAL" || name == "TANGENT" {
            let length = numbers.iter().take(3).map(|x| x * x).sum::<f64>().sqrt();
            if length > 0.0 {
                numbers.iter_mut().take(3).for_each(|x| *x /= length);
            }
            let nearest = (0..3).max_by(|&a, &b| vertex.weights[a].total_cmp(&vertex.weights[b]));
            if let (Some(handedness), Some(nearest)) = (numbers.get_mut(3), nearest) {
                *handedness = at(nearest, 3);
            }
        }
        values.extend(numbers);
    }
    Ok(values.into_iter().map(|x| x as f32).collect())
}

fn push(
    body: &mut Body,
    like: &Accessor,
    is_position: bool,
    values: &[f32],
) -> Result<usize, DocumentError> {
    let packed: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
    let mut object: Value = json!({
        "bufferView": body.push_view(&packed, None, Target::Vertices)?,
        "componentType": Component::F32.code(),
        "count": values.len() / like.width.max(1),
        "type": like.kind(),
    });
    if is_position {
        bounds::set(&mut object, &packed, Component::F32, like.width);
    }
    body.push_accessor(object)
}

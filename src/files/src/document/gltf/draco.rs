//! `KHR_draco_mesh_compression`: primitives decoded into plain accessors.
use super::body::{Body, Target};
use super::bounds;
use super::buffers::most_decoded;
use super::component::Component;
use super::json::{
    invalid, item, item_mut, items, primitive_mut, remove, remove_extension, required, unsigned,
};
use crate::document::DocumentError;
use draco_core::{
    DataType, DecodeLimits, DecoderBuffer, ErrorKind, Mesh, MeshDecoder, PointAttribute, PointIndex,
};
use serde_json::{Value, json};

/// Name of the extension.
pub(super) const NAME: &str = "KHR_draco_mesh_compression";

/// Decodes every compressed primitive. If the file also has uncompressed data, that is used instead.
pub(super) fn decompress(body: &mut Body) -> Result<(), DocumentError> {
    let mut budget = most_decoded(body.bin.len());
    for mesh in 0..items(&body.json, "meshes")?.len() {
        for primitive in 0..items(item(&body.json, "meshes", mesh)?, "primitives")?.len() {
            let object = primitive_mut(&mut body.json, mesh, primitive)?;
            let Some(compressed) = remove_extension(object, NAME) else {
                continue;
            };
            let object = object.clone();
            if lacks_data(body, &object, &compressed)? {
                let changed = decode(body, object, &compressed, &mut budget)?;
                *primitive_mut(&mut body.json, mesh, primitive)? = changed;
            }
        }
    }
    Ok(())
}

/// Returns attribute names and Draco ids of a compressed primitive.
fn attribute_ids(compressed: &Value) -> Result<Vec<(&str, u32)>, DocumentError> {
    let Some(Value::Object(attributes)) = compressed.get("attributes") else {
        return Err(invalid(format!("{NAME} names no attributes")));
    };
    attributes
        .keys()
        .map(|name| {
            let id = required(&compressed["attributes"], name)?;
            let id = u32::try_from(id).map_err(|_| invalid("a Draco id is out of range"))?;
            Ok((name.as_str(), id))
        })
        .collect()
}

/// Returns the accessor of a compressed attribute.
fn accessor_of(primitive: &Value, name: &str) -> Result<usize, DocumentError> {
    primitive
        .get("attributes")
        .ok_or_else(|| invalid("a primitive has no attributes"))
        .and_then(|attributes| required(attributes, name))
}

/// Returns whether an accessor of the primitive gets its data only from the compressed stream.
fn lacks_data(body: &Body, primitive: &Value, compressed: &Value) -> Result<bool, DocumentError> {
    let mut accessors = Vec::new();
    for (name, _) in attribute_ids(compressed)? {
        accessors.push(accessor_of(primitive, name)?);
    }
    accessors.extend(unsigned(primitive, "indices")?);
    for accessor in accessors {
        if item(&body.json, "accessors", accessor)?
            .get("bufferView")
            .is_none()
        {
            return Ok(true);
        }
    }
    Ok(false)
}

fn decode(
    body: &mut Body,
    mut primitive: Value,
    compressed: &Value,
    budget: &mut usize,
) -> Result<Value, DocumentError> {
    let (bytes, _) = body.view(required(compressed, "bufferView")?)?;
    let mesh = decode_stream(bytes, *budget)?;
    // Store the attributes that have no uncompressed data.
    for (name, id) in attribute_ids(compressed)? {
        let accessor = accessor_of(&primitive, name)?;
        let object = item(&body.json, "accessors", accessor)?;
        if object.get("bufferView").is_some() {
            continue;
        }
        let attribute = mesh
            .attribute_by_unique_id(id)
            .ok_or_else(|| invalid(format!("the Draco data has no attribute {id}")))?;
        let component = Component::from_code(required(object, "componentType")?)
            .ok_or_else(|| invalid("unknown `componentType`"))?;
        let packed = packed(attribute, mesh.num_points(), component)?;
        spend(budget, packed.len())?;
        let width = usize::from(attribute.num_components());
        let view = body.push_vertices(&packed, width * component.size())?;
        let object = item_mut(&mut body.json, "accessors", accessor)?;
        object["bufferView"] = json!(view);
        object["count"] = json!(mesh.num_points());
        remove(object, "byteOffset");
        // Decoded numbers differ from the original ones, and so do their bounds.
        if name == "POSITION" || object.get("min").is_some() {
            bounds::set(object, &packed, component, width);
        }
    }
    // Store the faces.
    store_indices(body, &mut primitive, &mesh, budget)?;
    Ok(primitive)
}

fn spend(budget: &mut usize, bytes: usize) -> Result<(), DocumentError> {
    *budget = budget.checked_sub(bytes).ok_or_else(too_large)?;
    Ok(())
}

fn too_large() -> DocumentError {
    DocumentError::LimitExceeded("the decoded Draco data is too large".to_owned())
}

/// Decodes points and faces as in the stream: without deduplication, which would change the number of vertices.
fn decode_stream(bytes: &[u8], budget: usize) -> Result<Mesh, DocumentError> {
    let limits = DecodeLimits::default()
        .with_max_points(budget as u64 / 12)
        .with_max_faces(budget as u64 / 12)
        .with_max_decoded_bytes(budget as u64);
    let mut mesh = Mesh::new();
    MeshDecoder::new()
        .decode(
            &mut DecoderBuffer::new(bytes).with_limits(limits),
            &mut mesh,
        )
        .map_err(|error| match error.kind() {
            ErrorKind::LimitExceeded => too_large(),
            _ => invalid("damaged Draco data"),
        })?;
    if mesh.num_faces() == 0 {
        return Err(invalid("the Draco data is not a triangle mesh"));
    }
    Ok(mesh)
}

/// Returns the values of an attribute, one element per point.
fn packed(
    attribute: &PointAttribute,
    n_points: usize,
    component: Component,
) -> Result<Vec<u8>, DocumentError> {
    let width = usize::from(attribute.num_components());
    let size = attribute.data_type().byte_length();
    let data = attribute.buffer().data();
    let mut packed = Vec::with_capacity(n_points * width * component.size());
    for point in 0..n_points {
        let value = attribute.mapped_index(PointIndex(point as u32)).0 as usize;
        let element = value
            .checked_mul(width * size)
            .and_then(|start| data.get(start..)?.get(..width * size))
            .filter(|_| size > 0)
            .ok_or_else(|| invalid("damaged Draco data"))?;
        for scalar in element.chunks_exact(size) {
            component.push(number(attribute.data_type(), scalar), &mut packed);
        }
    }
    Ok(packed)
}

fn number(kind: DataType, bytes: &[u8]) -> f64 {
    match (kind, bytes) {
        (DataType::Int8, _) => Component::I8.read(bytes),
        (DataType::Uint8 | DataType::Bool, _) => Component::U8.read(bytes),
        (DataType::Int16, _) => Component::I16.read(bytes),
        (DataType::Uint16, _) => Component::U16.read(bytes),
        (DataType::Uint32, _) => Component::U32.read(bytes),
        (DataType::Float32, _) => Component::F32.read(bytes),
        (DataType::Int32, &[a, b, c, d]) => f64::from(i32::from_le_bytes([a, b, c, d])),
        (DataType::Float64, &[a, b, c, d, e, f, g, h]) => {
            f64::from_le_bytes([a, b, c, d, e, f, g, h])
        }
        (DataType::Int64, &[a, b, c, d, e, f, g, h]) => {
            i64::from_le_bytes([a, b, c, d, e, f, g, h]) as f64
        }
        (DataType::Uint64, &[a, b, c, d, e, f, g, h]) => {
            u64::from_le_bytes([a, b, c, d, e, f, g, h]) as f64
        }
        _ => 0.0,
    }
}

/// Writes the faces as a triangle list.
fn store_indices(
    body: &mut Body,
    primitive: &mut Value,
    mesh: &Mesh,
    budget: &mut usize,
) -> Result<(), DocumentError> {
    // Use the accessor of the indices, or a new one.
    let accessor = match unsigned(primitive, "indices")? {
        Some(accessor) => accessor,
        None => body.push_accessor(json!({"componentType": 5125, "count": 0, "type": "SCALAR"}))?,
    };
    // Keep the stated type if it is wide enough.
    let stated = Component::from_code(required(
        item(&body.json, "accessors", accessor)?,
        "componentType",
    )?);
    let needed = Component::for_indices(mesh.num_points());
    let component = match stated {
        Some(stated @ (Component::U8 | Component::U16 | Component::U32))
            if stated.size() >= needed.size() =>
        {
            stated
        }
        _ => needed,
    };
    // Write the corners, and drop the members that no longer hold.
    let mut packed = Vec::with_capacity(mesh.num_faces() * 3 * component.size());
    for corner in mesh.faces().iter().flatten() {
        component.push(f64::from(corner.0), &mut packed);
    }
    spend(budget, packed.len())?;
    let view = body.push_view(&packed, None, Target::Indices)?;
    let object = item_mut(&mut body.json, "accessors", accessor)?;
    object["bufferView"] = json!(view);
    object["componentType"] = json!(component.code());
    object["count"] = json!(mesh.num_faces() * 3);
    for member in ["byteOffset", "min", "max"] {
        remove(object, member);
    }
    primitive["indices"] = json!(accessor);
    primitive["mode"] = json!(4);
    Ok(())
}

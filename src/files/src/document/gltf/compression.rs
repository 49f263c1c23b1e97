//! `KHR_draco_mesh_compression`: primitives decoded into plain accessors.

use super::accessor::{self, Component};
use super::body::{GltfBody, Target};
use super::json::{
    extension, invalid, item, item_mut, items, primitive_mut, remove, remove_extension, required,
    unsigned,
};
use crate::document::DocumentError;
use ::meshopt::ffi;
use draco_core::{
    DataType, DecodeLimits, DecoderBuffer, ErrorKind, Mesh, MeshDecoder, PointAttribute, PointIndex,
};
use serde_json::{Value, json};
use std::ffi::c_void;

/// Name of the extension.
pub(super) const DRACO: &str = "KHR_draco_mesh_compression";

/// Returns the limit on the decoded size of this number of compressed bytes: far above real ratios, with a fixed
/// allowance for small streams, since a kilobyte may validly describe millions of points.
pub(super) fn most_decoded(compressed: usize) -> usize {
    const FEW: usize = 256 << 20;
    const MANY: usize = 1 << 31;
    const RATIO: usize = 64;
    compressed.saturating_mul(RATIO).clamp(FEW, MANY)
}

/// Decodes every compressed primitive. If the file also has uncompressed data, that is used instead.
pub(super) fn decompress(body: &mut GltfBody) -> Result<(), DocumentError> {
    let mut budget = most_decoded(body.bin.len());
    for mesh in 0..items(&body.json, "meshes")?.len() {
        for primitive in 0..items(item(&body.json, "meshes", mesh)?, "primitives")?.len() {
            let object = primitive_mut(&mut body.json, mesh, primitive)?;
            let Some(compressed) = remove_extension(object, DRACO) else {
                continue;
            };
            let object = object.clone();
            if lacks_data(body, &object, &compressed)? {
                let changed = decode_primitive(body, object, &compressed, &mut budget)?;
                *primitive_mut(&mut body.json, mesh, primitive)? = changed;
            }
        }
    }
    Ok(())
}

/// Returns attribute names and Draco ids of a compressed primitive.
fn attribute_ids(compressed: &Value) -> Result<Vec<(&str, u32)>, DocumentError> {
    let Some(Value::Object(attributes)) = compressed.get("attributes") else {
        return Err(invalid(format!("{DRACO} names no attributes")));
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
fn lacks_data(
    body: &GltfBody,
    primitive: &Value,
    compressed: &Value,
) -> Result<bool, DocumentError> {
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

fn decode_primitive(
    body: &mut GltfBody,
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
            accessor::set(object, &packed, component, width);
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
    body: &mut GltfBody,
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

// `EXT_meshopt_compression` and `KHR_meshopt_compression`: buffer views in the codecs of meshoptimizer.

/// Both names of the extension.
pub(super) const MESHOPT: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Largest compression ratio of the codecs: 256 vertices of four constant bytes each in one byte.
const MAX_RATIO: usize = 1024;

/// Returns the extension of a buffer view and its name.
pub(super) fn of_view(view: &Value) -> Option<(&'static str, &Value)> {
    MESHOPT
        .into_iter()
        .find_map(|name| Some((name, extension(view, name)?)))
}

/// Returns whether a buffer serves only readers that do not know the extension.
pub(super) fn is_fallback(buffer: &Value) -> bool {
    MESHOPT.into_iter().any(|name| {
        extension(buffer, name)
            .and_then(|extension| extension.get("fallback"))
            .is_some_and(|fallback| fallback == &Value::Bool(true))
    })
}

#[derive(Clone, Copy)]
enum MeshoptMode {
    Attributes,
    Triangles,
    Indices,
}

#[derive(Clone, Copy)]
enum Filter {
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

/// Returns the number of bytes that a compressed view claims to represent.
pub(super) fn claimed_size(extension: &Value) -> Result<usize, DocumentError> {
    let (count, stride) = (
        required(extension, "count")?,
        required(extension, "byteStride")?,
    );
    Ok(count.saturating_mul(stride))
}

/// Returns the decoded bytes of a compressed view.
pub(super) fn decode_view(extension: &Value, data: &[u8]) -> Result<Vec<u8>, DocumentError> {
    let text = |key| extension.get(key).and_then(Value::as_str);
    // Check what the decoders require: mode, filter, count and stride.
    let mode = match text("mode") {
        Some("ATTRIBUTES") => MeshoptMode::Attributes,
        Some("TRIANGLES") => MeshoptMode::Triangles,
        Some("INDICES") => MeshoptMode::Indices,
        _ => return Err(invalid("unknown meshopt `mode`")),
    };
    let filter = match text("filter") {
        None | Some("NONE") => Filter::None,
        Some("OCTAHEDRAL") => Filter::Octahedral,
        Some("QUATERNION") => Filter::Quaternion,
        Some("EXPONENTIAL") => Filter::Exponential,
        Some("COLOR") => Filter::Color,
        Some(_) => return Err(invalid("unknown meshopt `filter`")),
    };
    let count = required(extension, "count")?;
    let stride = required(extension, "byteStride")?;
    let fits = match (mode, filter) {
        (MeshoptMode::Attributes, Filter::None | Filter::Exponential) => {
            (4..=256).contains(&stride) && stride % 4 == 0
        }
        (MeshoptMode::Attributes, Filter::Octahedral | Filter::Color) => stride == 4 || stride == 8,
        (MeshoptMode::Attributes, Filter::Quaternion) => stride == 8,
        (MeshoptMode::Triangles, Filter::None) => (stride == 2 || stride == 4) && count % 3 == 0,
        (MeshoptMode::Indices, Filter::None) => stride == 2 || stride == 4,
        _ => false,
    };
    if !fits {
        return Err(invalid(
            "meshopt mode, filter and stride contradict each other",
        ));
    }
    // Refuse sizes that the data cannot have before anything is allocated.
    let size = count
        .checked_mul(stride)
        .filter(|size| size / MAX_RATIO <= data.len())
        .ok_or_else(|| {
            DocumentError::LimitExceeded(
                "a compressed buffer view claims too many bytes".to_owned(),
            )
        })?;
    // Decode, reverse the filter, and take the bytes.
    let mut words = vec![0u64; size.div_ceil(8)];
    if !decode_into(&mut words, mode, count, stride, data) {
        return Err(invalid("its meshopt data is damaged"));
    }
    apply(&mut words, filter, count, stride);
    let mut bytes = Vec::with_capacity(words.len() * size_of::<u64>());
    for word in words {
        bytes.extend_from_slice(&word.to_ne_bytes());
    }
    bytes.truncate(size);
    Ok(bytes)
}

/// Decodes into `words`, which must hold `count` elements of `stride` bytes; returns `false` if the data is damaged.
#[allow(unsafe_code)]
fn decode_into(
    words: &mut [u64],
    mode: MeshoptMode,
    count: usize,
    stride: usize,
    data: &[u8],
) -> bool {
    assert!(count * stride <= size_of_val(words));
    let out = words.as_mut_ptr().cast::<c_void>();
    // SAFETY: `out` is valid for writes of count × stride bytes (asserted above) and aligned to 8; `data` is valid for
    // reads of its length, beyond which the decoders do not read: they check every access against the end and report
    // damage. The preconditions that the C++ code asserts were checked in `decode_view`: vertex strides are multiples of 4
    // from 4 to 256, index sizes 2 or 4, triangle counts multiples of 3. Any byte pattern is a valid u64.
    let status = unsafe {
        match mode {
            MeshoptMode::Attributes => {
                ffi::meshopt_decodeVertexBuffer(out, count, stride, data.as_ptr(), data.len())
            }
            MeshoptMode::Triangles => {
                ffi::meshopt_decodeIndexBuffer(out, count, stride, data.as_ptr(), data.len())
            }
            MeshoptMode::Indices => {
                ffi::meshopt_decodeIndexSequence(out, count, stride, data.as_ptr(), data.len())
            }
        }
    };
    status == 0
}

/// Reverses the filter in place.
#[allow(unsafe_code)]
fn apply(words: &mut [u64], filter: Filter, count: usize, stride: usize) {
    assert!(count * stride <= size_of_val(words));
    let data = words.as_mut_ptr().cast::<c_void>();
    // SAFETY: `data` is valid for reads and writes of count × stride bytes (asserted above), which is all the filters
    // touch, and aligned to 8 for the 2- and 4-byte components they access. The strides that the C++ code asserts were
    // checked in `decode_view`: 4 or 8 for octahedral and color, 8 for quaternion, a multiple of 4 for exponential.
    unsafe {
        match filter {
            Filter::None => {}
            Filter::Octahedral => ffi::meshopt_decodeFilterOct(data, count, stride),
            Filter::Quaternion => ffi::meshopt_decodeFilterQuat(data, count, stride),
            Filter::Exponential => ffi::meshopt_decodeFilterExp(data, count, stride),
            Filter::Color => ffi::meshopt_decodeFilterColor(data, count, stride),
        }
    }
}

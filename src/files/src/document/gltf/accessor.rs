//! Accessors: typed arrays over the binary data, checked against the bytes that really exist.

use super::body::GltfBody;
use super::json::{invalid, item, required, unsigned};
use crate::document::DocumentError;
use serde_json::{Value, json};

/// Largest count that is accepted without bytes behind it. Such accessors carry the sparse morph targets of large
/// meshes, so it is as large as a mesh.
const MAX_UNBACKED: usize = 1 << 26;

/// A checked accessor: every element lies within the data.
pub(super) struct Accessor<'a> {
    pub component: Component,
    /// Components per element.
    pub width: usize,
    /// Bytes per element, including the padding of matrix columns.
    pub element_size: usize,
    pub count: usize,
    normalized: bool,
    kind: &'a str,
    base: Option<Strided<'a>>,
    sparse: Option<Sparse<'a>>,
}

/// Elements at equal distances.
struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
}

/// Elements that replace those of the base.
struct Sparse<'a> {
    count: usize,
    index_type: Component,
    indices: Strided<'a>,
    values: Strided<'a>,
}

impl<'a> Accessor<'a> {
    /// Opens accessor `index` of the document.
    pub fn open(body: &'a GltfBody, index: usize) -> Result<Self, DocumentError> {
        let object = item(&body.json, "accessors", index)?;
        Self::parse(body, object).map_err(|error| match error {
            DocumentError::InvalidGltf(message) => {
                invalid(format!("accessors[{index}]: {message}"))
            }
            error => error,
        })
    }

    fn parse(body: &'a GltfBody, object: &'a Value) -> Result<Self, DocumentError> {
        let component = component_type(object)?;
        let kind = object.get("type").and_then(Value::as_str).unwrap_or("");
        let (columns, rows) = shape(kind).ok_or_else(|| invalid("unknown `type`"))?;
        let column_size = rows * component.size();
        // Columns of matrices start at multiples of four bytes.
        let element_size = match columns {
            1 => column_size,
            columns => columns * column_size.next_multiple_of(4),
        };
        let count = required(object, "count")?;
        // Find the elements, and check that all of them lie within the bytes.
        let base = if object.get("bufferView").is_some() {
            Some(strided(body, object, count, element_size)?)
        } else {
            None
        };
        let sparse = object
            .get("sparse")
            .map(|sparse| parse_sparse(body, sparse, count, element_size))
            .transpose()?;
        Ok(Self {
            component,
            width: columns * rows,
            element_size,
            count,
            normalized: object.get("normalized") == Some(&Value::Bool(true)),
            kind,
            base,
            sparse,
        })
    }

    /// Returns whether the elements are of the type `kind`, such as `VEC3`.
    pub fn is(&self, kind: &str) -> bool {
        self.kind == kind
    }

    /// Returns the type of its elements, such as `VEC3`.
    pub fn kind(&self) -> &'a str {
        self.kind
    }

    /// Returns whether its integers represent numbers in [−1, 1].
    pub fn is_normalized(&self) -> bool {
        self.normalized
    }

    /// Returns whether the count is backed by bytes: an accessor without a view is all zeros, however many it claims.
    pub fn is_backed(&self) -> bool {
        self.base.is_some()
    }

    /// Returns whether there is any data; without it all elements are zero.
    pub fn has_data(&self) -> bool {
        self.base.is_some() || self.sparse.is_some()
    }

    /// Returns the raw bytes of all elements without gaps, with sparse replacements applied.
    pub fn packed(&self) -> Result<Vec<u8>, DocumentError> {
        if self.base.is_none() && self.count > MAX_UNBACKED {
            return Err(DocumentError::LimitExceeded(format!(
                "an accessor without data has {} elements",
                self.count
            )));
        }
        let size = self.element_size;
        let mut packed = Vec::with_capacity(self.count * size);
        match &self.base {
            Some(base) => {
                for index in 0..self.count {
                    packed.extend_from_slice(base.element(index, size));
                }
            }
            None => packed.resize(self.count * size, 0),
        }
        if let Some(sparse) = &self.sparse {
            for entry in 0..sparse.count {
                let bytes = sparse.indices.element(entry, sparse.index_type.size());
                let index = sparse.index_type.read(bytes) as usize;
                packed
                    .get_mut(index * size..(index + 1) * size)
                    .ok_or_else(|| invalid("a sparse index is out of range"))?
                    .copy_from_slice(sparse.values.element(entry, size));
            }
        }
        Ok(packed)
    }

    /// Returns all components as numbers; normalized integers lie in [−1, 1].
    pub fn values(&self) -> Result<Vec<f64>, DocumentError> {
        let packed = self.packed()?;
        let raw = packed
            .chunks_exact(self.component.size())
            .map(|bytes| self.component.read(bytes));
        if self.normalized {
            let one = self.component.one();
            Ok(raw.map(|value| (value / one).max(-1.0)).collect())
        } else {
            Ok(raw.collect())
        }
    }

    /// Returns all components as f32 in groups of `N`.
    pub fn vectors<const N: usize>(&self) -> Result<Vec<[f32; N]>, DocumentError> {
        let values = self.values()?;
        let vectors = values.chunks_exact(N);
        Ok(vectors
            .map(|vector| std::array::from_fn(|axis| vector[axis] as f32))
            .collect())
    }
}

impl<'a> Strided<'a> {
    fn element(&self, index: usize, size: usize) -> &'a [u8] {
        &self.bytes[index * self.stride..][..size]
    }
}

/// Reads the `componentType` of an accessor or of sparse indices.
fn component_type(object: &Value) -> Result<Component, DocumentError> {
    Component::from_code(required(object, "componentType")?)
        .ok_or_else(|| invalid("unknown `componentType`"))
}

/// Returns the columns and rows of an element.
fn shape(kind: &str) -> Option<(usize, usize)> {
    Some(match kind {
        "SCALAR" => (1, 1),
        "VEC2" => (1, 2),
        "VEC3" => (1, 3),
        "VEC4" => (1, 4),
        "MAT2" => (2, 2),
        "MAT3" => (3, 3),
        "MAT4" => (4, 4),
        _ => return None,
    })
}

/// Returns the elements at the `bufferView` and `byteOffset` of `object`, all of them within the view.
fn strided<'a>(
    body: &'a GltfBody,
    object: &Value,
    count: usize,
    size: usize,
) -> Result<Strided<'a>, DocumentError> {
    let (bytes, stride) = body.view(required(object, "bufferView")?)?;
    let offset = unsigned(object, "byteOffset")?.unwrap_or(0);
    let stride = stride.unwrap_or(size);
    if stride < size {
        return Err(invalid("`byteStride` is smaller than an element"));
    }
    let needed = match count {
        0 => Some(0),
        count => stride
            .checked_mul(count - 1)
            .and_then(|last| last.checked_add(size)),
    };
    bytes
        .get(offset..)
        .filter(|bytes| needed.is_some_and(|needed| needed <= bytes.len()))
        .map(|bytes| Strided { bytes, stride })
        .ok_or_else(|| invalid("it reaches beyond its buffer view"))
}

fn parse_sparse<'a>(
    body: &'a GltfBody,
    sparse: &Value,
    count: usize,
    size: usize,
) -> Result<Sparse<'a>, DocumentError> {
    let n_entries = required(sparse, "count")?;
    if n_entries > count {
        return Err(invalid("`sparse.count` is greater than `count`"));
    }
    let part = |key| {
        sparse
            .get(key)
            .ok_or_else(|| invalid(format!("`sparse.{key}` is missing")))
    };
    let index_type = component_type(part("indices")?)?;
    if !matches!(index_type, Component::U8 | Component::U16 | Component::U32) {
        return Err(invalid("sparse indices are not unsigned integers"));
    }
    Ok(Sparse {
        count: n_entries,
        index_type,
        indices: strided(body, part("indices")?, n_entries, index_type.size())?,
        values: strided(body, part("values")?, n_entries, size)?,
    })
}

// The component types of accessors.

/// Type of one component of an accessor element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    /// Returns the type for a `componentType`.
    pub fn from_code(code: usize) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    /// Returns the `componentType`.
    pub fn code(self) -> usize {
        match self {
            Self::I8 => 5120,
            Self::U8 => 5121,
            Self::I16 => 5122,
            Self::U16 => 5123,
            Self::U32 => 5125,
            Self::F32 => 5126,
        }
    }

    /// Returns the size in bytes.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// Returns the smallest unsigned type whose restart value is not a vertex index.
    pub fn for_indices(n_vertices: usize) -> Self {
        match n_vertices {
            ..=255 => Self::U8,
            256..=65_535 => Self::U16,
            _ => Self::U32,
        }
    }

    /// Returns the number in the first bytes of `bytes`; 0 if they are too few.
    pub fn read(self, bytes: &[u8]) -> f64 {
        match (self, bytes) {
            (Self::I8, &[a, ..]) => f64::from(a.cast_signed()),
            (Self::U8, &[a, ..]) => f64::from(a),
            (Self::I16, &[a, b, ..]) => f64::from(i16::from_le_bytes([a, b])),
            (Self::U16, &[a, b, ..]) => f64::from(u16::from_le_bytes([a, b])),
            (Self::U32, &[a, b, c, d, ..]) => f64::from(u32::from_le_bytes([a, b, c, d])),
            (Self::F32, &[a, b, c, d, ..]) => f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => 0.0,
        }
    }

    /// Appends `value`, saturated if the type is narrower.
    pub fn push(self, value: f64, bytes: &mut Vec<u8>) {
        match self {
            Self::I8 => bytes.extend_from_slice(&(value as i8).to_le_bytes()),
            Self::U8 => bytes.push(value as u8),
            Self::I16 => bytes.extend_from_slice(&(value as i16).to_le_bytes()),
            Self::U16 => bytes.extend_from_slice(&(value as u16).to_le_bytes()),
            Self::U32 => bytes.extend_from_slice(&(value as u32).to_le_bytes()),
            Self::F32 => bytes.extend_from_slice(&(value as f32).to_le_bytes()),
        }
    }

    /// Returns the number that stands for 1 in a normalized accessor.
    pub fn one(self) -> f64 {
        match self {
            Self::I8 => f64::from(i8::MAX),
            Self::U8 => f64::from(u8::MAX),
            Self::I16 => f64::from(i16::MAX),
            Self::U16 => f64::from(u16::MAX),
            Self::U32 => f64::from(u32::MAX),
            Self::F32 => 1.0,
        }
    }
}

// `min` and `max` of accessors.

/// Writes the smallest and largest value of each component, in the stored encoding.
pub(super) fn set(accessor: &mut Value, packed: &[u8], component: Component, width: usize) {
    let mut low = vec![f64::INFINITY; width];
    let mut high = vec![f64::NEG_INFINITY; width];
    for element in packed.chunks_exact(component.size() * width) {
        for (axis, bytes) in element.chunks_exact(component.size()).enumerate() {
            let value = component.read(bytes);
            low[axis] = low[axis].min(value);
            high[axis] = high[axis].max(value);
        }
    }
    let numbers = |values: Vec<f64>| -> Value {
        let is_integer = component != Component::F32;
        values
            .into_iter()
            .map(|value: f64| {
                if is_integer {
                    json!(value as i64)
                } else {
                    json!(value)
                }
            })
            .collect()
    };
    accessor["min"] = numbers(low);
    accessor["max"] = numbers(high);
}

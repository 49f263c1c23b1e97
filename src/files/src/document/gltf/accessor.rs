//! Accessors: typed arrays over the binary data, checked against the bytes that really exist.
use super::body::Body;
use super::component::Component;
use super::json::{invalid, item, required, unsigned};
use crate::document::DocumentError;
use serde_json::Value;

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
    pub fn open(body: &'a Body, index: usize) -> Result<Self, DocumentError> {
        let object = item(&body.json, "accessors", index)?;
        Self::parse(body, object).map_err(|error| match error {
            DocumentError::InvalidGltf(message) => {
                invalid(format!("accessors[{index}]: {message}"))
            }
            error => error,
        })
    }

    fn parse(body: &'a Body, object: &'a Value) -> Result<Self, DocumentError> {
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
    body: &'a Body,
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
    body: &'a Body,
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

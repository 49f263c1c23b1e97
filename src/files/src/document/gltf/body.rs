//! The document of record: its JSON and its binary data.
use super::json::{array_mut, invalid, item, item_mut, required, unsigned};
use crate::document::DocumentError;
use serde_json::{Map, Value, json};

/// Purpose of a buffer view in graphics interfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
    Vertices,
    Indices,
    Other,
}

/// JSON in which every buffer view lies in `buffers[0]`, and the bytes of that buffer.
#[derive(Debug, Clone)]
pub(super) struct GltfBody {
    pub json: Value,
    pub bin: Vec<u8>,
}

impl GltfBody {
    /// Returns the bytes of a buffer view and its stride.
    pub fn view(&self, index: usize) -> Result<(&[u8], Option<usize>), DocumentError> {
        let view = item(&self.json, "bufferViews", index)?;
        let offset = unsigned(view, "byteOffset")?.unwrap_or(0);
        let length = required(view, "byteLength")?;
        let bytes = offset
            .checked_add(length)
            .and_then(|end| self.bin.get(offset..end))
            .ok_or_else(|| invalid(format!("bufferViews[{index}] reaches beyond its buffer")))?;
        Ok((bytes, unsigned(view, "byteStride")?))
    }

    /// Appends bytes, aligned to four, and returns their start.
    pub fn push_bytes(&mut self, bytes: &[u8]) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let offset = self.bin.len();
        self.bin.extend_from_slice(bytes);
        offset
    }

    /// Appends a buffer view and returns its index.
    pub fn push_view(
        &mut self,
        bytes: &[u8],
        stride: Option<usize>,
        target: Target,
    ) -> Result<usize, DocumentError> {
        let offset = self.push_bytes(bytes);
        let mut view = Map::new();
        view.insert("buffer".to_owned(), json!(0));
        view.insert("byteOffset".to_owned(), json!(offset));
        view.insert("byteLength".to_owned(), json!(bytes.len()));
        if let Some(stride) = stride {
            view.insert("byteStride".to_owned(), json!(stride));
        }
        match target {
            Target::Vertices => drop(view.insert("target".to_owned(), json!(34962))),
            Target::Indices => drop(view.insert("target".to_owned(), json!(34963))),
            Target::Other => {}
        }
        let views = array_mut(&mut self.json, "bufferViews")?;
        views.push(Value::Object(view));
        Ok(views.len() - 1)
    }

    /// Appends vertex data of `size` bytes per element; elements start at multiples of four bytes, as glTF demands.
    pub fn push_vertices(&mut self, packed: &[u8], size: usize) -> Result<usize, DocumentError> {
        let stride = size.next_multiple_of(4);
        if stride == size {
            return self.push_view(packed, None, Target::Vertices);
        }
        let mut padded = Vec::with_capacity(packed.len() / size.max(1) * stride);
        for element in packed.chunks_exact(size) {
            padded.extend_from_slice(element);
            padded.resize(padded.len() + stride - size, 0);
        }
        self.push_view(&padded, Some(stride), Target::Vertices)
    }

    /// Appends an accessor and returns its index.
    pub fn push_accessor(&mut self, accessor: Value) -> Result<usize, DocumentError> {
        let accessors = array_mut(&mut self.json, "accessors")?;
        accessors.push(accessor);
        Ok(accessors.len() - 1)
    }

    /// Sets the length of the buffer; a document without one gets it with the first byte.
    pub fn seal(&mut self) -> Result<(), DocumentError> {
        if self.bin.is_empty() {
            return Ok(());
        }
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let buffers = array_mut(&mut self.json, "buffers")?;
        if buffers.is_empty() {
            buffers.push(json!({}));
        }
        item_mut(&mut self.json, "buffers", 0)?["byteLength"] = json!(self.bin.len());
        Ok(())
    }
}

//! Compaction of the binary data to the bytes of its buffer views.
use super::body::Body;
use super::json::{array_mut, items, required, unsigned};
use crate::document::DocumentError;
use serde_json::json;

/// Alignment of accessors in bytes, sufficient for all components.
const ALIGNMENT: usize = 4;

/// Removes the bytes that lie in no buffer view. Views that overlap still do so.
pub(super) fn repack_bytes(body: &mut Body) -> Result<(), DocumentError> {
    let mut ranges = Vec::new();
    for (index, view) in items(&body.json, "bufferViews")?.iter().enumerate() {
        let start = unsigned(view, "byteOffset")?.unwrap_or(0);
        ranges.push((start, start + required(view, "byteLength")?, index));
    }
    if ranges.is_empty() {
        return Ok(());
    }
    ranges.sort_unstable();
    let old = std::mem::take(&mut body.bin);
    let mut offsets = vec![0; ranges.len()];
    let mut rest = ranges.as_slice();
    while let [(start, mut end, _), ..] = *rest {
        let mut n_joined = 0;
        while let Some((next, next_end, _)) = rest.get(n_joined)
            && (n_joined == 0 || *next < end)
        {
            end = end.max(*next_end);
            n_joined += 1;
        }
        let (joined, others) = rest.split_at(n_joined);
        rest = others;
        let base = body.bin.len().next_multiple_of(ALIGNMENT) + start % ALIGNMENT;
        body.bin.resize(base, 0);
        body.bin
            .extend_from_slice(old.get(start..end).unwrap_or_default());
        for (begin, _, index) in joined {
            offsets[*index] = base + begin - start;
        }
    }
    let views = array_mut(&mut body.json, "bufferViews")?;
    for (view, offset) in views.iter_mut().zip(offsets) {
        if offset > 0 || view.get("byteOffset").is_some() {
            view["byteOffset"] = json!(offset);
        }
    }
    Ok(())
}

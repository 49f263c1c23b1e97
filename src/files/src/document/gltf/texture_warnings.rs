//! Warnings about textures that the new UVs do not fit.
use super::{GltfDocument, names};
use crate::document::warning::listed;
use crate::document::{Warning, WriteNotes};

/// Returns warnings about textures that show the old layout, and about those that could not be resampled, with the reason.
pub(super) fn texture_warnings(document: &GltfDocument, notes: &WriteNotes) -> Vec<Warning> {
    let named = |slot: &str, material: Option<usize>| {
        let slot = slot.rsplit('/').next().unwrap_or_default();
        match material {
            Some(material) => format!("{slot} of {}", names::of_material(document, material)),
            None => slot.to_owned(),
        }
    };
    let stale: Vec<String> = (notes.textures_affected.iter())
        .map(|texture| named(&texture.slot, texture.material))
        .collect();
    let mut warnings = Vec::new();
    if !stale.is_empty() {
        let stale = listed(stale.iter().map(String::as_str));
        let text = format!("textures show the old layout ({stale}); `--rebake` resamples them");
        warnings.push(Warning::new("textures_stale", text));
    }
    warnings.extend(notes.textures_kept.iter().map(|kept| {
        let texture = named(&kept.slot, kept.material);
        let text = format!(
            "{texture} is not resampled and keeps its UVs: {}",
            kept.reason
        );
        Warning::new("textures_kept", text)
    }));
    warnings
}

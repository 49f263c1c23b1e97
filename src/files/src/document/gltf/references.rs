//! Files to which a glTF refers, for callers that gather them.
use super::{glb, tree, uri, without_mark};

/// Returns the relative paths of the buffers and images to which a glTF file refers, as
/// [`Upload::resources`](crate::document::Upload) names them. Empty for any other content; data URIs, absolute paths,
/// schemes and paths that leave the folder are left out.
pub fn references(bytes: &[u8]) -> Vec<String> {
    let json = if glb::is_glb(bytes) {
        glb::split(bytes).map_or(&[][..], |container| container.json)
    } else {
        without_mark(bytes)
    };
    let root = tree::parse(json).unwrap_or_default();
    let members = ["buffers", "images"].map(|key| root[key].as_array());
    let mut paths: Vec<String> = members
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(|member| member["uri"].as_str())
        .filter(|text| !uri::is_data(text))
        .flat_map(uri::candidates)
        .collect();
    paths.sort();
    paths.dedup();
    paths
}

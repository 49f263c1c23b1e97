//! glTF 2.0, `.glb` and `.gltf`.
//!
//! The document of record is the JSON value itself, with its order and numbers: untouched parts cannot be lost. Reading
//! normalizes it: all buffers are joined into one array of bytes, Draco and meshopt data are decoded into plain
//! accessors. Accessors are read by a reader that checks each against the bytes that really exist. Writing appends: new
//! views and accessors follow the old ones, and the primitives refer to them; accessors that may be shared are never
//! changed. Objects that lose their last reference are then replaced by new ones or removed.
mod accessor;
mod as_obj;
mod bake_plan;
mod body;
mod buffers;
mod compression;
mod document;
mod extensions;
mod geometry;
mod images;
mod join;
mod json;
mod links;
mod marking;
mod merge;
mod primitives;
mod replacement;
mod rewrite;
mod scene;
mod slots;
mod tangents;
mod texcoord_set;
mod textures;
mod tiling;
mod vertex_colors;
mod write;

pub use buffers::references;
pub use document::GltfDocument;
pub use tangents::tangents;
pub use tiling::TiledTexture;

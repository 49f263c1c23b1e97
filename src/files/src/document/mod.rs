//! glTF and other files, read and written with everything else preserved.
//!
//! A [`Document`] is the whole content of a file; [`Primitive`]s are the triangles in it. Nothing is welded, repaired
//! or reordered here: positions are rounded to f32 and otherwise passed on as in the file, and a new UV set is written
//! into the document of record, so nothing that an unwrapping was not asked to change can be lost.
//!
//! This module does no input or output of its own. An [`Upload`] carries the main file and every file to which it may
//! refer; a URI that is neither data nor a member of the upload is an error, never an open file or a connection. Every
//! input is treated as hostile: counts are believed only as far as bytes back them, and every failure is a
//! [`DocumentError`].
#![doc = include_str!("formats.md")]
mod bake;
mod content;
mod error;
pub mod gltf;
mod group;
mod mark;
mod material;
mod merge;
mod new_gltf;
mod new_obj;
pub mod obj;
mod obj_gltf;
mod obj_text;
pub mod soup;
mod uri;
mod uvs;
mod write;

pub use bake::{
    BakePlan, BakePlane, BakeRequest, BakedTexture, BakedTextures, CornerTangents, Encoding,
    KeptTexture, PlaneSource, TextureSource, Tint, Wrap,
};
pub use content::{Document, references, with_references};
pub use error::DocumentError;
pub use group::{AddedVertex, Group, GroupBy, Primitive, SpaceMap, Subdivision};
pub use mark::{Mark, Marked, Sets, Terms};
pub use merge::{
    ApartMaterial, JoinedPart, JoinedPrimitive, MaterialMerge, MergeNote, MergePlan,
    MergedMaterial, MergedNote,
};
pub use unwrapd_api::{Upload, Warning};
pub use uri::format_of;
pub use uvs::{
    AffectedTexture, Corners, Layout, NewUvs, OutputFormat, PrimitiveNote, TangentsNote,
    WriteNotes, WriteOptions, Written,
};
pub use write::{Conversion, OldUvs};

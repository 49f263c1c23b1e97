//! A file with the files that it refers to.

use std::collections::BTreeMap;

use crate::extension;

/// Name of the optional file with the initial positions of vertices: coordinates as consecutive `f64`, little-endian.
///
/// For bodies and pictures these are the vertices of the mesh, or of the mesh made for the input; for UVs, the
/// corners of each face that has UVs, in file order. Rest shapes and the places that handles name are still those of
/// the input.
pub const START: &str = "start.f64";

/// A main file and the files it may refer to.
#[derive(Debug, Clone, Default)]
pub struct Upload {
    /// File name of the main file; its extension decides if the content does not.
    pub name: String,
    /// Content of the main file.
    pub bytes: Vec<u8>,
    /// Other files by their path relative to the main file, decoded and with `/` between folders.
    pub resources: BTreeMap<String, Vec<u8>>,
}

impl Upload {
    /// Creates an upload of one file.
    pub fn single(name: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self {
            name: name.into(),
            bytes,
            resources: BTreeMap::new(),
        }
    }

    /// Returns the extension of the main file in lower case, without the dot; empty if there is none.
    pub fn extension(&self) -> String {
        extension(&self.name)
    }
}

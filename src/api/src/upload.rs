//! A file with the files that it refers to.

use std::collections::BTreeMap;

use crate::extension;

/// The name of the file beside an input that says where vertices are when handles begin to pull: coordinates one after another,
/// `f64`, little-endian.
///
/// For bodies and pictures these are the vertices of the mesh, or of that which is made for the input; for UVs the corners of each
/// face that has UVs, in file order. Rest shapes and the places that handles name are those of the input all the same.
pub const START: &str = "start.f64";

/// A main file and the files it may refer to.
#[derive(Debug, Clone, Default)]
pub struct Upload {
    /// File name of the main file; its extension decides where the content does not.
    pub name: String,
    /// Content of the main file.
    pub bytes: Vec<u8>,
    /// The other files by their path relative to the main file, decoded and with `/` between folders.
    pub resources: BTreeMap<String, Vec<u8>>,
}

impl Upload {
    /// A file that refers to no other.
    pub fn single(name: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self {
            name: name.into(),
            bytes,
            resources: BTreeMap::new(),
        }
    }

    /// The extension of the main file in lower case, without the dot; empty where there is none.
    pub fn extension(&self) -> String {
        extension(&self.name)
    }
}

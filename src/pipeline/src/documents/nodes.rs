//! Definition of the surfaces of a scene.

use std::borrow::Cow;

use unwrapd_files::document::{Document, DocumentError, Primitive};

/// Definition of the surfaces of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nodes {
    /// Each mesh in its own space, however often and wherever nodes show it.
    Shared,
    /// Each instance of a mesh at its place in the scene.
    Separate,
}

impl Nodes {
    /// Returns the document with one mesh per surface.
    pub fn prepared(self, document: Document) -> Result<Document, DocumentError> {
        match self {
            Self::Shared => Ok(document),
            Self::Separate => document.with_separate_meshes(),
        }
    }

    /// Returns the primitives with the shapes of the surfaces.
    pub fn primitives(self, document: &Document) -> Result<Cow<'_, [Primitive]>, DocumentError> {
        match self {
            Self::Shared => Ok(Cow::Borrowed(document.primitives())),
            Self::Separate => document.primitives_in_scene().map(Cow::Owned),
        }
    }
}

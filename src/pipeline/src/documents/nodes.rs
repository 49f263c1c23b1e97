//! What counts as a surface of a scene.

use std::borrow::Cow;

use unwrapd_files::document::{Document, DocumentError, Primitive};

/// What counts as a surface of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nodes {
    /// A mesh, in its own space, wherever and how often nodes show it.
    Shared,
    /// What a node shows of a mesh, where it is in the scene.
    Separate,
}

impl Nodes {
    /// The document with as many meshes as there are such surfaces.
    pub fn prepared(self, document: Document) -> Result<Document, DocumentError> {
        match self {
            Self::Shared => Ok(document),
            Self::Separate => document.with_separate_meshes(),
        }
    }

    /// The primitives with the shapes that count.
    pub fn primitives(self, document: &Document) -> Result<Cow<'_, [Primitive]>, DocumentError> {
        match self {
            Self::Shared => Ok(Cow::Borrowed(document.primitives())),
            Self::Separate => document.primitives_in_scene().map(Cow::Owned),
        }
    }
}

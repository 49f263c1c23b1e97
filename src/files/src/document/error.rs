//! Errors of reading and writing documents.

use thiserror::Error;
use unwrapd_api::Warning;

/// Reason why a file cannot be read or written.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum DocumentError {
    /// The file is valid but has no triangle.
    #[error("the file has no triangles")]
    NoTriangles,
    /// Neither the content nor the name indicates a readable format.
    #[error("not a glTF, OBJ, OFF, PLY or STL file")]
    UnknownFormat,
    /// The file is glTF but breaks rules that matter here.
    #[error("invalid glTF: {0}")]
    InvalidGltf(String),
    /// The file is OBJ, OFF, PLY or STL but cannot be parsed.
    #[error("invalid mesh file: {0}")]
    InvalidMesh(String),
    /// A glTF version other than 2.
    #[error("glTF version {0} is not supported, only 2.x")]
    UnsupportedVersion(String),
    /// The file requires an unknown extension.
    #[error("the file requires the extension {0}, which is not supported")]
    UnsupportedExtension(String),
    /// A URI is neither data nor a file of the upload.
    #[error("the file references `{0}`, which was not supplied")]
    MissingResource(String),
    /// A face names a vertex that does not exist.
    #[error("vertex index out of range: {0}")]
    IndexOutOfRange(String),
    /// A vertex position is infinite or not a number.
    #[error("a vertex position is not finite: {0}")]
    NonFinitePosition(String),
    /// The file demands more than is reasonable for its size.
    #[error("limit exceeded: {0}")]
    LimitExceeded(String),
    /// The output format cannot hold this document.
    #[error("cannot write {0}")]
    UnsupportedOutput(String),
    /// A node shows a mesh several times, but each instance is to have UVs of its own.
    #[error(
        "node {0} has instances (EXT_mesh_gpu_instancing), which cannot have UVs of their own; make them nodes"
    )]
    Instanced(usize),
    /// Triangles are to be cut, but some attribute cannot be interpolated.
    #[error("triangles cannot be split: {0} cannot be interpolated")]
    Indivisible(String),
    /// A texture samples the requested set.
    #[error("textures sample UV set {0}; choose another, or overwrite it")]
    TexcoordInUse(u32),
    /// The UVs to write do not fit the document.
    #[error("the UVs do not match the primitives of the document")]
    InvalidUvs,
}

impl DocumentError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NoTriangles => "no_triangles",
            Self::UnknownFormat => "unknown_format",
            Self::InvalidGltf(_) => "invalid_gltf",
            Self::InvalidMesh(_) => "invalid_mesh",
            Self::UnsupportedVersion(_) => "unsupported_version",
            Self::UnsupportedExtension(_) | Self::Instanced(_) => "unsupported_extension",
            Self::MissingResource(_) => "missing_resource",
            Self::IndexOutOfRange(_) => "index_out_of_range",
            Self::NonFinitePosition(_) => "non_finite_position",
            Self::LimitExceeded(_) => "limit_exceeded",
            Self::UnsupportedOutput(_) => "unsupported_output",
            Self::Indivisible(_) => "indivisible",
            Self::TexcoordInUse(_) => "texcoord_in_use",
            Self::InvalidUvs => "invalid_uvs",
        }
    }
}

impl From<crate::io::ReadError> for DocumentError {
    fn from(error: crate::io::ReadError) -> Self {
        use crate::io::ReadError;
        let text = error.to_string();
        match error {
            ReadError::Malformed { .. } => Self::InvalidMesh(text),
            ReadError::NonFinitePosition { .. } => Self::NonFinitePosition(text),
            ReadError::IndexOutOfRange { .. } => Self::IndexOutOfRange(text),
        }
    }
}

/// Returns a warning about vertices that no face uses with coordinates that are not finite, if there are any.
pub(super) fn unused_not_finite(n_vertices: usize) -> Option<Warning> {
    (n_vertices > 0).then(|| {
        Warning::new(
            "unused_not_finite",
            format!("{n_vertices} vertices that no face uses have coordinates that are not finite"),
        )
    })
}

/// Lists the first of many names, each shortened, for a message.
pub(super) fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    const SHOWN: usize = 6;
    let mut names = names.map(shortened);
    let shown: Vec<String> = names.by_ref().take(SHOWN).collect();
    let shown = shown.join(", ");
    match names.count() {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// Returns the beginning of a name from a file.
fn shortened(name: &str) -> String {
    name.chars().filter(|c| !c.is_control()).take(80).collect()
}

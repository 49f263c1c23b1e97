//! Errors of the pipeline.

use super::island_error::IslandError;
use unwrapd_deform::ProblemError;
use unwrapd_deform::cage::CageError;
use unwrapd_deform::outline::OutlineError;
use unwrapd_deform::uv::EditError;
use unwrapd_deform::warp::WarpError;
use unwrapd_files::document::DocumentError;
use unwrapd_files::io::ReadError;
use unwrapd_files::picture::ImageError;
use unwrapd_layout::atlas::{AtlasError, Enough};
use unwrapd_maps::mesh::{ElementError, MeshError};

/// Reason why a file could not be processed. Every variant has a stable [`code`](Self::code).
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PipelineError {
    /// An option is out of range.
    #[error("{0}")]
    InvalidOptions(String),
    /// The arrays do not form a mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The file cannot be read or written.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// There are more triangles than the limits allow.
    #[error("the mesh has {triangles} triangles; the limit is {limit}")]
    TooManyTriangles {
        /// Number of triangles.
        triangles: u64,
        /// Maximum number of triangles.
        limit: u64,
    },
    /// There is no face.
    #[error("the mesh has no triangles")]
    NoTriangles,
    /// No face has area.
    #[error(
        "none of the {triangles} triangles has an area: corners coincide or lie on a line; 32-bit coordinates far from \
         the origin may be too coarse to tell them apart"
    )]
    NoArea {
        /// Number of triangles.
        triangles: usize,
    },
    /// The requested UV set does not exist.
    #[error("{group} has no UV set {texcoord}")]
    NoUvs {
        /// Label of the group without UVs.
        group: String,
        /// Requested UV set.
        texcoord: u32,
    },
    /// Some parts of a group lack the requested UV set.
    #[error("{missing} of {triangles} triangles of {group} have no UV set {texcoord}")]
    PartlyNoUvs {
        /// Label of the group.
        group: String,
        /// Requested UV set.
        texcoord: u32,
        /// Number of triangles without it.
        missing: usize,
        /// Number of triangles of the group.
        triangles: usize,
    },
    /// No cage can be built around the surfaces.
    #[error(transparent)]
    Cage(#[from] CageError),
    /// The input cannot be deformed as requested.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// The charts do not fit on the grid.
    #[error(transparent)]
    Atlas(#[from] AtlasError),
    /// The charts do not fit at the requested texels per unit.
    #[error("the texture is too small for this texel density{0}")]
    TextureTooSmall(Enough),
    /// Islands cannot have their placements.
    #[error(transparent)]
    Islands(#[from] IslandError),
    /// Islands that share texels in the new UVs do not share them in the old ones.
    #[error(
        "stacked islands of {group} show different texels of {texture}: `stack` off separates them"
    )]
    StacksDiffer {
        /// Label of the group.
        group: String,
        /// Name of the new texture.
        texture: String,
    },
    /// The result has flips although none are allowed: a bug of this program, found by the certificate.
    #[error("nothing was written because the result is not valid: {0}")]
    NotValid(String),
    /// The UVs cannot be edited.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// The picture or drawing yields no mesh.
    #[error(transparent)]
    Outline(#[from] OutlineError),
    /// The picture cannot be warped.
    #[error(transparent)]
    Warp(#[from] WarpError),
    /// The map has an inverted element.
    #[error("no map without inversion was found")]
    Inverted,
    /// A boundary that must not cross itself does, because of rounding.
    #[error("no map was found whose boundary does not cross itself")]
    Crossed,
    /// No material has the name or index of a weight.
    #[error("unknown material {0:?}")]
    UnknownMaterial(String),
    /// The given seams do not match the mesh.
    #[error("seams: {0}")]
    Seams(String),
    /// The worker threads could not be started.
    #[error("cannot start worker threads: {0}")]
    Threads(String),
}

impl PipelineError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::InvalidOptions(_) => "invalid_options",
            Self::Mesh(MeshError::IndexOutOfRange { .. }) => "index_out_of_range",
            Self::Mesh(MeshError::NonFinitePosition { .. }) => "non_finite_position",
            Self::Mesh(MeshError::TooLarge) | Self::TooManyTriangles { .. } => "limit_exceeded",
            Self::Document(error) => error.code(),
            Self::Edit(error) => error.code(),
            Self::Outline(error) => error.code(),
            Self::Warp(error) => error.code(),
            Self::Seams(_) => "invalid_seams",
            Self::UnknownMaterial(_) => "unknown_material",
            Self::NoTriangles | Self::NoArea { .. } => "no_triangles",
            Self::NoUvs { .. } | Self::PartlyNoUvs { .. } => "no_uvs",
            Self::Cage(error) => error.code(),
            Self::Problem(error) => error.code(),
            Self::TextureTooSmall(_) => "texture_too_small",
            Self::StacksDiffer { .. } => "stacks_differ",
            Self::Islands(error) => error.code(),
            Self::Atlas(_) | Self::Inverted | Self::Crossed | Self::NotValid(_) => {
                "no_valid_result"
            }
            Self::Threads(_) => "internal_error",
        }
    }

    /// Returns the column of the error in a formula, from 1.
    pub fn column(&self) -> Option<usize> {
        match self {
            Self::Problem(error) => error.column(),
            _ => None,
        }
    }

    /// Returns the exit status of the command line: 2 usage, 3 unusable input, 4 no valid result, 6 ended
    /// early without a result, 1 anything else.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::InvalidOptions(_) => 2,
            Self::Problem(ProblemError::EndedEarly) => 6,
            Self::Mesh(_)
            | Self::TooManyTriangles { .. }
            | Self::NoTriangles
            | Self::NoArea { .. }
            | Self::TextureTooSmall(_)
            | Self::StacksDiffer { .. }
            | Self::Islands(_)
            | Self::Cage(_)
            | Self::Problem(_)
            | Self::Seams(_)
            | Self::UnknownMaterial(_)
            | Self::NoUvs { .. }
            | Self::PartlyNoUvs { .. }
            | Self::Document(_)
            | Self::Edit(_)
            | Self::Outline(_)
            | Self::Warp(_) => 3,
            Self::Atlas(_) | Self::Inverted | Self::Crossed | Self::NotValid(_) => 4,
            Self::Threads(_) => 1,
        }
    }
}

/// Converts the error of a mesh that cannot be deformed.
impl From<ElementError> for PipelineError {
    fn from(error: ElementError) -> Self {
        ProblemError::from(error).into()
    }
}

/// Converts the error of an element file that cannot be read.
impl From<ReadError> for PipelineError {
    fn from(error: ReadError) -> Self {
        ProblemError::from(error).into()
    }
}

/// Converts the error of a picture that cannot be read.
impl From<ImageError> for PipelineError {
    fn from(error: ImageError) -> Self {
        WarpError::from(error).into()
    }
}

use unwrapd_files::picture::ImageError;

/// Reason why a picture or drawing gives no mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OutlineError {
    /// The picture cannot be decoded.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The picture has no pixel that is opaque enough, or the drawing no filled shape.
    #[error("there is nothing to outline")]
    Empty,
    /// The drawing is not SVG that can be read.
    #[error("invalid SVG: {0}")]
    InvalidSvg(String),
    /// A filled path has a part that does not return to its start.
    #[error("path {path} of the drawing is open")]
    OpenPath {
        /// Number of the shape, from 1 in the order of the document.
        path: usize,
    },
    /// Two boundary lines cross or touch.
    #[error("the outline crosses or touches itself near ({}, {})", at[0], at[1])]
    SelfIntersecting {
        /// A vertex of one of them.
        at: [f64; 2],
    },
    /// There are too many boundary vertices or pieces.
    #[error("the outline has too many vertices, pieces or holes")]
    TooDetailed,
    /// The requested resolution needs too many triangles, or cannot be reached.
    #[error("the mesh would have more than {0} triangles")]
    TooManyTriangles(usize),
    /// A number that must be positive is not.
    #[error("{0} must be a positive number")]
    InvalidSetting(&'static str),
    /// Triangles became flat by rounding: details too small for their distance from the origin.
    #[error("the details of the outline are too small for its coordinates")]
    TooFine,
}

impl OutlineError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Image(error) => error.code(),
            Self::Empty => "empty_outline",
            Self::InvalidSvg(_) => "invalid_svg",
            Self::OpenPath { .. } => "open_path",
            Self::SelfIntersecting { .. } => "self_intersecting_outline",
            Self::TooDetailed => "outline_too_detailed",
            Self::TooManyTriangles(_) => "too_many_triangles",
            Self::InvalidSetting(_) => "invalid_setting",
            Self::TooFine => "outline_too_fine",
        }
    }
}

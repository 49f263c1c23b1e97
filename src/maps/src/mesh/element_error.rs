//! Errors of rest shapes.

/// Reason why triangles or tetrahedra cannot be deformed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ElementError {
    /// There is nothing to deform.
    #[error("the mesh has no {0}")]
    Empty(&'static str),
    /// More elements or vertices than 32-bit indices can count.
    #[error("too many elements or vertices for 32-bit indices")]
    TooLarge,
    /// An element names a vertex that does not exist.
    #[error("element {element} names vertex {vertex}, but there are only {n_vertices} vertices")]
    IndexOutOfRange {
        /// First such element, from 0.
        element: usize,
        /// Vertex that it names.
        vertex: u32,
        /// Number of vertices.
        n_vertices: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NonFinitePosition {
        /// First such vertex, from 0.
        vertex: usize,
    },
    /// The area or volume is exactly zero.
    #[error("element {element} has zero area or volume")]
    ZeroSize {
        /// First such element, from 0.
        element: usize,
    },
    /// Two elements lie on the same side of a common edge or face.
    #[error(
        "the mesh is folded: elements {elements:?} lie on the same side of their common face or edge"
    )]
    Folded {
        /// Indices of the two elements, from 0.
        elements: [usize; 2],
    },
    /// A mesh of the plane is not flat.
    #[error(
        "the mesh has no tetrahedra and is not planar: vertex {vertex} has z = {z}, the first one {plane}"
    )]
    NotPlanar {
        /// First such vertex, from 0.
        vertex: usize,
        /// Its z coordinate.
        z: f64,
        /// z coordinate of the first vertex.
        plane: f64,
    },
}

impl ElementError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Empty(_) => "no_elements",
            Self::TooLarge => "limit_exceeded",
            Self::IndexOutOfRange { .. } => "index_out_of_range",
            Self::NonFinitePosition { .. } => "non_finite_position",
            Self::ZeroSize { .. } => "zero_size_element",
            Self::Folded { .. } => "folded_mesh",
            Self::NotPlanar { .. } => "not_planar",
        }
    }
}

/// Checks the common requirements of triangles of the plane and tetrahedra: there are elements, and their vertices
/// exist and are finite.
pub fn validate<const D: usize, const N: usize>(
    vertices: &[[f64; D]],
    elements: &[[u32; N]],
    noun: &'static str,
) -> Result<(), ElementError> {
    if elements.is_empty() {
        return Err(ElementError::Empty(noun));
    }
    if vertices.len().max(N * elements.len()) >= u32::MAX as usize {
        return Err(ElementError::TooLarge);
    }
    let infinite = |p: &[f64; D]| p.iter().any(|x| !x.is_finite());
    if let Some(vertex) = vertices.iter().position(infinite) {
        return Err(ElementError::NonFinitePosition { vertex });
    }
    for (element, corners) in elements.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices.len()) {
            return Err(ElementError::IndexOutOfRange {
                element,
                vertex,
                n_vertices: vertices.len(),
            });
        }
    }
    Ok(())
}

//! Errors of problems.

use unwrapd_files::io::ReadError;
use unwrapd_maps::mesh::ElementError;
use unwrapd_method::energy::FormulaError;
use unwrapd_method::solver::HandlesError;

/// Reason why a problem cannot be solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProblemError {
    /// The file is not a problem.
    #[error("the problem file cannot be parsed: {0}")]
    Malformed(String),
    /// The file is not a list of handles.
    #[error("the handles cannot be parsed: {0}")]
    MalformedHandles(String),
    /// The mesh cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The mesh cannot be deformed.
    #[error(transparent)]
    Element(#[from] ElementError),
    /// A handle names a vertex that does not exist.
    #[error("handle {handle} names vertex {vertex}, but there are only {n_vertices} vertices")]
    UnknownHandle {
        /// Index of the handle.
        handle: usize,
        /// Vertex that it names.
        vertex: u32,
        /// Number of vertices of the body.
        n_vertices: usize,
    },
    /// A session has no such handle, or no longer.
    #[error("handle {handle} was removed, or never added")]
    RemovedHandle {
        /// Number of the handle, from 0 in the order of adding.
        handle: u32,
    },
    /// The handles of a problem do not fit each other or the body.
    #[error(transparent)]
    Handles(#[from] HandlesError),
    /// There is no handle to pull.
    #[error("there is no handle")]
    NoHandle,
    /// A handle names a place outside the body.
    #[error("handle {handle} lies outside the mesh")]
    HandleOutside {
        /// Index of the handle.
        handle: usize,
    },
    /// A handle names a vertex, but users do not know the vertices of a cage.
    #[error("handle {handle} names a vertex; in a cage, handles must be places: `at` or `center`")]
    VertexOfCage {
        /// Index of the handle.
        handle: usize,
    },
    /// A target is not a position.
    #[error("the target of handle {handle} must be {dim} finite numbers")]
    BadTarget {
        /// Index of the handle.
        handle: usize,
        /// Coordinates per position.
        dim: usize,
    },
    /// Handles and targets do not pair up.
    #[error("there are {handles} handles but {targets} targets")]
    Unpaired {
        /// Number of handles.
        handles: usize,
        /// Number of targets.
        targets: usize,
    },
    /// One vertex has two different targets.
    #[error("vertex {vertex} has two handles with different targets")]
    ContradictoryHandles {
        /// Index of the vertex.
        vertex: u32,
    },
    /// One point of an element has two different targets.
    #[error("a point has two handles with different targets")]
    ContradictoryPoints,
    /// The start has an element at or below ε and cannot be untangled.
    #[error(
        "element {element} of the start has determinant {determinant:e}, not above epsilon {epsilon:e}, and untangling failed"
    )]
    InfeasibleStart {
        /// Index of the element.
        element: usize,
        /// Twice its area or six times its volume.
        determinant: f64,
        /// ε.
        epsilon: f64,
    },
    /// The work was ended before all elements were positive.
    #[error("the work ended early, before a mesh without inversions was found")]
    EndedEarly,
    /// Neighboring elements cannot be wound alike.
    #[error(
        "elements {elements:?} cannot be wound alike: three meet there, or the mesh has one side only"
    )]
    NotOrientable {
        /// Indices of two neighbors.
        elements: [usize; 2],
    },
    /// The mesh of the rest shapes is folded itself.
    #[error("element {element} of the rest mesh is inverted or empty")]
    InvertedRest {
        /// Index of the element.
        element: usize,
    },
    /// The mesh of the rest shapes does not match the mesh.
    #[error("the rest mesh has {found} vertices, but the mesh has {expected}")]
    WrongRest {
        /// Number of vertices found.
        found: usize,
        /// Number of vertices expected.
        expected: usize,
    },
    /// The targets of an element's held corners leave it inverted or empty.
    #[error("the targets of its held corners leave element {element} inverted or empty")]
    HeldElement {
        /// Index of the element.
        element: usize,
    },
    /// The targets of a held boundary enclose no positive signed size.
    #[error(
        "the targets of the boundary enclose a signed size of {size:e}, but a map without inversions needs a positive one"
    )]
    BoundarySize {
        /// The signed area or volume within the boundary.
        size: f64,
    },
    /// The targets of a held border turn too little.
    #[error(
        "the targets of the boundary make {turns} turns, but a map without inversions needs at least {needed}"
    )]
    BoundaryTurning {
        /// Full turns of the border to the left.
        turns: i64,
        /// The Euler characteristic of the part within.
        needed: i64,
    },
    /// A number is not in its range.
    #[error("`{name}` must be {range}")]
    BadParameter {
        /// Name of the number.
        name: &'static str,
        /// Its range.
        range: &'static str,
    },
    /// The energy is neither the name of an energy nor a formula of one in the body's dimension.
    #[error("`energy` is neither the name of an energy nor the formula of one: {0}")]
    Formula(#[from] FormulaError),
    /// The energy is not defined for the body.
    #[error("this energy exists only in the plane")]
    PlanarEnergy,
    /// Only maps of the plane can be kept bijective.
    #[error("`bijective` applies only to maps of the plane")]
    PlanarBijectivity,
    /// The map is to be kept bijective, but the start overlaps itself.
    #[error("the start overlaps or touches itself, so no map from it can stay bijective")]
    OverlappingStart,
    /// The present map has no finite energy under another model.
    #[error("the present map is outside the domain of this energy, barrier or bound")]
    OutsideDomain,
    /// The start does not match the mesh.
    #[error("the start has {found} coordinates, but the mesh has {expected}")]
    WrongStart {
        /// Number of coordinates found.
        found: usize,
        /// Number of coordinates expected.
        expected: usize,
    },
}

impl ProblemError {
    /// Returns the column of the error in a formula, from 1.
    pub fn column(&self) -> Option<usize> {
        match self {
            Self::Formula(error) => error.column(),
            _ => None,
        }
    }

    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Malformed(_) => "malformed_problem",
            Self::MalformedHandles(_) => "malformed_handles",
            Self::Read(error) => error.code(),
            Self::Element(error) => error.code(),
            Self::UnknownHandle { .. } | Self::RemovedHandle { .. } => "unknown_handle",
            Self::Handles(error) => error.code(),
            Self::NoHandle => "no_handle",
            Self::HandleOutside { .. } => "handle_outside",
            Self::VertexOfCage { .. } => "vertex_of_cage",
            Self::BadTarget { .. } => "bad_target",
            Self::Unpaired { .. } => "unpaired_handles",
            Self::ContradictoryHandles { .. } | Self::ContradictoryPoints => {
                "contradictory_handles"
            }
            Self::InfeasibleStart { .. } => "infeasible_start",
            Self::EndedEarly => "ended_early",
            Self::NotOrientable { .. } => "not_orientable",
            Self::InvertedRest { .. } => "folded_mesh",
            Self::HeldElement { .. } => "held_element_inverted",
            Self::BoundarySize { .. } => "boundary_inverted",
            Self::BoundaryTurning { .. } => "boundary_turns_too_little",
            Self::BadParameter { .. } => "bad_parameter",
            Self::Formula(_) => "invalid_formula",
            Self::PlanarEnergy => "planar_energy",
            Self::PlanarBijectivity => "planar_bijectivity",
            Self::OverlappingStart => "overlapping_start",
            Self::OutsideDomain => "outside_domain",
            Self::WrongStart { .. } | Self::WrongRest { .. } => "wrong_start",
        }
    }
}

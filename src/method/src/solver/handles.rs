//! Handles: vertices and points that are pulled, and their targets.

use std::borrow::Cow;
use std::collections::HashSet;

use crate::energy::Row;

/// Vertices that must come to given positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Handles {
    /// The vertices, each once.
    pub vertices: Vec<u32>,
    /// Targets of the vertices, coordinates one after another.
    pub targets: Vec<f64>,
    /// The number of the group of each vertex. A group, such as a disc of vertices or the end of a bar, moves as a
    /// rigid body as far as its targets allow, so that no element between its vertices is crushed along the path.
    /// Without groups, each vertex moves alone.
    pub groups: Vec<u32>,
    /// Points inside elements that are pulled to given positions too, by soft constraints that harden at the end.
    pub points: Vec<Row>,
    /// Targets of the points, coordinates one after another.
    pub point_targets: Vec<f64>,
    /// Bend of each path: first those of the groups, by number, then those of the points; empty if all paths are
    /// straight. A bend is a direction (in the plane its first two numbers); its length is the sagitta in halves of the
    /// length of the path. Two handles that change places pass each other if both bend to their left.
    pub bends: Vec<[f64; 3]>,
}

/// Mismatch among the handles, or between the handles and the map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HandlesError {
    /// The number of target coordinates is not `dim` per handle.
    #[error("{handles} handles have {found} coordinates of targets, not {dim} each")]
    Targets {
        /// Number of vertices or points that are pulled.
        handles: usize,
        /// Number of target coordinates.
        found: usize,
        /// Coordinates per position.
        dim: usize,
    },
    /// The number of groups is not that of the vertices.
    #[error("{vertices} vertices have {groups} groups")]
    Groups {
        /// Number of vertices.
        vertices: usize,
        /// Number of groups.
        groups: usize,
    },
    /// The number of bends is not that of the paths.
    #[error("{ways} ways have {bends} bends")]
    Bends {
        /// Number of paths: groups and points.
        ways: usize,
        /// Number of bends.
        bends: usize,
    },
    /// A handle names a vertex that does not exist.
    #[error("a handle names vertex {vertex}, but there are only {n_vertices} vertices")]
    UnknownVertex {
        /// Index of the vertex.
        vertex: u32,
        /// Number of vertices of the map.
        n_vertices: usize,
    },
    /// Two handles name the same vertex.
    #[error("vertex {vertex} has two handles")]
    Twice {
        /// Index of the vertex.
        vertex: u32,
    },
    /// The number of points differs from the number of soft constraints of the objective.
    #[error("{points} points are pulled, but the objective has {constraints} soft constraints")]
    Points {
        /// Number of points.
        points: usize,
        /// Number of constraints.
        constraints: usize,
    },
    /// A target or a bend is infinite or not a number.
    #[error("a target or a bend is not finite")]
    NotFinite,
    /// A target is so far away that squares of distances would overflow.
    #[error("a target has a coordinate larger than {LARGEST:e}")]
    TooFar,
}

/// Largest coordinate of a target: squares of distances stay finite.
const LARGEST: f64 = 1e150;

impl HandlesError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Targets { .. }
            | Self::Groups { .. }
            | Self::Bends { .. }
            | Self::Points { .. } => "unpaired_handles",
            Self::UnknownVertex { .. } => "unknown_handle",
            Self::Twice { .. } => "contradictory_handles",
            Self::NotFinite | Self::TooFar => "bad_target",
        }
    }
}

impl Handles {
    /// Checks that the handles fit each other and a map of `n_coordinates` coordinates, `dim` per vertex.
    ///
    /// # Errors
    /// The first mismatch found.
    pub fn check(&self, dim: usize, n_coordinates: usize) -> Result<(), HandlesError> {
        // Numbers of coordinates, groups and bends.
        let pairs = [
            (self.vertices.len(), self.targets.len()),
            (self.points.len(), self.point_targets.len()),
        ];
        for (handles, found) in pairs {
            if found != dim * handles {
                return Err(HandlesError::Targets {
                    handles,
                    found,
                    dim,
                });
            }
        }
        let (vertices, groups) = (self.vertices.len(), self.groups.len());
        if groups != 0 && groups != vertices {
            return Err(HandlesError::Groups { vertices, groups });
        }
        let (ways, bends) = (self.n_ways(), self.bends.len());
        if bends != 0 && bends != ways {
            return Err(HandlesError::Bends { ways, bends });
        }
        // Vertices.
        let n_vertices = n_coordinates / dim;
        let of_points = self.points.iter().flatten().map(|(vertex, _)| vertex);
        let mut named = self.vertices.iter().chain(of_points);
        if let Some(&vertex) = named.find(|&&vertex| n_vertices <= vertex as usize) {
            return Err(HandlesError::UnknownVertex { vertex, n_vertices });
        }
        let mut seen = HashSet::new();
        if let Some(&vertex) = self.vertices.iter().find(|&vertex| !seen.insert(vertex)) {
            return Err(HandlesError::Twice { vertex });
        }
        // Values.
        let targets = self.targets.iter().chain(&self.point_targets);
        let mut numbers = targets.chain(self.bends.as_flattened());
        if !numbers.all(|x| x.is_finite()) {
            return Err(HandlesError::NotFinite);
        }
        let mut targets = self.targets.iter().chain(&self.point_targets);
        if targets.any(|x| x.abs() > LARGEST) {
            return Err(HandlesError::TooFar);
        }
        Ok(())
    }

    /// Returns the number of groups: the largest group number plus one.
    pub fn n_groups(&self) -> usize {
        let groups = self.groups();
        groups.iter().max().map_or(0, |&group| group as usize + 1)
    }

    /// Returns the number of paths: one per group and one per point.
    pub fn n_ways(&self) -> usize {
        self.n_groups() + self.points.len()
    }

    /// Returns the group of each vertex; without groups, each vertex has its own.
    pub fn groups(&self) -> Cow<'_, [u32]> {
        if self.groups.is_empty() {
            (0..self.vertices.len() as u32).collect()
        } else {
            Cow::Borrowed(&self.groups)
        }
    }
}

//! What is pulled, and to where.

use std::borrow::Cow;
use std::collections::HashSet;

use crate::energy::Row;

/// Vertices that must come to given positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Handles {
    /// The vertices, each once.
    pub vertices: Vec<u32>,
    /// Their targets, coordinates one after another.
    pub targets: Vec<f64>,
    /// The number of the group of each vertex. A group, such as a disc of vertices or the end of a bar,
    /// travels as a rigid body as far as its targets allow. No element between its vertices is then
    /// crushed on the way. Without groups, each vertex travels alone.
    pub groups: Vec<u32>,
    /// Points inside elements that must come to given positions too: held by soft constraints that harden in the end.
    pub points: Vec<Row>,
    /// Their targets, coordinates one after another.
    pub point_targets: Vec<f64>,
    /// How each way bends, that of every group by its number and then that of every point; all are straight if there are none. A
    /// bend is a direction, in the plane the first two numbers, as long as the way is bent in halves of its length. Two that change
    /// places pass each other if both bend to their left.
    pub bends: Vec<[f64; 3]>,
}

/// Handles that do not fit each other or the map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HandlesError {
    /// Not every handle has one target of as many coordinates as the map.
    #[error("{handles} handles have {found} coordinates of targets, not {dim} each")]
    Targets {
        /// How many vertices or points are pulled.
        handles: usize,
        /// Numbers found.
        found: usize,
        /// Coordinates of a position.
        dim: usize,
    },
    /// Not every handle has a group.
    #[error("{vertices} vertices have {groups} groups")]
    Groups {
        /// How many vertices.
        vertices: usize,
        /// How many groups.
        groups: usize,
    },
    /// Not every way has a bend.
    #[error("{ways} ways have {bends} bends")]
    Bends {
        /// How many groups and points.
        ways: usize,
        /// How many bends.
        bends: usize,
    },
    /// A handle names a vertex that there is not.
    #[error("a handle names vertex {vertex}, but there are only {n_vertices} vertices")]
    UnknownVertex {
        /// The vertex.
        vertex: u32,
        /// How many there are.
        n_vertices: usize,
    },
    /// Two handles name one vertex.
    #[error("vertex {vertex} has two handles")]
    Twice {
        /// The vertex.
        vertex: u32,
    },
    /// The objective has not as many soft constraints as there are points.
    #[error("{points} points are pulled, but the objective has {constraints} soft constraints")]
    Points {
        /// How many points.
        points: usize,
        /// How many constraints.
        constraints: usize,
    },
    /// A target or a bend is infinite or not a number.
    #[error("a target or a bend is not finite")]
    NotFinite,
    /// A target is so far that its distance is no number.
    #[error("a target has a coordinate larger than {LARGEST:e}")]
    TooFar,
}

/// The largest coordinate of a target: squares of distances stay finite.
const LARGEST: f64 = 1e150;

impl HandlesError {
    /// A word for programs; it does not change.
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
    /// Checks that they fit each other and a map of so many coordinates, `dim` to a vertex.
    ///
    /// # Errors
    /// The first misfit that is found.
    pub fn check(&self, dim: usize, n_coordinates: usize) -> Result<(), HandlesError> {
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

    /// How many groups there are, the largest number among theirs and one.
    pub fn n_groups(&self) -> usize {
        let groups = self.groups();
        groups.iter().max().map_or(0, |&group| group as usize + 1)
    }

    /// How many ways: one of each group, one of each point.
    pub fn n_ways(&self) -> usize {
        self.n_groups() + self.points.len()
    }

    /// The group of each vertex.
    pub fn groups(&self) -> Cow<'_, [u32]> {
        if self.groups.is_empty() {
            (0..self.vertices.len() as u32).collect()
        } else {
            Cow::Borrowed(&self.groups)
        }
    }
}

//! Handles: vertices and points that are pulled, and their targets.

use crate::energy::Row;
pub use crate::numerics::rotation::Rotation;
use crate::numerics::rotation::{best_rotation, centroids};
use crate::numerics::square::{Matrix, Square, apply};
use std::borrow::Cow;
use std::collections::HashSet;

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
#[non_exhaustive]
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

    /// Returns the handles without the vertices that are not `kept`, for `dim` coordinates per position; all paths
    /// are straight.
    #[must_use]
    pub fn kept(&self, dim: usize, is_kept: impl Fn(&u32) -> bool) -> Self {
        let groups = self.groups();
        let kept = (0..self.vertices.len()).filter(|&i| is_kept(&self.vertices[i]));
        let kept: Vec<usize> = kept.collect();
        Self {
            vertices: kept.iter().map(|&i| self.vertices[i]).collect(),
            targets: (kept
                .iter()
                .flat_map(|&i| &self.targets[dim * i..dim * (i + 1)]))
            .copied()
            .collect(),
            groups: kept.iter().map(|&i| groups[i]).collect(),
            bends: Vec::new(),
            ..self.clone()
        }
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

// Paths of handles to their targets.

/// Path of handles from their positions to their targets, as a function of s from 0 to 1.
///
/// A group turns by the rotation that best takes it to its targets, at constant speed about its centroid, which moves
/// on a straight or bent line. The remainder, if the targets are not a rigid copy, is added in proportion to s.
pub struct Path<const D: usize> {
    groups: Vec<RigidMotion<D>>,
    /// For each handle its group, its position relative to the centroid, and the part of its path that the rigid motion
    /// leaves.
    handles: Vec<(usize, [f64; D], [f64; D])>,
}

struct RigidMotion<const D: usize> {
    from: [f64; D],
    to: [f64; D],
    bend: [f64; 3],
    /// Logarithm of the rotation, which is exp(s·log) at s.
    log: Matrix<D>,
}

impl<const D: usize> Path<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// Creates the paths from the positions in `x`.
    ///
    /// # Errors
    /// If the handles do not fit each other or `x`.
    pub fn new(handles: &Handles, x: &[f64]) -> Result<Self, HandlesError> {
        handles.check(D, x.len())?;
        let groups = handles.groups();
        let n_groups = handles.n_groups();
        let at = |v: u32| -> [f64; D] { std::array::from_fn(|k| x[D * v as usize + k]) };
        let target = |i: usize| -> [f64; D] { std::array::from_fn(|k| handles.targets[D * i + k]) };
        let mut members = vec![Vec::new(); n_groups];
        for (i, (&v, &g)) in handles.vertices.iter().zip(&*groups).enumerate() {
            members[g as usize].push((at(v), target(i)));
        }
        let bend = |group: usize| handles.bends.get(group).copied().unwrap_or_default();
        let motions: Vec<_> = (members.iter().enumerate())
            .map(|(group, members)| RigidMotion::fit(members, bend(group)))
            .collect();
        let placed = handles.vertices.iter().zip(&*groups).enumerate();
        let handles = placed.map(|(i, (&v, &g))| {
            let motion = &motions[g as usize];
            let arm = difference(at(v), motion.from);
            let rest = difference(target(i), motion.place(arm, 1.0));
            (g as usize, arm, rest)
        });
        Ok(Self {
            handles: handles.collect(),
            groups: motions,
        })
    }

    /// Returns the position of handle `i` at `s`.
    pub fn position(&self, i: usize, s: f64) -> [f64; D] {
        let (group, arm, rest) = self.handles[i];
        let place = self.groups[group].place(arm, s);
        std::array::from_fn(|k| place[k] + s * rest[k])
    }
}

impl<const D: usize> RigidMotion<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    fn fit(members: &[([f64; D], [f64; D])], bend: [f64; 3]) -> Self {
        let (from, to) = centroids(members);
        let rotation = best_rotation(members);
        let log = rotation.map_or([[0.0; D]; D], |rotation| rotation.log());
        Self {
            from,
            to,
            bend,
            log,
        }
    }

    fn place(&self, arm: [f64; D], s: f64) -> [f64; D] {
        let turned = apply(&Matrix::<D>::exp(&self.log, s), &arm);
        let aside = aside(difference(self.to, self.from), self.bend, s);
        std::array::from_fn(|k| (1.0 - s) * self.from[k] + s * self.to[k] + turned[k] + aside[k])
    }
}

/// Returns the offset at `s` of a path with this bend, see [`Handles::bends`], from a straight one.
pub(super) fn aside<const D: usize>(way: [f64; D], bend: [f64; 3], s: f64) -> [f64; D] {
    let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
    std::array::from_fn(|k| 2.0 * s * (1.0 - s) * length * bend[k])
}

fn difference<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] - b[k])
}

//! What a problem file is pulled by, in either of two forms.

use serde::Deserialize;

use super::aims::Aim;
use super::body::Body;
use super::handles::{Bound, Handle, bind};
use super::paired::handles;
use super::problem_error::ProblemError;
use super::problem_file::ProblemFile;
use crate::solver::Handles;

/// The handles of a problem file.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(untagged)]
pub enum ProblemHandles {
    /// Vertex ids, whose targets are in `targets`: the authors' own form.
    Vertices(Vec<u32>),
    /// Handles with their targets, in the form of all other kinds of jobs.
    Handles(Vec<Handle>),
}

impl ProblemFile {
    /// Checks that targets are given once.
    pub(super) fn check_targets(&self) -> Result<(), ProblemError> {
        let malformed = |text: &str| Err(ProblemError::Malformed(text.to_owned()));
        match &self.handles {
            ProblemHandles::Vertices(vertices) if vertices.is_empty() => Ok(()),
            ProblemHandles::Vertices(_) if self.targets.is_empty() => {
                malformed("missing field `targets`")
            }
            ProblemHandles::Handles(_) if !(self.targets.is_empty() && self.sequence.is_empty()) => {
                malformed("handles with `to` have no `targets` and no `sequence`")
            }
            _ => Ok(()),
        }
    }

    /// The handles, which have found what they pull, and their stations.
    pub(super) fn bound(&self, body: &Body) -> Result<Bound, ProblemError> {
        match &self.handles {
            ProblemHandles::Vertices(vertices) => Ok(Bound {
                stations: self.stations(vertices, body)?,
                aims: vertices.iter().map(|&v| Aim::at_vertex(v)).collect(),
                turns: Vec::new(),
            }),
            ProblemHandles::Handles(handles) => bind(body, handles),
        }
    }

    fn stations(&self, vertices: &[u32], body: &Body) -> Result<Vec<Handles>, ProblemError> {
        check_vertices(vertices, body.n_vertices())?;
        let groups = body.groups(vertices);
        let last = std::iter::once(&self.targets);
        let sets = self
            .sequence
            .iter()
            .filter(|&set| *set != self.targets)
            .chain(last);
        sets.map(|targets| handles(body.dim(), vertices, targets, &groups))
            .collect()
    }
}

fn check_vertices(vertices: &[u32], n_vertices: usize) -> Result<(), ProblemError> {
    let outside = |&v: &u32| v as usize >= n_vertices;
    match vertices.iter().position(outside) {
        Some(handle) => Err(ProblemError::UnknownHandle {
            handle,
            vertex: vertices[handle],
            n_vertices,
        }),
        None => Ok(()),
    }
}

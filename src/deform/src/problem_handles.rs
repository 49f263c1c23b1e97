//! Handles of a problem file, in either of two forms.

use serde::Deserialize;

use super::aims::Aim;
use super::body::Body;
use super::handles::{Bound, Handle, bind};
use super::paired::handles;
use super::problem_error::ProblemError;

/// The handles of a problem file.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(untagged)]
pub enum ProblemHandles {
    /// Vertex ids, whose targets are in `targets`: the authors' own form.
    Vertices(Vec<u32>),
    /// Handles with their targets, in the form of all other kinds of jobs.
    Handles(Vec<Handle>),
}

/// One target position per vertex.
pub(super) type Targets = Vec<Vec<f64>>;

impl ProblemHandles {
    /// Checks that targets are given exactly once.
    pub(super) fn check(
        &self,
        targets: &Targets,
        sequence: &[Targets],
    ) -> Result<(), ProblemError> {
        let malformed = |text: &str| Err(ProblemError::Malformed(text.to_owned()));
        match self {
            Self::Vertices(vertices) if !vertices.is_empty() && targets.is_empty() => {
                malformed("missing field `targets`")
            }
            Self::Handles(_) if !(targets.is_empty() && sequence.is_empty()) => {
                malformed("handles with `to` have no `targets` and no `sequence`")
            }
            _ => Ok(()),
        }
    }

    /// Binds the handles to the body and returns their stations: sets of targets through which vertices pass one after
    /// another, the last of them the final ones.
    pub(super) fn bound(
        &self,
        body: &Body,
        targets: &Targets,
        sequence: &[Targets],
    ) -> Result<Bound, ProblemError> {
        let vertices = match self {
            Self::Vertices(vertices) => vertices,
            Self::Handles(handles) => return bind(body, handles),
        };
        check_vertices(vertices, body.n_vertices())?;
        let groups = body.groups(vertices);
        let before = sequence.iter().filter(|&set| set != targets);
        let stations = before.chain([targets]);
        let stations = stations.map(|set| handles(body.dim(), vertices, set, &groups));
        Ok(Bound {
            stations: stations.collect::<Result<_, _>>()?,
            aims: vertices.iter().map(|&v| Aim::at_vertex(v)).collect(),
            turns: Vec::new(),
        })
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

//! Problem files: a mesh, handles and their targets, an energy and a barrier.

use serde::Deserialize;

use super::body::Body;
use super::model::DeformationEnergy;
use super::problem_error::ProblemError;
use crate::barrier::{Barrier, BarrierKind};
use crate::mesh::ElementError;
use crate::mesh::io::Elements;
use crate::solver::{Handles, LevenbergSettings};

/// A problem as its file says it; every path is relative to the file.
#[derive(Clone, Debug, Deserialize)]
pub struct ProblemFile {
    /// The mesh.
    pub mesh: String,
    /// Start positions, one vertex per line; the rest positions if absent.
    pub initial: Option<String>,
    /// Where rest shapes come from.
    #[serde(default)]
    pub rest: Rest,
    /// Vertex ids.
    pub handles: Vec<u32>,
    /// Where they should come, one position each.
    pub targets: Vec<Vec<f64>>,
    /// Target sets to go through one after another, the last of them [`targets`](Self::targets).
    #[serde(default)]
    pub sequence: Vec<Vec<Vec<f64>>>,
    /// The energy.
    pub energy: DeformationEnergy,
    /// The barrier.
    pub barrier: BarrierKind,
    /// β; the paper's for the energy if absent.
    pub beta: Option<f64>,
    /// s.
    #[serde(default = "one")]
    pub gamma: f64,
    /// ε; 1e-4 of the smallest rest determinant if absent.
    pub eps: Option<f64>,
    /// Of `levenberg` only: do the targets retreat while the shift is large?
    pub substepping: Option<bool>,
    /// Of `levenberg` only: does α grow?
    pub alpha_update: Option<bool>,
    /// Of `levenberg` only: α at the start.
    pub alpha0: Option<f64>,
    /// Of `levenberg` only: r.
    pub alpha_ratio: Option<f64>,
    /// Of `levenberg` only: steps at most.
    pub max_iter: Option<usize>,
    /// Of `levenberg` only: ends when a step is shorter.
    pub min_step: Option<f64>,
    /// Of `levenberg` only: the largest ‖Cx − d‖² that counts as met.
    pub tol: Option<f64>,
}

fn one() -> f64 {
    1.0
}

/// What an element is without distortion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rest {
    /// Its x, y or x, y, z.
    #[default]
    Same,
    /// A triangle of space, laid flat.
    Corotated,
}

/// A problem with its mesh, checked.
#[derive(Clone, Debug)]
pub struct Problem {
    /// What is deformed.
    pub body: Body,
    /// Start positions, coordinates one after another.
    pub start: Vec<f64>,
    /// The energy.
    pub energy: DeformationEnergy,
    /// The barrier.
    pub barrier: Barrier,
    /// The stations of the handles, the last of them their targets.
    pub stations: Vec<Handles>,
    /// What `levenberg` is told.
    pub levenberg: LevenbergSettings,
}

impl Problem {
    /// Does the energy or the barrier keep every element from inverting?
    pub fn forbids_inversion(&self) -> bool {
        let terms = self
            .energy
            .terms(&self.body, self.barrier)
            .unwrap_or_default();
        terms.iter().any(|term| term.forbids_flips())
    }
}

impl ProblemFile {
    /// Parses JSON.
    pub fn parse(json: &[u8]) -> Result<Self, ProblemError> {
        serde_json::from_slice(json).map_err(|error| ProblemError::Malformed(error.to_string()))
    }

    /// The problem on this mesh, starting from these positions or from rest.
    pub fn with(self, mesh: Elements, start: Option<Vec<f64>>) -> Result<Problem, ProblemError> {
        let body = if !mesh.tets.is_empty() {
            Body::from(&mesh.into_tet_mesh()?)
        } else if self.rest == Rest::Corotated {
            Body::flattened(&mesh.vertices, &mesh.triangles)
                .map_err(|element| ElementError::ZeroSize { element })?
        } else {
            Body::from(&mesh.into_planar_mesh()?)
        };
        let start = start.unwrap_or_else(|| body.rest.clone());
        if start.len() != body.rest.len() {
            return Err(ProblemError::WrongStart {
                found: start.len(),
                expected: body.rest.len(),
            });
        }
        let barrier = self.barrier(&body)?;
        check_start(&body, &start, &barrier)?;
        Ok(Problem {
            stations: self.stations(&body)?,
            levenberg: self.levenberg(),
            body,
            start,
            energy: self.energy,
            barrier,
        })
    }

    fn barrier(&self, body: &Body) -> Result<Barrier, ProblemError> {
        let smallest = body
            .determinants()
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        let barrier = Barrier {
            kind: self.barrier,
            beta: self.beta.unwrap_or(self.energy.default_beta()),
            s: self.gamma,
            epsilon: self.eps.unwrap_or(1e-4 * smallest),
        };
        for (name, value) in [("beta", barrier.beta), ("gamma", barrier.s)] {
            if !(value > 0.0 && value.is_finite()) {
                let range = "a positive number";
                return Err(ProblemError::BadParameter { name, range });
            }
        }
        if !(barrier.epsilon >= 0.0 && barrier.epsilon < smallest) {
            return Err(ProblemError::BadParameter {
                name: "eps",
                range: "at least 0 and below the smallest rest determinant",
            });
        }
        Ok(barrier)
    }

    fn levenberg(&self) -> LevenbergSettings {
        let default = LevenbergSettings::default();
        LevenbergSettings {
            max_iterations: self.max_iter.unwrap_or(default.max_iterations),
            min_step: self.min_step.unwrap_or(default.min_step),
            tolerance: self.tol.unwrap_or(default.tolerance),
            substepping: self.substepping.unwrap_or(default.substepping),
            alpha_update: self.alpha_update.unwrap_or(default.alpha_update),
            alpha: self.alpha0.unwrap_or(default.alpha),
            alpha_ratio: self.alpha_ratio.unwrap_or(default.alpha_ratio),
        }
    }

    fn stations(&self, body: &Body) -> Result<Vec<Handles>, ProblemError> {
        let groups = body.groups(&self.handles_checked(body)?);
        let last = std::iter::once(&self.targets);
        let sets = self
            .sequence
            .iter()
            .filter(|&set| *set != self.targets)
            .chain(last);
        sets.map(|targets| handles(body.dim(), &self.handles, targets, &groups))
            .collect()
    }

    fn handles_checked(&self, body: &Body) -> Result<Vec<u32>, ProblemError> {
        let n_vertices = body.n_vertices();
        let outside = |&v: &u32| v as usize >= n_vertices;
        if let Some(handle) = self.handles.iter().position(outside) {
            let vertex = self.handles[handle];
            return Err(ProblemError::UnknownHandle {
                handle,
                vertex,
                n_vertices,
            });
        }
        Ok(self.handles.clone())
    }
}

fn handles(
    dim: usize,
    vertices: &[u32],
    targets: &[Vec<f64>],
    groups: &[u32],
) -> Result<Handles, ProblemError> {
    if vertices.len() != targets.len() {
        return Err(ProblemError::Unpaired {
            handles: vertices.len(),
            targets: targets.len(),
        });
    }
    let is_bad = |t: &Vec<f64>| t.len() != dim || !t.iter().all(|x| x.is_finite());
    if let Some(handle) = targets.iter().position(is_bad) {
        return Err(ProblemError::BadTarget { handle, dim });
    }
    let mut order: Vec<usize> = (0..vertices.len()).collect();
    order.sort_by_key(|&i| vertices[i]);
    let same = |w: &&[usize]| vertices[w[0]] == vertices[w[1]] && targets[w[0]] != targets[w[1]];
    if let Some(pair) = order.windows(2).find(same) {
        let vertex = vertices[pair[0]];
        return Err(ProblemError::ContradictoryHandles { vertex });
    }
    order.dedup_by_key(|i| vertices[*i]);
    Ok(Handles {
        vertices: order.iter().map(|&i| vertices[i]).collect(),
        targets: order.iter().flat_map(|&i| targets[i].clone()).collect(),
        groups: order.iter().map(|&i| groups[i]).collect(),
    })
}

/// With a barrier no element may be at ε from the beginning.
fn check_start(body: &Body, start: &[f64], barrier: &Barrier) -> Result<(), ProblemError> {
    if barrier.kind == BarrierKind::None {
        return Ok(());
    }
    let determinants = body.determinants_at(start);
    match determinants.iter().position(|&d| d <= barrier.epsilon || d.is_nan()) {
        Some(element) => Err(ProblemError::InfeasibleStart {
            element,
            determinant: determinants[element],
            epsilon: barrier.epsilon,
        }),
        None => Ok(()),
    }
}

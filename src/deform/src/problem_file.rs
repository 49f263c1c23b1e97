//! Problem files: a mesh, handles and their targets, an energy and a barrier.

use super::body::Body;
use super::handle::{self, Handle};
use super::handles::{Aim, Bound, bind, paired_handles};
use super::problem::{Model, Problem, Units};
use super::problem_error::ProblemError;
use super::soft::SoftPull;
use serde::Deserialize;
use unwrapd_files::io::Elements;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::EnergyKind;
use unwrapd_method::solver::LevenbergSettings;

/// A problem as its file says it; every path is relative to the file.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ProblemFile {
    /// The mesh.
    pub mesh: String,
    /// Start positions, one vertex per line; the rest positions if absent.
    pub initial: Option<String>,
    /// Where rest shapes come from.
    #[serde(default)]
    pub rest: Rest,
    /// The pulled parts: vertex ids, or handles in the form of all other kinds of jobs.
    pub handles: ProblemHandles,
    /// Where vertices should come, one position each.
    #[serde(default, deserialize_with = "handle::places")]
    pub targets: Vec<Vec<f64>>,
    /// Target sets to go through one after another, the last of them [`targets`](Self::targets).
    #[serde(default)]
    pub sequence: Vec<Vec<Vec<f64>>>,
    /// The energy: a name, or a formula of the signed singular values s1 and s2, in space s3.
    pub energy: EnergyKind,
    /// The barrier.
    pub barrier: BarrierKind,
    /// β; the paper's for the energy if absent.
    #[serde(alias = "beta")]
    pub barrier_strength: Option<f64>,
    /// s.
    #[serde(default = "one", alias = "gamma")]
    pub barrier_support: f64,
    /// ε; 1e-4 of the smallest rest determinant if absent.
    pub eps: Option<f64>,
    /// `true` to keep the boundary from crossing itself, too.
    #[serde(default)]
    pub bijective: bool,
    /// Unit of β, ε, tolerances and energies; the unit of the mesh if absent.
    #[serde(default = "given")]
    pub units: Units,
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

fn given() -> Units {
    Units::Given
}

fn one() -> f64 {
    1.0
}

/// Shape of an element without distortion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Rest {
    /// Its x, y or x, y, z.
    #[default]
    Same,
    /// A triangle of space, laid flat.
    Corotated,
}

impl ProblemFile {
    /// Parses JSON.
    pub fn parse(json: &[u8]) -> Result<Self, ProblemError> {
        let file: Result<Self, _> = unwrapd_api::from_json(json);
        let file = file.map_err(|error| ProblemError::Malformed(error.to_string()))?;
        file.handles.check(&file.targets, &file.sequence)?;
        Ok(file)
    }

    /// Returns the paths of the files that it names.
    pub fn references(&self) -> impl Iterator<Item = String> {
        std::iter::once(self.mesh.clone()).chain(self.initial.clone())
    }

    /// Creates the problem on this mesh, starting from these positions or from rest.
    pub fn with(self, mesh: Elements, start: Option<Vec<f64>>) -> Result<Problem, ProblemError> {
        // Make the body that the mesh and the rest shapes ask for.
        let body = if !mesh.tets.is_empty() {
            Body::from(&mesh.into_tet_mesh()?)
        } else if self.rest == Rest::Corotated {
            Body::flattened(&mesh.vertices, &mesh.triangles)?
        } else {
            Body::from(&mesh.into_planar_mesh()?)
        };
        let start = start.unwrap_or_else(|| body.rest.clone());
        body.check(&start)?;
        // Bind the handles, and put the problem together.
        let model = Model {
            energy: self.energy.clone(),
            barrier: self.barrier,
            barrier_strength: self.barrier_strength,
            barrier_support: self.barrier_support,
            max_conformal: None,
            bijective: self.bijective,
        };
        let barrier = model.barrier(&body, self.eps)?;
        let bound = (self.handles).bound(&body, &self.targets, &self.sequence)?;
        let mut problem = Problem {
            stations: bound.stations,
            turned: bound.turns,
            aims: bound.aims,
            soft: bound.soft,
            search: false,
            levenberg: self.levenberg(),
            body,
            start,
            untangled: 0,
            energy: self.energy,
            barrier,
            bound: None,
            boundary_barrier: None,
            units: self.units,
        };
        // Untangle the start before the boundary barrier is added: that needs a start without overlaps.
        problem.untangle_start()?;
        problem.guarded(&model)
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
}

// Handles of a problem file, in either of two forms.

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
type Targets = Vec<Vec<f64>>;

impl ProblemHandles {
    /// Checks that targets are given exactly once.
    fn check(&self, targets: &Targets, sequence: &[Targets]) -> Result<(), ProblemError> {
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
    fn bound(
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
        let stations = stations.map(|set| paired_handles(body.dim(), vertices, set, &groups));
        Ok(Bound {
            stations: stations.collect::<Result<_, _>>()?,
            aims: vertices.iter().map(|&v| Aim::at_vertex(v)).collect(),
            turns: Vec::new(),
            soft: SoftPull::default(),
        })
    }
}

fn check_vertices(vertices: &[u32], n_vertices: usize) -> Result<(), ProblemError> {
    match vertices
        .iter()
        .position(|&v: &u32| v as usize >= n_vertices)
    {
        Some(handle) => Err(ProblemError::UnknownHandle {
            handle,
            vertex: vertices[handle],
            n_vertices,
        }),
        None => Ok(()),
    }
}

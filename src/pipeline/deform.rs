//! Meshes, pictures, drawings and surfaces in a cage pulled by handles.

use serde::{Deserialize, Serialize};

use super::PipelineError;
use super::arrays::in_pool;
use super::bodies::BodyFormat;
use super::caged;
use super::documents::stem;
use super::idle;
use super::limits::{Limits, check_time_budget};
use super::observer::{Observer, Stage, Tracker};
use super::solution::{Deformed, Plan, WriteMap, solve};
use super::source::{Source, TRIANGLES};
use crate::barrier::BarrierKind;
use crate::deform::{Handle, Method, Model, Problem};
use crate::document::Upload;

/// What is deformed and how. The command line's long names in snake case; a file of handles is one with the handles only.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "switches of the command line"
)]
pub struct DeformOptions {
    /// What is pulled, and where to: vertices, points inside elements, discs of vertices.
    pub handles: Vec<Handle>,
    /// What the deformation costs.
    #[serde(flatten)]
    pub model: Model,
    /// About how many triangles an outline is filled with.
    #[cfg_attr(feature = "service", schema(minimum = 1))]
    pub triangles: usize,
    /// Put all meshes of the file, each once and without the transforms of nodes, into a cage of cubes, so many along its longest
    /// side, and deform that. Handles are then places (`at`, `center`); connected parts of the cage without any stay at rest.
    #[cfg_attr(feature = "service", schema(minimum = 1))]
    pub cage: Option<u32>,
    /// With a cage: cut triangles where they pass from one of its tetrahedra into the next, so that they follow it exactly.
    pub split: bool,
    /// Lower the barrier's strength while the energy without it falls.
    pub barrier_continuation: bool,
    /// Also minimize without a barrier and report that energy beside the solution's: the barrier's bias.
    pub bias: bool,
    /// Show the observer the map of every iteration; over HTTP they become files beside the result, 256 MiB of them at most. Not
    /// as gltf, which is several files.
    pub frames: bool,
    /// Seconds after which the current valid map is taken as it is.
    #[cfg_attr(feature = "service", schema(minimum = 0, maximum = 1e6))]
    pub time_budget: Option<f64>,
    /// Format of the result; the input's if absent and possible, else OBJ.
    pub format: Option<BodyFormat>,
    /// Name of the written files without extension; the input's if absent. Not an option over HTTP.
    #[serde(skip)]
    pub stem: Option<String>,
    /// What may be used of all this. Not an option over HTTP.
    #[serde(skip)]
    pub limits: Limits,
}

impl Default for DeformOptions {
    fn default() -> Self {
        Self {
            handles: Vec::new(),
            model: Model::default(),
            triangles: TRIANGLES,
            cage: None,
            split: false,
            barrier_continuation: false,
            bias: false,
            frames: false,
            time_budget: None,
            format: None,
            stem: None,
            limits: Limits::default(),
        }
    }
}

impl DeformOptions {
    /// Checks what can be checked without the file.
    pub fn check(&self) -> Result<(), PipelineError> {
        self.model.check()?;
        check_time_budget(self.time_budget)?;
        self.check_idle().map_err(PipelineError::InvalidOptions)?;
        match (self.format, self.cage) {
            (Some(format), Some(_)) if format.of_document().is_none() => {
                let text = "`format`: surfaces in a cage are written as glb, gltf or obj";
                Err(PipelineError::InvalidOptions(text.to_owned()))
            }
            _ => Ok(()),
        }
    }

    /// Refuses what would do nothing.
    fn check_idle(&self) -> Result<(), String> {
        idle::check_model(&self.model)?;
        let idle = [
            (
                self.split && self.cage.is_none(),
                "`split` goes with `cage`",
            ),
            (
                self.triangles != TRIANGLES && self.cage.is_some(),
                "`triangles` fill an outline; `cage` goes with surfaces",
            ),
            (
                self.barrier_continuation && self.model.barrier == BarrierKind::None,
                "`barrier_continuation` goes with a `barrier`",
            ),
        ];
        let first = idle.into_iter().find(|(is_idle, _)| *is_idle);
        first.map_or(Ok(()), |(_, text)| Err(text.to_owned()))
    }

    pub(super) fn plan(&self) -> Plan {
        Plan {
            method: Method::Projected,
            barrier_continuation: self.barrier_continuation,
            bias: self.bias,
        }
    }

    pub(super) fn stem(&self, upload: &Upload) -> String {
        self.stem.clone().unwrap_or_else(|| stem(&upload.name))
    }
}

/// Pulls a planar or tetrahedral mesh, a picture's outline, a drawing, or surfaces in a cage by handles. With a barrier no
/// element is inverted in any iterate.
pub fn deform_file(
    upload: &Upload,
    options: &DeformOptions,
    observer: &dyn Observer,
) -> Result<Deformed, PipelineError> {
    options.check()?;
    let tracker = Tracker::new(observer, options.limits.time_budget(options.time_budget));
    in_pool(options.limits.threads, || match options.cage {
        Some(n_voxels) => caged::deform(upload, options, n_voxels, &tracker),
        None => deform_body(upload, options, &tracker),
    })?
}

fn deform_body(
    upload: &Upload,
    options: &DeformOptions,
    tracker: &Tracker,
) -> Result<Deformed, PipelineError> {
    tracker.stage(Stage::Read);
    let source = Source::read(upload, options.triangles, &options.limits)?;
    let format = options.format.unwrap_or_else(|| source.format(upload));
    source.check(format, options.frames)?;
    let body = source.body()?;
    let dim = body.dim();
    let problem = Problem::new(body, &options.handles, &options.model)?;
    let file = |x: &[f64]| source.frame(format, dim, x);
    let frames: Option<&WriteMap> = if options.frames { Some(&file) } else { None };
    let solved = solve(&problem, options.plan(), tracker, frames)?;
    tracker.stage(Stage::Write);
    Ok(Deformed {
        files: source.files(format, &options.stem(upload), dim, &solved.solution.x)?,
        report: solved.report,
        trace: solved.trace,
    })
}

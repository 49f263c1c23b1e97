//! How UVs are edited.

use serde::{Deserialize, Serialize};

use super::PipelineError;
use super::idle;
use super::limits::{Limits, check_time_budget};
use crate::deform::uv::{Anchor, UvEditOptions, UvRest};
use crate::deform::{Boundary, Model};
use crate::document::OutputFormat;

/// What UVs are edited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Editing {
    /// To move parts of a map: boundaries follow, and the present shapes are kept, unless the options say otherwise.
    Map,
    /// To align a surface with a texture: boundaries stay, and the surface's shapes are kept, unless the options say otherwise.
    Texture,
}

/// How the UVs of a document are edited. The command line's long names in snake case; a file of anchors is one with the anchors
/// only.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct EditOptions {
    /// Vertices and points of the map and where they go, in the numbers of the file (glTF: v down). `at` means the point of the
    /// surface that has this UV. Also called `points`.
    #[serde(alias = "points")]
    pub anchors: Vec<Anchor>,
    /// The UV set, read and written.
    pub texcoord: u32,
    /// Whether the boundaries of charts stay; if absent they do for `texture_map` and do not for `edit_uv`.
    pub boundary: Option<Boundary>,
    /// Which shapes of triangles to keep; if absent the surface's for `texture_map` and the present ones for `edit_uv`.
    pub rest: Option<UvRest>,
    /// What the deformation costs, for a mean triangle of area 1.
    #[serde(flatten)]
    pub model: Model,
    /// Seconds after which the current valid map is taken as it is.
    #[cfg_attr(feature = "service", schema(minimum = 0, maximum = 1e6))]
    pub time_budget: Option<f64>,
    /// Format of the result.
    pub format: OutputFormat,
    /// Name of the written files without extension; the input's if absent. Not an option over HTTP.
    #[serde(skip)]
    pub stem: Option<String>,
    /// What may be used of all this. Not an option over HTTP.
    #[serde(skip)]
    pub limits: Limits,
}

impl Default for EditOptions {
    fn default() -> Self {
        Self {
            anchors: Vec::new(),
            texcoord: 0,
            boundary: None,
            rest: None,
            model: Model::default(),
            time_budget: None,
            format: OutputFormat::Glb,
            stem: None,
            limits: Limits::default(),
        }
    }
}

impl EditOptions {
    /// Checks what can be checked without the file.
    pub fn check(&self) -> Result<(), PipelineError> {
        self.model.check()?;
        idle::check_model(&self.model).map_err(PipelineError::InvalidOptions)?;
        check_time_budget(self.time_budget)
    }

    pub(super) fn of_map(&self, editing: Editing) -> UvEditOptions {
        let default = match editing {
            Editing::Map => UvEditOptions::edit(),
            Editing::Texture => UvEditOptions::texture(),
        };
        UvEditOptions {
            boundary: self.boundary.unwrap_or(default.boundary),
            rest: self.rest.unwrap_or(default.rest),
            model: self.model,
        }
    }
}

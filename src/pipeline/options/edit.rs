//! How UVs are edited.

use super::{Budget, Caller, CommandOptions, Workers, idle};
use crate::deform::uv::{Anchor, UvEditOptions, UvRest};
use crate::deform::{Boundary, Model};
use crate::document::OutputFormat;
use crate::options::{OptionSet, options};
use crate::pipeline::PipelineError;

/// What UVs are edited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Editing {
    /// To move parts of a map: boundaries follow, and the present shapes are kept, unless the
    /// options say otherwise.
    Map,
    /// To align a surface with a texture: boundaries stay, and the surface's shapes are kept,
    /// unless the options say otherwise.
    Texture,
}

options! {
    /// How the UVs of a document are edited. The command line's long names in snake case; a file of
    /// anchors is one with the anchors only.
    pub struct EditOptions {
        /// The UV set, read and written.
        pub texcoord: u32 = 0, value "N";
        /// Whether the boundaries of charts stay; if absent they do where a surface is aligned with
        /// a texture, and do not where UVs are edited.
        pub boundary: Option<Boundary>;
        /// Which shapes of triangles to keep; if absent the surface's where it is aligned with a
        /// texture, and the present ones where UVs are edited.
        pub rest: Option<UvRest>;
    }
    files {
        /// Vertices and points of the map and where they go, in the numbers of the file (glTF: v
        /// down): {"anchors": [{"vertex": i, "to": [u, v]}, {"at": [u, v], "to": …}, …]}; `at`
        /// means the point of the surface that has this UV. Also called points.
        pub anchors: Vec<Anchor>, also "points";
        /// Format of the result.
        pub format: OutputFormat = OutputFormat::Glb;
    }
    groups {
        /// What the deformation costs, for a mean triangle of area 1.
        pub model: Model;
        /// What works.
        pub workers: Workers;
        /// How long it may take.
        pub budget: Budget;
    }
    untold {
        /// What the code that edits says.
        pub caller: Caller;
    }
}

impl EditOptions {
    pub(in crate::pipeline) fn of_map(&self, editing: Editing) -> UvEditOptions {
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

impl CommandOptions for EditOptions {
    fn check(&self) -> Result<(), PipelineError> {
        self.model.check()?;
        (self.check_ranges())
            .and_then(|()| idle::check_model(&self.model))
            .map_err(PipelineError::InvalidOptions)
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

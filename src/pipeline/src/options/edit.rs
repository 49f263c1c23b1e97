//! Options of UV editing.

use super::{Budget, Caller, CommandOptions, Pulling, Workers, idle};
use crate::PipelineError;
use unwrapd_api::options::{OptionSet, options};
use unwrapd_deform::uv::{Anchor, UvEditOptions, UvRest};
use unwrapd_deform::{Boundary, Model};
use unwrapd_files::document::OutputFormat;

/// Purpose of editing UVs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Editing {
    /// Moving parts of a map: by default boundaries follow, and the current UV shapes are preserved.
    Map,
    /// Aligning a surface with a texture: by default boundaries stay, and the shapes of the surface are preserved.
    Texture,
}

options! {
    /// How the UVs of a document are edited. The command line's long names in snake case; a file of
    /// anchors is one with the anchors only.
    pub struct EditOptions {
        /// The UV set to read and write.
        pub texcoord: u32 = 0, value "N";
        /// Whether the boundaries of charts stay fixed. The default is fixed when a surface is
        /// aligned with a texture, free when UVs are edited.
        pub boundary: Option<Boundary>;
        /// Which triangle shapes to preserve. The default is the shapes on the surface when it is
        /// aligned with a texture, the present UV shapes when UVs are edited.
        pub rest: Option<UvRest>;
    }
    files {
        /// Anchors of the map and their targets: {"anchors": [{"vertex": i, "to": [u, v]}, {"at":
        /// [u, v], "to": …}, …]}. All UVs are as in the file; in glTF, v points down. `at` selects
        /// the point of the surface with this UV. `points` is another name for this list.
        pub anchors: Vec<Anchor>, also "points";
        /// Format of the result.
        pub format: OutputFormat = OutputFormat::Glb;
    }
    groups {
        /// Energy and barrier, for a mean triangle area of 1.
        pub model: Model;
        /// Which ways handles go.
        pub pulling: Pulling;
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
    pub(crate) fn of_map(&self, editing: Editing) -> UvEditOptions {
        let default = match editing {
            Editing::Map => UvEditOptions::edit(),
            Editing::Texture => UvEditOptions::texture(),
        };
        UvEditOptions {
            boundary: self.boundary.unwrap_or(default.boundary),
            rest: self.rest.unwrap_or(default.rest),
            model: self.model.clone(),
            search: self.pulling.search,
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

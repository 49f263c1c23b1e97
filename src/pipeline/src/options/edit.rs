//! Options of UV editing.

use super::{Budget, Caller, CommandOptions, Pulling, Workers, checks};
use crate::PipelineError;
use unwrapd_api::options::{OptionSet, options};
use unwrapd_deform::uv::{Anchor, UvEditOptions, UvRest};
use unwrapd_deform::warp::{self, PictureHandle};
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
    /// Options of UV editing. They have the command line's long names in snake case. A file of
    /// anchors has only the anchors.
    pub struct EditOptions {
        /// The UV set to read and write.
        pub texcoord: u32 = 0, value "N";
        /// Treatment of chart boundaries. The default is fixed when a surface is aligned with a
        /// texture, free when UVs are edited.
        pub boundary: Option<Boundary>;
        /// Which triangle shapes to preserve. The default is the shapes on the surface when it is
        /// aligned with a texture, the present UV shapes when UVs are edited.
        pub rest: Option<UvRest>;
    }
    files {
        /// Anchors of the map and their targets: {"anchors": [{"vertex": 0, "to": [u, v]}, {"at": [u,
        /// v], "to": …}, {"center": …, "radius": r, "to": …, "turn": degrees}, {"low": …, "high": …,
        /// "to": …}, {"outline": [[u, v], …], "to": …}, {"line": [[u, v], …], "to": [[u, v], …]},
        /// {"vertices": [0, 7], "by": …}, {"select": "material=Skin", "by": …}, …]}. All UVs are as in
        /// the file; in glTF, v points down. `points` is another name for this list.
        ///
        /// An anchor is a vertex, the point of the surface with a UV, a line, or the vertices in a disc, a
        /// box or an outline, of a list or of a selector, which keep their shape. `to` is where its
        /// middle goes, for a line the new line; `by` is an offset in its place. It may turn by at most
        /// 180 degrees, from u to v. A place, a region and a line hold only the chart in which they lie.
        /// Selectors are all, material=NAME, object=NAME, color=RRGGBB and faces=P/F,P/F, as in `control`.
        /// An anchor with a "weight" is soft: the energy grows by that times the mean squared distance of
        /// what it holds from its targets.
        pub anchors: Vec<Anchor>, also "points";
        /// Format of the result.
        pub format: OutputFormat = OutputFormat::Glb;
    }
    groups {
        /// Energy and barrier, for a mean triangle area of 1.
        pub model: Model;
        /// Paths of handles to their targets.
        pub pulling: Pulling;
        /// Number of threads.
        pub workers: Workers;
        /// Time limit.
        pub budget: Budget;
    }
    untold {
        /// Settings of the caller.
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
            .and_then(|()| checks::check_model(&self.model))
            .map_err(PipelineError::InvalidOptions)
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

// Options of picture warping.

options! {
    /// Options of warping a picture. They have the command line's long names in snake case. A file
    /// of handles has only the handles.
    pub struct WarpOptions {
        /// Number of grid cells along the longer side of the picture.
        pub grid: usize = warp::WarpOptions::default().grid, value "N", schema(minimum = 1, maximum = 512);
        /// Hold the border fixed, which makes the map bijective. Handles next to the border then
        /// move the nearest inner vertex.
        pub fix_border: bool;
    }
    files {
        /// Handles of the picture and their targets, in pixels, y down: {"handles": [{"at": [x, y],
        /// "to": …}, {"center": …, "radius": r, "to": …, "turn": degrees}, {"low": …, "high": …, "to":
        /// …}, {"outline": [[x, y], …], "to": …}, {"line": [[x, y], …], "to": [[x, y], …]}, …]}.
        ///
        /// A handle is a point, a line, or what is in a disc, a box or an outline, which keeps its shape.
        /// `to` is where its middle goes, for a line the new line. It may turn by at most 180 degrees,
        /// counter-clockwise as seen. A handle with a "weight" is soft: the energy grows by that times
        /// the mean squared distance of what it holds from its targets. Next to a fixed border, a point
        /// moves the nearest inner vertex of the grid by the same offset, and a line ends.
        pub handles: Vec<PictureHandle>;
    }
    groups {
        /// Energy and barrier, for a mean triangle area between ½ and 2.
        pub model: Model;
        /// Paths of handles to their targets.
        pub pulling: Pulling;
        /// Number of threads.
        pub workers: Workers;
        /// Time limit.
        pub budget: Budget;
    }
    untold {
        /// Settings of the caller.
        pub caller: Caller;
    }
}

impl WarpOptions {
    pub(crate) fn of_grid(&self) -> warp::WarpOptions {
        warp::WarpOptions {
            grid: self.grid,
            boundary: if self.fix_border {
                Boundary::Fixed
            } else {
                Boundary::Free
            },
            model: self.model.clone(),
            search: self.pulling.search,
        }
    }
}

impl CommandOptions for WarpOptions {
    fn check(&self) -> Result<(), PipelineError> {
        self.model.check()?;
        (self.check_ranges())
            .and_then(|()| checks::check_model(&self.model))
            .map_err(PipelineError::InvalidOptions)
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

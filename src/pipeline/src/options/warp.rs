//! Options of picture warping.

use super::{Budget, Caller, CommandOptions, Pulling, Workers, idle};
use crate::PipelineError;
use unwrapd_api::options::{OptionSet, options};
use unwrapd_deform::warp::{self, PictureHandle};
use unwrapd_deform::{Boundary, Model};

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
        /// Points of the picture and their targets, in pixels, y down: {"handles": [{"at": [x, y],
        /// "to": [x, y]}, …]}.
        ///
        /// Each handle moves its exact point. Next to a fixed border it moves the nearest inner
        /// vertex of the grid by the same offset.
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
            .and_then(|()| idle::check_model(&self.model))
            .map_err(PipelineError::InvalidOptions)
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

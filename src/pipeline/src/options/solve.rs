//! Options of problem files.

use super::{Budget, Caller, CommandOptions, Course, Pulling, Workers, idle};
use crate::PipelineError;
use crate::deform::formats::BodyFormat;
use crate::deform::plan::Plan;
use unwrapd_api::options::{OptionSet, options};
use unwrapd_deform::Method;

options! {
    /// Options of solving a problem file. They have the command line's long names in snake case.
    pub struct SolveOptions {
        /// Solver: projected Newton with advancing targets, or the iteration of the paper.
        pub method: Method = Method::Projected;
    }
    files {
        /// Record the map of every iteration. Over HTTP these become files beside the result, at
        /// most 256 MiB.
        pub frames: bool;
        /// Format of the result. The default is positions as text.
        pub format: BodyFormat = BodyFormat::Txt;
    }
    groups {
        /// Additional steps and tolerance of the solver.
        pub course: Course;
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

impl SolveOptions {
    pub(crate) fn plan(&self) -> Plan {
        self.course.plan(self.method)
    }
}

impl CommandOptions for SolveOptions {
    fn check(&self) -> Result<(), PipelineError> {
        self.check_ranges()
            .and_then(|()| idle::check_method(&self.course, self.pulling, self.method))
            .map_err(PipelineError::InvalidOptions)?;
        self.format.check_for_mesh()
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

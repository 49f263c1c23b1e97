//! What is deformed and how.

use super::{Budget, Caller, CommandOptions, Course, Workers, idle};
use crate::barrier::BarrierKind;
use crate::deform::{Handle, Method, Model};
use crate::options::{OptionSet, options};
use crate::pipeline::PipelineError;
use crate::pipeline::deform::formats::BodyFormat;
use crate::pipeline::deform::plan::Plan;
use crate::pipeline::deform::source::TRIANGLES;

options! {
    /// What is deformed and how. The command line's long names in snake case; a file of handles is
    /// one with the handles only.
    pub struct DeformOptions {
        /// About how many triangles an outline is filled with.
        pub triangles: usize = TRIANGLES, value "N", schema(minimum = 1);
        /// Put all meshes of the file, each once and without the transforms of nodes, into a cage
        /// of cubes, so many along its longest side, and deform that. Handles are then places
        /// ("at", "center"); connected parts of the cage without any stay at rest.
        pub cage: Option<u32>, value "N", schema(minimum = 1);
        /// With a `cage`: cut triangles where they pass from one of its tetrahedra into the next,
        /// so that they follow it exactly.
        pub split: bool;
    }
    files {
        /// What is pulled, and where to: vertices, points inside elements, discs of vertices:
        /// {"handles": [{"vertex": 0, "to": [x, y]}, {"at": [x, y], "to": …}, {"center": …,
        /// "radius": r, "to": …}]}.
        pub handles: Vec<Handle>;
        /// Show the observer the map of every iteration; over HTTP they become files beside the
        /// result, 256 MiB of them at most. Not as gltf, which is several files.
        pub frames: bool;
        /// Format of the result; the input's if absent and possible, else OBJ.
        pub format: Option<BodyFormat>;
    }
    groups {
        /// What the deformation costs.
        pub model: Model;
        /// What is done beside minimizing once.
        pub course: Course;
        /// What works.
        pub workers: Workers;
        /// How long it may take.
        pub budget: Budget;
    }
    untold {
        /// What the code that deforms says.
        pub caller: Caller;
    }
}

impl DeformOptions {
    /// Refuses what would do nothing.
    fn check_idle(&self) -> Result<(), String> {
        idle::check_model(&self.model)?;
        let is_barrier_absent = self.model.barrier == BarrierKind::None;
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
                self.course.barrier_continuation && is_barrier_absent,
                "`barrier_continuation` goes with a `barrier`",
            ),
        ];
        let first = idle.into_iter().find(|(is_idle, _)| *is_idle);
        first.map_or(Ok(()), |(_, text)| Err(text.to_owned()))
    }

    fn check_format(&self) -> Result<(), String> {
        match (self.format, self.cage) {
            (Some(format), Some(_)) if format.of_document().is_none() => {
                Err("`format`: surfaces in a cage are written as glb, gltf or obj".to_owned())
            }
            _ => Ok(()),
        }
    }

    pub(in crate::pipeline) fn plan(&self) -> Plan {
        Plan {
            method: Method::Projected,
            barrier_continuation: self.course.barrier_continuation,
            bias: self.course.bias,
        }
    }
}

impl CommandOptions for DeformOptions {
    fn check(&self) -> Result<(), PipelineError> {
        self.model.check()?;
        (self.check_ranges())
            .and_then(|()| self.check_idle())
            .and_then(|()| self.check_format())
            .map_err(PipelineError::InvalidOptions)
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

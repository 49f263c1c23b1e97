//! Options of deformation.

use super::{Budget, Caller, CommandOptions, Course, Pulling, Workers, idle};
use crate::PipelineError;
use crate::deform::formats::BodyFormat;
use crate::deform::plan::Plan;
use crate::deform::source::TRIANGLES;
use unwrapd_api::options::{OptionSet, options};
use unwrapd_deform::{Handle, Method, Model};
use unwrapd_method::barrier::BarrierKind;

options! {
    /// Options of deformation. They have the command line's long names in snake case. A file of
    /// handles has only the handles.
    pub struct DeformOptions {
        /// Approximate number of triangles to fill an outline with.
        pub triangles: usize = TRIANGLES, value "N", schema(minimum = 1);
        /// Deform the meshes of the file in a cage of cubes, this many along its longest side.
        ///
        /// Each mesh enters the cage once, without the transforms of nodes. Handles are then places
        /// (`at`, `center`). Connected parts of the cage without a handle stay at rest.
        pub cage: Option<u32>, value "N", schema(minimum = 1);
        /// With `cage`: split triangles where they cross from one tetrahedron of the cage into the
        /// next. They then follow the cage exactly.
        pub split: bool;
    }
    files {
        /// Handles and their targets. A handle is a vertex, a point inside an element, or a disc of
        /// vertices: {"handles": [{"vertex": 0, "to": [x, y]}, {"at": [x, y], "to": …}, {"center":
        /// …, "radius": r, "to": …, "turn": degrees, "axis": …}]}. A disc may turn by any angle, in
        /// space about an axis.
        pub handles: Vec<Handle>;
        /// Record the map of every iteration. Over HTTP these become files beside the result, at
        /// most 256 MiB. Not available for gltf, which consists of several files.
        pub frames: bool;
        /// Format of the result. The default is the format of the input if it can be written,
        /// otherwise OBJ.
        pub format: Option<BodyFormat>;
    }
    groups {
        /// Energy and barrier.
        pub model: Model;
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

impl DeformOptions {
    /// Rejects options that would have no effect.
    fn check_idle(&self) -> Result<(), String> {
        idle::check_model(&self.model)?;
        let is_barrier_absent = self.model.barrier == BarrierKind::None;
        let idle = [
            (self.split && self.cage.is_none(), "`split` requires `cage`"),
            (
                self.triangles != TRIANGLES && self.cage.is_some(),
                "`triangles` applies to outlines, `cage` to surfaces: give one of them",
            ),
            (
                self.course.barrier_continuation && is_barrier_absent,
                "`barrier_continuation` requires a `barrier`",
            ),
        ];
        let first = idle.into_iter().find(|(is_idle, _)| *is_idle);
        first.map_or(Ok(()), |(_, text)| Err(text.to_owned()))
    }

    fn check_format(&self) -> Result<(), String> {
        match (self.format, self.cage) {
            (Some(format), Some(_)) if format.of_document().is_none() => {
                Err("`format` must be glb, gltf or obj with `cage`".to_owned())
            }
            _ => Ok(()),
        }
    }

    pub(crate) fn plan(&self) -> Plan {
        self.course.plan(Method::Projected)
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

//! Options of deformation.

use super::{Budget, Caller, CommandOptions, Workers, checks};
use crate::PipelineError;
use serde::{Deserialize, Serialize};
use unwrapd_api::options::{OptionSet, options};
use unwrapd_deform::{Handle, Method, Model, Problem};
use unwrapd_files::document::OutputFormat;
use unwrapd_files::io::{ElementFormat, Elements, Format, text_positions, vtu};
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::solver::Settings;

/// Default for the approximate number of triangles of a filled outline.
pub(crate) const TRIANGLES: usize = 5000;

options! {
    /// Options of deformation. They have the command line's long names in snake case. A file of
    /// handles has only the handles.
    pub struct DeformOptions {
        /// Approximate number of triangles to fill an outline with.
        pub triangles: usize = TRIANGLES, value "N", schema(minimum = 1);
        /// Deform the meshes of the file in a cage of cubes, this many along its longest side.
        ///
        /// Each mesh enters the cage once, without the transforms of nodes. Handles are then places
        /// (`at`, `center`) or selections. Connected parts of the cage without a handle stay at rest.
        pub cage: Option<u32>, value "N", schema(minimum = 1);
        /// With `cage`: split triangles where they cross from one tetrahedron of the cage into the
        /// next. They then follow the cage exactly.
        pub split: bool;
    }
    files {
        /// Handles and their targets: {"handles": [{"vertex": 0, "to": [x, y]}, {"at": [x, y], "to":
        /// …}, {"center": …, "radius": r, "to": …, "turn": degrees, "axis": …}, {"low": …, "high": …,
        /// "to": …}, {"outline": [[x, y], …], "to": …}, {"line": [[x, y], …], "to": [[x, y], …]},
        /// {"vertices": [0, 7], "by": …}, {"select": "material=Skin", "by": …}, …]}.
        ///
        /// A handle is a vertex, a point inside an element, a line, or the vertices in a disc, a box or
        /// an outline, of a list or of a selector, which keep their shape. `to` is where its middle goes,
        /// for a line the new line; `by` is an offset in its place. It may turn by any angle, in space
        /// about an axis. Selectors are all, material=NAME, object=NAME, color=RRGGBB and faces=P/F,P/F,
        /// as in `control`. A handle with a "weight" is soft: the energy grows by that times the mean
        /// squared distance of what it holds from its targets.
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
        checks::check_model(&self.model)?;
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

    pub(crate) fn plan(&self) -> SolutionPlan {
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

// Options of problem files.

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
    pub(crate) fn plan(&self) -> SolutionPlan {
        self.course.plan(self.method)
    }
}

impl CommandOptions for SolveOptions {
    fn check(&self) -> Result<(), PipelineError> {
        self.check_ranges()
            .and_then(|()| check_method(&self.course, self.pulling, self.method))
            .map_err(PipelineError::InvalidOptions)?;
        self.format.check_for_mesh()
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

// Options for additional steps of the solver.

options! {
    /// Additional steps and tolerance of the solver.
    #[derive(Copy)]
    pub struct Course under "Course of the solver" {
        /// Lower the barrier strength as long as the energy without the barrier falls.
        pub barrier_continuation: bool;
        /// Also report the energy that the map tends to as the barrier strength tends to 0. The
        /// difference is the bias of the barrier.
        pub bias: bool;
        /// The minimization ends when a step promises to lower the energy by less than this share.
        /// The default is 1e-6.
        pub tolerance: Option<f64>, in 1e-15..=1e-1, value "SHARE";
    }
}

impl Course {
    pub(super) fn plan(self, method: Method) -> SolutionPlan {
        let default = Settings::follow();
        SolutionPlan {
            method,
            barrier_continuation: self.barrier_continuation,
            bias: self.bias,
            settings: Settings {
                tolerance: self.tolerance.unwrap_or(default.tolerance),
                ..default
            },
        }
    }
}

// Options for the paths of handles to their targets.

options! {
    /// Paths of handles to their targets.
    #[derive(Copy)]
    pub struct Pulling under "Ways to the targets" {
        /// Try all bent ways to the targets, even if the straight ones lead there, and keep the map
        /// with the lowest energy. Costs up to nine minimizations.
        pub search: bool;
    }
}

// Formats of deformed bodies.

/// File format of a deformed body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum BodyFormat {
    /// Positions, one per line, 17 digits.
    Txt,
    /// Wavefront OBJ: triangles only.
    Obj,
    /// Geomview OFF: triangles only.
    Off,
    /// Gmsh.
    Msh,
    /// Medit.
    Mesh,
    /// TET: counts, positions, corners.
    Tet,
    /// VTK XML.
    Vtu,
    /// Binary glTF, for surfaces in a cage and for planar meshes from glTF, PLY or STL.
    Glb,
    /// glTF with separate files, for the same.
    Gltf,
}

impl BodyFormat {
    const ALL: [(Self, Format); 9] = [
        (Self::Txt, Format::Txt),
        (Self::Obj, Format::Obj),
        (Self::Off, Format::Off),
        (Self::Msh, Format::Msh),
        (Self::Mesh, Format::Mesh),
        (Self::Tet, Format::Tet),
        (Self::Vtu, Format::Vtu),
        (Self::Glb, Format::Glb),
        (Self::Gltf, Format::Gltf),
    ];

    /// Returns the format for the extension of a file name.
    pub fn of_name(name: &str) -> Option<Self> {
        let named = Format::of_name(name)?;
        let mut all = Self::ALL.into_iter();
        all.find_map(|(format, file)| (file == named).then_some(format))
    }

    /// Returns the extension of its files.
    pub fn extension(self) -> &'static str {
        self.file().map_or("", Format::extension)
    }

    fn file(self) -> Option<Format> {
        let mut all = Self::ALL.into_iter();
        all.find_map(|(format, file)| (format == self).then_some(file))
    }

    /// Returns the corresponding document format; `None` if there is none.
    pub(crate) fn of_document(self) -> Option<OutputFormat> {
        match self {
            Self::Obj => Some(OutputFormat::Obj),
            Self::Glb => Some(OutputFormat::Glb),
            Self::Gltf => Some(OutputFormat::Gltf),
            _ => None,
        }
    }

    /// Checks that the result of a mesh without a document can be written in this format.
    pub(crate) fn check_for_mesh(self) -> Result<(), PipelineError> {
        match self {
            Self::Glb | Self::Gltf => Err(PipelineError::InvalidOptions(
                "`format`: of this input the result is txt, obj, off, msh, mesh, tet or vtu".into(),
            )),
            _ => Ok(()),
        }
    }

    /// Returns the file of elements whose vertices have `dim` coordinates.
    pub(crate) fn write_elements(self, elements: &Elements, dim: usize) -> Vec<u8> {
        let text = match self.file().and_then(ElementFormat::of) {
            Some(format) => format.write(elements),
            None if dim == 2 => {
                let vertices = elements.vertices.iter().map(|p| [p[0], p[1]]);
                text_positions::<2>(&vertices.collect::<Vec<_>>())
            }
            None => text_positions::<3>(&elements.vertices),
        };
        text.into_bytes()
    }

    /// Returns the file of a deformed body: `elements` at the positions `x`, which are flattened. VTK files also
    /// contain the distortion of each element.
    pub(crate) fn write(self, elements: &Elements, problem: &Problem, x: &[f64]) -> Vec<u8> {
        let format = self.file().and_then(ElementFormat::of);
        let dim = problem.body.dim();
        let text = match (format, dim) {
            (None, 2) => text_positions::<2>(x.as_chunks().0),
            (None, _) => text_positions::<3>(x.as_chunks().0),
            (Some(format), _) => {
                let moved = Elements {
                    vertices: x
                        .chunks_exact(dim)
                        .map(|p: &[f64]| [p[0], p[1], p.get(2).copied().unwrap_or(0.0)])
                        .collect(),
                    ..elements.clone()
                };
                if format == ElementFormat::Vtu {
                    vtu::write(&moved, &problem.cells(x))
                } else {
                    format.write(&moved)
                }
            }
        };
        text.into_bytes()
    }
}

// Solution plans for problems.

/// Method, settings and additional steps of a solution.
#[derive(Clone, Copy)]
pub struct SolutionPlan {
    pub method: Method,
    /// Lowers the barrier's strength while the energy without it falls.
    pub barrier_continuation: bool,
    /// Also minimizes the energy without a barrier.
    pub bias: bool,
    /// Settings of the projected method.
    pub settings: Settings,
}

/// Rejects options of the projected method if another method solves.
fn check_method(course: &Course, pulling: Pulling, method: Method) -> Result<(), String> {
    let is_other = method != Method::Projected;
    let with = "`method` projected";
    checks::refused([
        ("search", with, pulling.search && is_other),
        ("tolerance", with, course.tolerance.is_some() && is_other),
    ])
}

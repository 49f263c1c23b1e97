//! Untangling of folded meshes.

use crate::arrays::unwrap::in_pool;
use crate::observer::Observer;
use crate::options::{BodyFormat, Budget, Caller, CommandOptions, Workers};
use crate::tracker::Tracker;
use crate::{PipelineError, limits};
use serde::{Deserialize, Serialize};
use unwrapd_api::options::{OptionSet, options};
use unwrapd_api::{Limits, Stage};
use unwrapd_deform::{Boundary, FoldedMesh, RestOfFolded};
use unwrapd_files::document::{DocumentError, Upload, Warning};
use unwrapd_files::io::{Content, ElementFormat, Elements, Format, format_of_content};

options! {
    /// Options of untangling. They have the command line's long names in snake case.
    pub struct UntangleOptions {
        /// Rest shapes of the elements. implied: each one's own if it is not inverted, a regular one
        /// of mean size otherwise. regular: regular ones of the same size.
        pub rest: RestOfFolded = RestOfFolded::Implied;
        /// Boundary of the mesh: fixed, or free to move near inverted elements.
        pub boundary: Boundary = Boundary::Fixed;
        /// Time limit in seconds. A mesh without inversions that is found by then becomes the result;
        /// without one, the work fails (`ended_early`).
        pub time_budget: Option<f64>, in 0..=1e6, value "SECONDS", arg(help_heading = "Time");
    }
    files {
        /// Format of the result. The default is the format of the input.
        pub format: Option<BodyFormat>;
        /// Over HTTP: the name of the part `resource` with the rest shapes, a mesh of the same vertices
        /// and elements without inversions.
        pub rest_mesh: Option<String>;
    }
    groups {
        /// Number of threads.
        pub workers: Workers;
    }
    untold {
        /// Settings of the caller.
        pub caller: Caller;
    }
}

impl UntangleOptions {
    /// Returns the time limit within the limits of the caller.
    fn budget(&self) -> Budget {
        let time_budget = self.time_budget;
        self.caller.budget(Budget { time_budget })
    }
}

impl CommandOptions for UntangleOptions {
    fn check(&self) -> Result<(), PipelineError> {
        self.check_ranges().map_err(PipelineError::InvalidOptions)?;
        self.format.map_or(Ok(()), BodyFormat::check_for_mesh)
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

/// Report on an untangled mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct UntangleReport {
    /// Number of elements.
    pub elements: usize,
    /// Elements that were inverted or empty.
    pub inverted_before: usize,
    /// Elements whose corners the file has in the opposite order of their neighbors'.
    pub turned: usize,
    /// Vertices that moved.
    pub moved: usize,
    /// The smallest size of an element over its rest size.
    pub smallest: f64,
    /// Warnings: that the work ended early, if it did.
    pub warnings: Vec<Warning>,
}

/// An untangled mesh as a file.
#[derive(Clone, Debug)]
pub struct Untangled {
    /// The written file by name.
    pub files: Vec<(String, Vec<u8>)>,
    /// Report on the change.
    pub report: UntangleReport,
}

/// Untangles the mesh of a file like [`untangle_mesh`]. `rest` is the file of a mesh with the rest shapes, if they are given.
pub fn untangle_file(
    upload: &Upload,
    rest: Option<&Upload>,
    options: &UntangleOptions,
    observer: &dyn Observer,
) -> Result<Untangled, PipelineError> {
    options.check()?;
    let tracker = Tracker::new(observer, options.budget());
    in_pool(options.caller.workers(options.workers), || {
        // Read the meshes.
        tracker.stage(Stage::Read);
        let limits = &options.caller.limits;
        let (mesh, found) = read(upload, limits)?;
        let rest = rest.map(|rest| read(rest, limits)).transpose()?;
        let rest = rest.as_ref().map(|(mesh, _)| mesh);
        // Untangle, and write the result.
        let UntangledMesh {
            elements,
            dim,
            report,
        } = untangled(&mesh, rest, options, &tracker)?;
        tracker.stage(Stage::Write);
        let format = options.format.unwrap_or(found);
        let file = format.write_elements(&elements, dim);
        let stem = options.caller.stem(upload);
        Ok(Untangled {
            files: vec![(format!("{stem}.{}", format.extension()), file)],
            report,
        })
    })?
}

/// An untangled mesh as arrays.
#[derive(Clone, Debug)]
pub struct UntangledMesh {
    /// The mesh, with its elements wound alike.
    pub elements: Elements,
    /// Coordinates of a position: 2 for triangles, 3 for tetrahedra.
    pub dim: usize,
    /// Report on the change.
    pub report: UntangleReport,
}

/// Untangles a mesh of tetrahedra, or of triangles in the plane: moves vertices until no element is inverted or empty,
/// which is checked exactly. `rest` is a mesh with the rest shapes, if they are given.
///
/// # Errors
/// If this is no such mesh, if no map without inversions is found, or if the work ends before.
pub fn untangle_mesh(
    mesh: &Elements,
    rest: Option<&Elements>,
    options: &UntangleOptions,
    observer: &dyn Observer,
) -> Result<UntangledMesh, PipelineError> {
    options.check()?;
    let tracker = Tracker::new(observer, options.budget());
    in_pool(options.caller.workers(options.workers), || {
        untangled(mesh, rest, options, &tracker)
    })?
}

fn untangled(
    mesh: &Elements,
    rest: Option<&Elements>,
    options: &UntangleOptions,
    tracker: &Tracker,
) -> Result<UntangledMesh, PipelineError> {
    let folded = FoldedMesh::new(mesh, options.rest, rest)?;
    let unfolded = folded.untangled(options.boundary, tracker)?;
    let elements = folded.elements_at(&unfolded.x);
    Ok(UntangledMesh {
        dim: folded.dim(),
        report: UntangleReport {
            elements: elements.triangles.len() + elements.tets.len(),
            inverted_before: unfolded.inverted,
            turned: folded.turned(),
            moved: unfolded.moved,
            smallest: unfolded.smallest,
            warnings: tracker.warning().into_iter().collect(),
        },
        elements,
    })
}

/// Reads a mesh; returns the format to write it in, too. The extension determines its format; without one, the first
/// bytes do.
fn read(upload: &Upload, limits: &Limits) -> Result<(Elements, BodyFormat), PipelineError> {
    let size = upload.bytes.len() as u64;
    let format = if upload.extension().is_empty() {
        format_of_content(&upload.bytes, size, Content::Body)
    } else {
        Format::of_name(&upload.name)
    };
    let format = format.ok_or(DocumentError::UnknownFormat)?;
    let reader = ElementFormat::of(format).ok_or(DocumentError::UnknownFormat)?;
    let elements = reader.read(&upload.bytes)?;
    limits::check_count(limits, elements.triangles.len() + elements.tets.len())?;
    let name = format!("mesh.{}", format.extension());
    Ok((
        elements,
        BodyFormat::of_name(&name).unwrap_or(BodyFormat::Obj),
    ))
}

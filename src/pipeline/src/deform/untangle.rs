//! Untangling of folded meshes.

use crate::arrays::unwrap::in_pool;
use crate::options::{BodyFormat, Caller, CommandOptions, Workers};
use crate::{PipelineError, limits};
use serde::{Deserialize, Serialize};
use unwrapd_api::Limits;
use unwrapd_api::options::{OptionSet, options};
use unwrapd_deform::{Boundary, FoldedMesh, RestOfFolded};
use unwrapd_files::document::{DocumentError, Upload};
use unwrapd_files::io::{Content, ElementFormat, Elements, Format, format_of_content};

options! {
    /// Options of untangling. They have the command line's long names in snake case.
    pub struct UntangleOptions {
        /// Rest shapes of the elements. implied: each one's own if it is not inverted, a regular one
        /// of mean size otherwise. regular: regular ones of the same size.
        pub rest: RestOfFolded = RestOfFolded::Implied;
        /// Boundary of the mesh: fixed, or free to move near inverted elements.
        pub boundary: Boundary = Boundary::Fixed;
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
}

/// An untangled mesh.
#[derive(Clone, Debug)]
pub struct Untangled {
    /// The written file by name.
    pub files: Vec<(String, Vec<u8>)>,
    /// Report on the change.
    pub report: UntangleReport,
}

/// Untangles a mesh of tetrahedra, or of triangles in the plane: moves vertices until no element is inverted or empty,
/// which is checked exactly. `rest` is a mesh with the rest shapes, if they are given.
pub fn untangle_file(
    upload: &Upload,
    rest: Option<&Upload>,
    options: &UntangleOptions,
) -> Result<Untangled, PipelineError> {
    options.check()?;
    in_pool(options.caller.workers(options.workers), || {
        // Read the meshes.
        let limits = &options.caller.limits;
        let (mesh, found) = read(upload, limits)?;
        let rest = rest.map(|rest| read(rest, limits)).transpose()?;
        let folded = FoldedMesh::new(&mesh, options.rest, rest.as_ref().map(|(mesh, _)| mesh))?;
        // Untangle, and write the result.
        let unfolded = folded.untangled(options.boundary)?;
        let elements = folded.elements_at(&unfolded.x);
        let format = options.format.unwrap_or(found);
        let file = format.write_elements(&elements, folded.dim());
        let stem = options.caller.stem(upload);
        Ok(Untangled {
            files: vec![(format!("{stem}.{}", format.extension()), file)],
            report: UntangleReport {
                elements: elements.triangles.len() + elements.tets.len(),
                inverted_before: unfolded.inverted,
                turned: folded.turned(),
                moved: unfolded.moved,
                smallest: unfolded.smallest,
            },
        })
    })?
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

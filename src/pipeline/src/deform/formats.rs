//! Formats of deformed bodies.

use serde::{Deserialize, Serialize};

use crate::PipelineError;
use unwrapd_deform::Problem;
use unwrapd_files::document::OutputFormat;
use unwrapd_files::io::{ElementFormat, Elements, Format, text_positions, vtu};

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

    /// Returns the file of a deformed body: `elements` at the positions `x`, which are flattened. VTK files also
    /// contain the distortion of each element.
    pub(crate) fn write(self, elements: &Elements, problem: &Problem, x: &[f64]) -> Vec<u8> {
        let format = self.file().and_then(ElementFormat::of);
        let dim = problem.body.dim();
        let text = match (format, dim) {
            (None, 2) => text_positions::<2>(x.as_chunks().0),
            (None, _) => text_positions::<3>(x.as_chunks().0),
            (Some(format), _) => {
                let place = |p: &[f64]| [p[0], p[1], p.get(2).copied().unwrap_or(0.0)];
                let moved = Elements {
                    vertices: x.chunks_exact(dim).map(place).collect(),
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

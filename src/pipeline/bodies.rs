//! Bodies from files and back.

use serde::{Deserialize, Serialize};

use super::PipelineError;
use super::limits::Limits;
use super::merged::Merged;
use crate::deform::Body;
use crate::deform::outline::{self, ImageSettings, MeshSettings, Resolution, SvgSettings};
use crate::document::{Document, GroupBy, OutputFormat, Upload};
use crate::mesh::Surface;
use crate::mesh::io::{ElementFormat, Elements, text_positions};
use crate::picture::Image;

/// What a deformed body is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
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
    /// Counts, positions, corners.
    Tet,
    /// VTK XML.
    Vtu,
    /// Binary glTF: surfaces in a cage.
    Glb,
    /// glTF with its files beside it: surfaces in a cage.
    Gltf,
}

impl BodyFormat {
    const ALL: [(Self, &'static str); 9] = [
        (Self::Txt, "txt"),
        (Self::Obj, "obj"),
        (Self::Off, "off"),
        (Self::Msh, "msh"),
        (Self::Mesh, "mesh"),
        (Self::Tet, "tet"),
        (Self::Vtu, "vtu"),
        (Self::Glb, "glb"),
        (Self::Gltf, "gltf"),
    ];

    /// The format by a file's extension, in lower case and without the dot.
    pub fn of_extension(extension: &str) -> Option<Self> {
        let mut all = Self::ALL.into_iter();
        all.find_map(|(format, word)| (word == extension).then_some(format))
    }

    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        let mut all = Self::ALL.into_iter();
        all.find_map(|(format, word)| (format == self).then_some(word))
            .unwrap_or_default()
    }

    /// As the format of a document.
    pub(super) fn of_document(self) -> Option<OutputFormat> {
        match self {
            Self::Obj => Some(OutputFormat::Obj),
            Self::Glb => Some(OutputFormat::Glb),
            Self::Gltf => Some(OutputFormat::Gltf),
            _ => None,
        }
    }

    /// Refuses what bodies that are no surfaces in a cage are not written as.
    pub(super) fn check_for_body(self) -> Result<(), PipelineError> {
        match self {
            Self::Glb | Self::Gltf => Err(PipelineError::InvalidOptions(
                "format: without a cage the result is txt, obj, off, msh, mesh, tet or vtu".into(),
            )),
            _ => Ok(()),
        }
    }

    /// The file of a deformed body: `elements` with the positions `x`, `dim` coordinates each.
    pub(super) fn write(self, elements: &Elements, dim: usize, x: &[f64]) -> Vec<u8> {
        let format = ElementFormat::of_name(&format!(".{}", self.extension()));
        let text = match (format, dim) {
            (None, 2) => text_positions::<2>(x.as_chunks().0),
            (None, _) => text_positions::<3>(x.as_chunks().0),
            (Some(format), _) => {
                let place = |p: &[f64]| [p[0], p[1], p.get(2).copied().unwrap_or(0.0)];
                format.write(&Elements {
                    vertices: x.chunks_exact(dim).map(place).collect(),
                    ..elements.clone()
                })
            }
        };
        text.into_bytes()
    }
}

/// The mesh of a file, or of the outline in a picture or drawing, that is filled with about so many triangles.
pub(super) fn read(
    upload: &Upload,
    triangles: usize,
    limits: &Limits,
) -> Result<Elements, PipelineError> {
    let elements = match upload.extension().as_str() {
        "svg" => {
            limits.check_count(triangles)?;
            let text = String::from_utf8_lossy(&upload.bytes);
            filled(&outline::of_svg(&text, &SvgSettings::default())?, triangles)?
        }
        "png" => {
            limits.check_count(triangles)?;
            let image = Image::decode(&upload.bytes)?;
            filled(
                &outline::of_image(&image, &ImageSettings::default())?,
                triangles,
            )?
        }
        _ => match ElementFormat::of_name(&upload.name) {
            Some(format) => format.read(&upload.bytes)?,
            None => surface(upload)?,
        },
    };
    limits.check_count(elements.triangles.len() + elements.tets.len())?;
    Ok(elements)
}

fn filled(outline: &outline::Outline, triangles: usize) -> Result<Elements, PipelineError> {
    let settings = MeshSettings {
        resolution: Resolution::Triangles(triangles),
        ..MeshSettings::default()
    };
    Ok(Elements::from(&outline::triangulate(outline, &settings)?))
}

/// All triangles of a document, welded by position.
fn surface(upload: &Upload) -> Result<Elements, PipelineError> {
    let document = Document::read(upload)?;
    let groups = document.groups(GroupBy::Scene);
    let merged = groups.first().ok_or(PipelineError::NoTriangles)?;
    let merged = Merged::new(document.primitives(), merged);
    let surface = Surface::new(&merged.positions, &merged.triangles)?;
    Ok(Elements {
        vertices: surface.positions,
        triangles: surface.triangles,
        tets: Vec::new(),
    })
}

/// The body that a mesh is: its tetrahedra, or else its triangles, which must lie in a plane.
pub(super) fn body(elements: &Elements) -> Result<Body, PipelineError> {
    Ok(if elements.tets.is_empty() {
        Body::from(&elements.clone().into_planar_mesh()?)
    } else {
        Body::from(&elements.clone().into_tet_mesh()?)
    })
}

//! Formats of meshes to deform.

use super::elements::Elements;
use super::{Format, ReadError, gmsh, medit, obj, off, tet, vtu};

/// Formats in which meshes to deform are read and written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElementFormat {
    /// Gmsh `.msh`.
    Gmsh,
    /// Medit `.mesh`.
    Medit,
    /// `.tet`: counts, positions, corners.
    Tet,
    /// Wavefront OBJ: triangles only.
    Obj,
    /// Geomview OFF: triangles only.
    Off,
    /// VTK XML `.vtu`: written, not read.
    Vtu,
}

impl ElementFormat {
    /// Returns the format for the extension of a file's name.
    pub fn of_name(name: &str) -> Option<Self> {
        Format::of_name(name).and_then(Self::of)
    }

    /// Converts a general format; `None` if it is not one of these.
    pub fn of(format: Format) -> Option<Self> {
        Some(match format {
            Format::Msh => Self::Gmsh,
            Format::Mesh => Self::Medit,
            Format::Tet => Self::Tet,
            Format::Obj => Self::Obj,
            Format::Off => Self::Off,
            Format::Vtu => Self::Vtu,
            _ => return None,
        })
    }

    /// Reads a file; `.vtu` is not read.
    pub fn read(self, bytes: &[u8]) -> Result<Elements, ReadError> {
        let triangles = |mesh: super::IndexedTriangles<f64>| Elements {
            vertices: mesh.positions,
            triangles: mesh.triangles,
            tets: Vec::new(),
        };
        match self {
            Self::Gmsh => gmsh::read(bytes),
            Self::Medit => medit::read(bytes),
            Self::Tet => tet::read(bytes),
            Self::Obj => obj::read_as(bytes).map(|obj| triangles(obj.mesh)),
            Self::Off => off::read_as(bytes).map(triangles),
            Self::Vtu => Err(ReadError::Malformed {
                format: "VTU",
                place: "byte",
                at: 0,
                cause: "this format can be written but not read",
            }),
        }
    }

    /// Returns the text of a file. Numbers are the shortest that read back as the same `f64`. OBJ and OFF hold only the
    /// [surface](Elements::surface).
    pub fn write(self, elements: &Elements) -> String {
        match self {
            Self::Gmsh => gmsh::write(elements),
            Self::Medit => medit::write(elements),
            Self::Tet => tet::write(elements),
            Self::Obj => obj::write(elements),
            Self::Off => off::write(elements),
            Self::Vtu => vtu::write(elements, &[]),
        }
    }
}

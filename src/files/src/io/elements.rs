//! Elements of meshes to deform, as in their files.

use super::ReadError;
use std::borrow::Cow;
use std::fmt::Write;
use unwrapd_maps::mesh::{ElementError, PlanarMesh, TetMesh, boundary_triangles};

/// Vertices, triangles and tetrahedra of one file, in the file's order; every index is in range, every coordinate finite.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Elements {
    /// Vertex positions; z is 0 where the file has none.
    pub vertices: Vec<[f64; 3]>,
    /// Three vertex indices for each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Four vertex indices for each tetrahedron.
    pub tets: Vec<[u32; 4]>,
}

impl Elements {
    /// Converts to checked tetrahedra; triangles besides them, which some files contain as boundaries, are left out.
    pub fn into_tet_mesh(self) -> Result<TetMesh, ElementError> {
        TetMesh::new(self.vertices, self.tets)
    }

    /// Converts to the checked triangles of a planar mesh.
    pub fn into_planar_mesh(self) -> Result<PlanarMesh, ElementError> {
        PlanarMesh::flat(&self.vertices, self.triangles)
    }

    /// Returns the triangles or, if there are none, those that bound the tetrahedra.
    pub fn surface(&self) -> Cow<'_, [[u32; 3]]> {
        if self.triangles.is_empty() {
            Cow::Owned(boundary_triangles(&self.tets))
        } else {
            Cow::Borrowed(&self.triangles)
        }
    }
}

impl From<&TetMesh> for Elements {
    fn from(mesh: &TetMesh) -> Self {
        Self {
            vertices: mesh.vertices().to_vec(),
            triangles: Vec::new(),
            tets: mesh.tets().to_vec(),
        }
    }
}

impl From<&PlanarMesh> for Elements {
    fn from(mesh: &PlanarMesh) -> Self {
        Self {
            vertices: mesh.vertices().iter().map(|p| [p[0], p[1], 0.0]).collect(),
            triangles: mesh.triangles().to_vec(),
            tets: Vec::new(),
        }
    }
}

/// Writes one vertex per line with 17 significant digits, enough for any reader to get the same `f64`.
pub fn text_positions<const D: usize>(vertices: &[[f64; D]]) -> String {
    let mut text = String::new();
    for vertex in vertices {
        for (k, x) in vertex.iter().enumerate() {
            let blank = if k == 0 { "" } else { " " };
            let _ = write!(text, "{blank}{x:.16e}"); // writing to a string cannot fail
        }
        text.push('\n');
    }
    text
}

/// Appends a corner list after checking its indices, which count from `first` in the file.
pub(super) fn push_element<const N: usize>(
    elements: &mut Vec<[u32; N]>,
    indices: [i64; N],
    first: i64,
    n_vertices: usize,
) -> Result<(), ReadError> {
    let mut corners = [0; N];
    for (corner, index) in corners.iter_mut().zip(indices) {
        let index = index.saturating_sub(first);
        *corner = u32::try_from(index)
            .ok()
            .filter(|&v| (v as usize) < n_vertices)
            .ok_or(ReadError::IndexOutOfRange { index, n_vertices })?;
    }
    elements.push(corners);
    Ok(())
}

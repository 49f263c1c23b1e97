//! Triangle meshes of the plane.

use super::edges::{Edges, origin, same_direction};
use super::element_error::{ElementError, validate};
use unwrapd_method::numerics::predicates::orient2d_sign;

/// Triangles of positive area in the plane, no two on the same side of a common edge.
///
/// Other overlaps are not tested. Vertices that no triangle uses are kept, so that indices keep their meaning.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarMesh {
    vertices: Vec<[f64; 2]>,
    triangles: Vec<[u32; 3]>,
    reoriented: usize,
}

impl PlanarMesh {
    /// Checks the triangles and turns the clockwise ones around (by exchanging their last two corners).
    ///
    /// Refuses indices out of range, coordinates that are not finite, areas that are exactly zero, and folds. The signs
    /// are exact. Linear except for the logarithm of a vertex's degree.
    pub fn new(
        vertices: Vec<[f64; 2]>,
        mut triangles: Vec<[u32; 3]>,
    ) -> Result<Self, ElementError> {
        validate(&vertices, &triangles, "triangles")?;
        let mut reoriented = 0;
        for (element, triangle) in triangles.iter_mut().enumerate() {
            let [a, b, c] = triangle.map(|v| vertices[v as usize]);
            match orient2d_sign(a, b, c) {
                0 => return Err(ElementError::ZeroSize { element }),
                1 => {}
                _ => {
                    triangle.swap(1, 2);
                    reoriented += 1;
                }
            }
        }
        if let Some(elements) = fold(vertices.len(), &triangles) {
            return Err(ElementError::Folded { elements });
        }
        Ok(Self {
            vertices,
            triangles,
            reoriented,
        })
    }

    /// Creates the mesh from vertices that all have the same z, which is dropped.
    pub fn flat(vertices: &[[f64; 3]], triangles: Vec<[u32; 3]>) -> Result<Self, ElementError> {
        let plane = vertices.first().map_or(0.0, |p| p[2]);
        // NaN is no plane either, but has an error of its own.
        let off_plane = |p: &[f64; 3]| p[2].is_finite() && p[2] != plane;
        if let Some(vertex) = vertices.iter().position(off_plane) {
            let z = vertices[vertex][2];
            return Err(ElementError::NotPlanar { vertex, z, plane });
        }
        if let Some(vertex) = vertices.iter().position(|p| !p[2].is_finite()) {
            return Err(ElementError::NonFinitePosition { vertex });
        }
        let vertices = vertices.iter().map(|p| [p[0], p[1]]).collect();
        Self::new(vertices, triangles)
    }

    /// Returns the vertex positions.
    pub fn vertices(&self) -> &[[f64; 2]] {
        &self.vertices
    }

    /// Returns the corners of each triangle, counter-clockwise (x right, y up).
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Returns the number of triangles that were clockwise in the input.
    pub fn reoriented(&self) -> usize {
        self.reoriented
    }

    /// Returns the edges of one triangle only, with the triangle on their left, in the order of the triangles.
    pub fn boundary(&self) -> Vec<[u32; 2]> {
        boundary_edges(self.vertices.len(), &self.triangles)
    }
}

/// Returns the edges of one triangle only, wound like it, in the order of the triangles.
pub fn boundary_edges(n_vertices: usize, triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let edges = Edges::new(n_vertices, triangles);
    let mut alone: Vec<u32> = edges
        .iter()
        .filter(|halfedges| halfedges.len() == 1)
        .map(|halfedges| halfedges[0])
        .collect();
    alone.sort_unstable();
    let ends = |h: u32| [h, super::edges::next(h)].map(|h| origin(triangles, h));
    alone.into_iter().map(ends).collect()
}

/// Returns the first two counter-clockwise triangles that run along an edge in the same direction.
fn fold(n_vertices: usize, triangles: &[[u32; 3]]) -> Option<[usize; 2]> {
    let edges = Edges::new(n_vertices, triangles);
    edges.iter().find_map(|halfedges| {
        halfedges.iter().enumerate().find_map(|(k, &h)| {
            let before = halfedges[..k]
                .iter()
                .find(|&&other| same_direction(triangles, other, h))?;
            Some([*before, h].map(|h| h as usize / 3))
        })
    })
}

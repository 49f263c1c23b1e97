//! Tetrahedral meshes.

use super::edges::{Edges, origin, same_direction};
use unwrapd_method::numerics::predicates::{orient2d_sign, orient3d_sign};

/// Faces of a positive tetrahedron by its corners, wound so that their normals point outwards; face k lies opposite
/// corner k.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Tetrahedra of positive volume, no two on the same side of a common face.
///
/// Other overlaps are not tested. Vertices that no tetrahedron uses are kept, so that indices keep their meaning.
#[derive(Clone, Debug, PartialEq)]
pub struct TetMesh {
    vertices: Vec<[f64; 3]>,
    tets: Vec<[u32; 4]>,
    reoriented: usize,
}

impl TetMesh {
    /// Checks the elements and turns those of negative volume around (by exchanging their last two corners).
    ///
    /// Refuses indices out of range, coordinates that are not finite, volumes that are exactly zero, and folds. The
    /// signs are exact. Costs a sort of the faces.
    pub fn new(vertices: Vec<[f64; 3]>, mut tets: Vec<[u32; 4]>) -> Result<Self, ElementError> {
        validate(&vertices, &tets, "tetrahedra")?;
        let mut reoriented = 0;
        for (element, tet) in tets.iter_mut().enumerate() {
            let [a, b, c, d] = tet.map(|v| vertices[v as usize]);
            match orient3d_sign(a, b, c, d) {
                0 => return Err(ElementError::ZeroSize { element }),
                1 => {}
                _ => {
                    tet.swap(2, 3);
                    reoriented += 1;
                }
            }
        }
        let faces = sorted_faces(&tets);
        if let Some(pair) = faces.windows(2).find(|w| w[0].key() == w[1].key()) {
            let elements = [pair[0].id / 4, pair[1].id / 4].map(|element| element as usize);
            return Err(ElementError::Folded { elements });
        }
        Ok(Self {
            vertices,
            tets,
            reoriented,
        })
    }

    /// Returns the vertex positions.
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// Returns the corners a, b, c, d of each element, det[b−a, c−a, d−a] > 0.
    pub fn tets(&self) -> &[[u32; 4]] {
        &self.tets
    }

    /// Returns the number of elements that were inverted in the input.
    pub fn reoriented(&self) -> usize {
        self.reoriented
    }

    /// Returns the faces that belong to one element only, with outward normals, in the order of the elements.
    pub fn boundary(&self) -> Vec<[u32; 3]> {
        boundary_triangles(&self.tets)
    }
}

/// Returns the triangles that bound tetrahedra of positive volume: faces of one element only, with outward normals, in
/// the order of the elements.
pub fn boundary_triangles(tets: &[[u32; 4]]) -> Vec<[u32; 3]> {
    let faces = sorted_faces(tets);
    let mut boundary: Vec<u32> = faces
        .chunk_by(|a, b| a.corners == b.corners)
        .filter(|same| same.len() == 1)
        .map(|same| same[0].id)
        .collect();
    boundary.sort_unstable();
    boundary.into_iter().map(|f| corners(tets, f)).collect()
}

/// A face of an element: `id` / 4 is the element, `id` % 4 the corner opposite.
struct Face {
    /// Corners in increasing order.
    corners: [u32; 3],
    /// `true` if increasing order is an odd permutation of the outward winding.
    odd: bool,
    id: u32,
}

impl Face {
    fn key(&self) -> ([u32; 3], bool) {
        (self.corners, self.odd)
    }
}

fn corners(tets: &[[u32; 4]], id: u32) -> [u32; 3] {
    let tet = tets[id as usize / 4];
    FACES[id as usize % 4].map(|c| tet[c])
}

/// Returns all faces, those with the same corners next to each other, and among them those of the same winding.
fn sorted_faces(tets: &[[u32; 4]]) -> Vec<Face> {
    let mut faces: Vec<Face> = (0..4 * tets.len() as u32)
        .map(|id| {
            let mut ascending = corners(tets, id);
            let mut odd = false;
            for (i, j) in [(0, 1), (1, 2), (0, 1)] {
                if ascending[i] > ascending[j] {
                    ascending.swap(i, j);
                    odd = !odd;
                }
            }
            Face {
                corners: ascending,
                odd,
                id,
            }
        })
        .collect();
    faces.sort_unstable_by_key(|f| (f.key(), f.id));
    faces
}

// Triangle meshes of the plane.

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
        if let Some(vertex) = vertices
            .iter()
            .position(|p: &[f64; 3]| p[2].is_finite() && p[2] != plane)
        {
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
    alone
        .into_iter()
        .map(|h: u32| [h, super::edges::next(h)].map(|h| origin(triangles, h)))
        .collect()
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

// Errors of rest shapes.

/// Reason why triangles or tetrahedra cannot be deformed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ElementError {
    /// There is nothing to deform.
    #[error("the mesh has no {0}")]
    Empty(&'static str),
    /// More elements or vertices than 32-bit indices can count.
    #[error("too many elements or vertices for 32-bit indices")]
    TooLarge,
    /// An element names a vertex that does not exist.
    #[error("element {element} names vertex {vertex}, but there are only {n_vertices} vertices")]
    IndexOutOfRange {
        /// First such element, from 0.
        element: usize,
        /// Vertex that it names.
        vertex: u32,
        /// Number of vertices.
        n_vertices: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NonFinitePosition {
        /// First such vertex, from 0.
        vertex: usize,
    },
    /// The area or volume is exactly zero.
    #[error("element {element} has zero area or volume")]
    ZeroSize {
        /// First such element, from 0.
        element: usize,
    },
    /// Two elements lie on the same side of a common edge or face.
    #[error(
        "the mesh is folded: elements {elements:?} lie on the same side of their common face or edge"
    )]
    Folded {
        /// Indices of the two elements, from 0.
        elements: [usize; 2],
    },
    /// A mesh of the plane is not flat.
    #[error(
        "the mesh has no tetrahedra and is not planar: vertex {vertex} has z = {z}, the first one {plane}"
    )]
    NotPlanar {
        /// First such vertex, from 0.
        vertex: usize,
        /// Its z coordinate.
        z: f64,
        /// z coordinate of the first vertex.
        plane: f64,
    },
}

impl ElementError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Empty(_) => "no_elements",
            Self::TooLarge => "limit_exceeded",
            Self::IndexOutOfRange { .. } => "index_out_of_range",
            Self::NonFinitePosition { .. } => "non_finite_position",
            Self::ZeroSize { .. } => "zero_size_element",
            Self::Folded { .. } => "folded_mesh",
            Self::NotPlanar { .. } => "not_planar",
        }
    }
}

/// Checks the common requirements of triangles of the plane and tetrahedra: there are elements, and their vertices
/// exist and are finite.
pub fn validate<const D: usize, const N: usize>(
    vertices: &[[f64; D]],
    elements: &[[u32; N]],
    noun: &'static str,
) -> Result<(), ElementError> {
    if elements.is_empty() {
        return Err(ElementError::Empty(noun));
    }
    if vertices.len().max(N * elements.len()) >= u32::MAX as usize {
        return Err(ElementError::TooLarge);
    }
    if let Some(vertex) = vertices
        .iter()
        .position(|p: &[f64; D]| p.iter().any(|x| !x.is_finite()))
    {
        return Err(ElementError::NonFinitePosition { vertex });
    }
    for (element, corners) in elements.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices.len()) {
            return Err(ElementError::IndexOutOfRange {
                element,
                vertex,
                n_vertices: vertices.len(),
            });
        }
    }
    Ok(())
}

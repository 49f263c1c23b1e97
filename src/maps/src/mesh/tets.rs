//! Tetrahedral meshes.

use super::element_error::{ElementError, validate};
use unwrapd_method::numerics::predicates::orient3d_sign;

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

//! A triangle surface with one vertex per position.

use super::{Adjacency, CUT, Defects, edges::Edges, same_direction, weld::weld};

/// Triangles over distinct positions, with their defects counted.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Distinct positions, in the order of their first occurrence in the input. Vertices that no triangle uses are kept
    /// until the surface is [reordered](Self::reordered).
    pub positions: Vec<[f64; 3]>,
    /// Three different vertices each, wound as in the input.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle its face in the input; increasing until the surface is reordered.
    pub faces: Vec<u32>,
    /// Defects of the input's faces.
    pub defects: Defects,
    adjacency: Adjacency,
    is_cut: bool,
}

/// Reason why a list of triangles is not a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are only {n_vertices} vertices")]
    IndexOutOfRange {
        /// First such face.
        face: usize,
        /// Vertex that it names.
        vertex: u32,
        /// Number of vertices.
        n_vertices: usize,
    },
    /// A face's vertex has a coordinate that is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NonFinitePosition {
        /// First such vertex.
        vertex: u32,
    },
    /// More faces or vertices than 32-bit corner indices can count.
    #[error("too many faces or vertices for 32-bit indices")]
    TooLarge,
}

impl Surface {
    /// Creates the surface of an indexed triangle list: vertices at equal positions (bit-equal, −0 = 0) become one, and
    /// faces that name a position twice are left out.
    ///
    /// Everything else is kept, however broken; [`defects`](Self::defects) counts it. Vertices that no face names may
    /// hold anything, also NaN. Coordinates are `f32` or `f64`. Nearly linear in the size of the input.
    pub fn new<T: Copy + Into<f64>>(
        positions: &[[T; 3]],
        triangles: &[[u32; 3]],
    ) -> Result<Self, MeshError> {
        if positions.len() >= u32::MAX as usize || triangles.len() >= u32::MAX as usize / 3 {
            return Err(MeshError::TooLarge);
        }
        validate(positions, triangles)?;
        // Weld the vertices; keep the faces with three different ones.
        let (distinct, vertex_of) = weld(positions.iter().map(|p| p.map(Into::into)));
        let mut kept = Vec::with_capacity(triangles.len());
        let mut faces = Vec::with_capacity(triangles.len());
        for (face, triangle) in triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(|v| vertex_of[v as usize]);
            if a != b && b != c && c != a {
                kept.push([a, b, c]);
                faces.push(face as u32);
            }
        }
        // Glue the faces and count the defects.
        let edges = Edges::new(distinct.len(), &kept);
        let adjacency = Adjacency::new(&distinct, &kept, &edges);
        let mut defects = Defects::of_triangles(&distinct, &kept, &edges, &adjacency);
        defects.count_input(positions.len(), triangles, distinct.len(), kept.len());
        Ok(Self {
            positions: distinct,
            triangles: kept,
            faces,
            defects,
            adjacency,
            is_cut: false,
        })
    }

    /// Cuts the surface along the edges for which `is_seam` returns `true`, called with the two halfedges that are
    /// glued there: no chart extends across them.
    pub fn cut_along(&mut self, is_seam: impl Fn(u32, u32) -> bool) {
        self.adjacency.cut(&self.triangles, is_seam);
        self.is_cut = true;
    }

    /// Cuts the surface along the edges at which its winding changes, so that each piece has one front. A chart across
    /// such an edge would show a texture mirrored on one side of it.
    pub fn cut_where_winding_changes(&mut self) {
        let triangles = &self.triangles;
        let is_change = |h: u32, t: u32| same_direction(triangles, h, t);
        let twin = &self.adjacency.twin;
        let mut glued = (0..).zip(twin).filter(|(_, t)| **t != CUT);
        if glued.any(|(h, &t)| is_change(h, t)) {
            self.adjacency.cut(triangles, is_change);
        }
    }

    /// Returns whether it was cut along given edges.
    pub fn is_cut(&self) -> bool {
        self.is_cut
    }

    /// Permutes the triangles by `order`, in which each occurs once, and renumbers vertices by their first use.
    #[must_use]
    pub fn reordered(&self, order: &[u32]) -> Self {
        let mut number = vec![u32::MAX; self.positions.len()];
        let mut positions = Vec::with_capacity(self.positions.len());
        let mut numbered = |v: u32| {
            if number[v as usize] == u32::MAX {
                number[v as usize] = positions.len() as u32;
                positions.push(self.positions[v as usize]);
            }
            number[v as usize]
        };
        let triangles = order
            .iter()
            .map(|&t| self.triangles[t as usize].map(&mut numbered));
        Self {
            triangles: triangles.collect(),
            faces: order.iter().map(|&t| self.faces[t as usize]).collect(),
            positions,
            defects: self.defects,
            adjacency: self.adjacency.reordered(order),
            is_cut: self.is_cut,
        }
    }

    /// Returns the gluing of triangles.
    pub fn adjacency(&self) -> &Adjacency {
        &self.adjacency
    }

    /// Returns the positions of a triangle's corners.
    pub fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.triangles[triangle].map(|v| self.positions[v as usize])
    }
}

fn validate<T: Copy + Into<f64>>(
    positions: &[[T; 3]],
    triangles: &[[u32; 3]],
) -> Result<(), MeshError> {
    for (face, triangle) in triangles.iter().enumerate() {
        for &vertex in triangle {
            let Some(position) = positions.get(vertex as usize) else {
                return Err(MeshError::IndexOutOfRange {
                    face,
                    vertex,
                    n_vertices: positions.len(),
                });
            };
            if !position.iter().all(|&x| x.into().is_finite()) {
                return Err(MeshError::NonFinitePosition { vertex });
            }
        }
    }
    Ok(())
}

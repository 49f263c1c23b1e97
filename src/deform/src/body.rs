//! Bodies to deform.

use super::problem_error::ProblemError;
use unwrapd_maps::mesh::{ElementError, PlanarMesh, TetMesh, validate};
use unwrapd_method::energy::{RestShape, voronoi_areas};
use unwrapd_method::numerics::square::Square;
use unwrapd_method::numerics::vec2::{doubled_area, sub};
use unwrapd_method::numerics::vec3;

/// A body in the plane or in space: rest positions and elements with their rest shapes.
#[derive(Clone, Debug)]
pub struct Body {
    /// Rest positions, coordinates one after another.
    pub rest: Vec<f64>,
    /// Elements of the body.
    pub elements: BodyElements,
}

/// Elements of one kind; the size and the weight of a rest shape are its true area or volume.
#[derive(Clone, Debug)]
pub enum BodyElements {
    /// Triangles of the plane.
    Triangles {
        /// Three vertices per triangle.
        corners: Vec<[u32; 3]>,
        /// One rest shape per triangle.
        rest: Vec<RestShape<2>>,
    },
    /// Tetrahedra of space.
    Tetrahedra {
        /// Four vertices per tetrahedron.
        corners: Vec<[u32; 4]>,
        /// One rest shape per tetrahedron.
        rest: Vec<RestShape<3>>,
    },
}

impl From<&PlanarMesh> for Body {
    fn from(mesh: &PlanarMesh) -> Self {
        Self::planar(mesh.vertices(), mesh.triangles())
    }
}

impl From<&TetMesh> for Body {
    fn from(mesh: &TetMesh) -> Self {
        let corners = |t: &[u32; 4]| t.map(|v| mesh.vertices()[v as usize]);
        let shapes = mesh
            .tets()
            .iter()
            .map(|t| RestShape::from_tetrahedron(corners(t)));
        Self {
            rest: mesh.vertices().as_flattened().to_vec(),
            elements: BodyElements::Tetrahedra {
                rest: shapes.collect(),
                corners: mesh.tets().to_vec(),
            },
        }
    }
}

impl Body {
    /// Creates a body of counter-clockwise triangles of the plane.
    pub(super) fn planar(vertices: &[[f64; 2]], triangles: &[[u32; 3]]) -> Self {
        let shape = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| vertices[v as usize]);
            RestShape::from_edges(sub(b, a), sub(c, a))
        };
        Self {
            rest: vertices.as_flattened().to_vec(),
            elements: BodyElements::Triangles {
                rest: triangles.iter().map(shape).collect(),
                corners: triangles.to_vec(),
            },
        }
    }

    /// Creates a body from a surface whose triangles are laid flat one by one; its rest positions are the first two
    /// coordinates.
    ///
    /// # Errors
    /// For indices out of range, coordinates that are not finite, and triangles without area.
    pub fn flattened(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Self, ElementError> {
        validate(vertices, triangles, "triangles")?;
        let corners = |t: &[u32; 3]| t.map(|v| vertices[v as usize]);
        let is_empty = |t: &[u32; 3]| {
            let [a, b, c] = corners(t);
            vec3::norm(vec3::area_vector(a, b, c)) == 0.0
        };
        if let Some(element) = triangles.iter().position(is_empty) {
            return Err(ElementError::ZeroSize { element });
        }
        let shapes = triangles
            .iter()
            .map(|t| RestShape::from_corners(corners(t)));
        Ok(Self {
            rest: vertices.iter().flat_map(|p| [p[0], p[1]]).collect(),
            elements: BodyElements::Triangles {
                rest: shapes.collect(),
                corners: triangles.to_vec(),
            },
        })
    }

    /// Returns the number of coordinates per vertex.
    pub fn dim(&self) -> usize {
        match self.elements {
            BodyElements::Triangles { .. } => 2,
            BodyElements::Tetrahedra { .. } => 3,
        }
    }

    /// Returns the number of vertices.
    pub fn n_vertices(&self) -> usize {
        self.rest.len() / self.dim()
    }

    /// Checks the number of coordinates of `x` against that of the body.
    pub fn check(&self, x: &[f64]) -> Result<(), ProblemError> {
        let (found, expected) = (x.len(), self.rest.len());
        if found == expected {
            Ok(())
        } else {
            Err(ProblemError::WrongStart { found, expected })
        }
    }

    /// Returns the vertices of each element.
    pub fn corners(&self) -> Vec<&[u32]> {
        match &self.elements {
            BodyElements::Triangles { corners, .. } => {
                corners.iter().map(<[u32; 3]>::as_slice).collect()
            }
            BodyElements::Tetrahedra { corners, .. } => {
                corners.iter().map(<[u32; 4]>::as_slice).collect()
            }
        }
    }

    /// Returns the determinant of each element's edges: twice its area or six times its volume.
    pub fn determinants(&self) -> Vec<f64> {
        match &self.elements {
            BodyElements::Triangles { rest, .. } => {
                rest.iter().map(|shape| 2.0 * shape.size).collect()
            }
            BodyElements::Tetrahedra { rest, .. } => {
                rest.iter().map(|shape| 6.0 * shape.size).collect()
            }
        }
    }

    /// Returns the determinant of each element's edges with the vertices at `x`: not positive if it is inverted or
    /// degenerate.
    pub fn determinants_at(&self, x: &[f64]) -> Vec<f64> {
        match &self.elements {
            BodyElements::Triangles { corners, .. } => {
                let points: &[[f64; 2]] = x.as_chunks().0;
                let det = |t: &[u32; 3]| {
                    let [a, b, c] = t.map(|v| points[v as usize]);
                    doubled_area(a, b, c)
                };
                corners.iter().map(det).collect()
            }
            BodyElements::Tetrahedra { corners, .. } => {
                let points: &[[f64; 3]] = x.as_chunks().0;
                let det = |t: &[u32; 4]| {
                    let [a, b, c, d] = t.map(|v| points[v as usize]);
                    [b, c, d].map(|p| vec3::sub(p, a)).det()
                };
                corners.iter().map(det).collect()
            }
        }
    }

    /// Returns lumped masses: hybrid Voronoi areas in the plane, a quarter of the volume per corner in space.
    pub fn masses(&self) -> Vec<f64> {
        match &self.elements {
            BodyElements::Triangles { corners, .. } => {
                voronoi_areas(self.n_vertices(), corners, self.rest.as_chunks().0)
            }
            BodyElements::Tetrahedra { corners, rest } => {
                let mut masses = vec![0.0; self.n_vertices()];
                for (tet, shape) in corners.iter().zip(rest) {
                    for &v in tet {
                        masses[v as usize] += 0.25 * shape.size;
                    }
                }
                masses
            }
        }
    }

    /// Groups the vertices of `chosen` by the elements' edges between them; returns the group number of each.
    pub fn groups(&self, chosen: &[u32]) -> Vec<u32> {
        let mut group = vec![u32::MAX; self.n_vertices()];
        for (i, &v) in chosen.iter().enumerate() {
            group[v as usize] = i as u32;
        }
        let is_chosen = |v: &&u32| group[**v as usize] != u32::MAX;
        let mut corners = self.corners();
        corners.retain(|element| element.iter().filter(is_chosen).count() >= 2);
        let mut changed = true;
        while changed {
            changed = false;
            for element in &corners {
                let members = element.iter().map(|&v| group[v as usize]);
                let Some(least) = members.filter(|&g| g != u32::MAX).min() else {
                    continue;
                };
                for &v in *element {
                    let own = &mut group[v as usize];
                    if *own != u32::MAX && *own > least {
                        *own = least;
                        changed = true;
                    }
                }
            }
        }
        chosen.iter().map(|&v| group[v as usize]).collect()
    }
}

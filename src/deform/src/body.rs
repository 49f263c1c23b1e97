//! Bodies to deform.

use super::problem_error::ProblemError;
use serde::{Deserialize, Serialize};
use unwrapd_maps::mesh::{
    ElementError, PlanarMesh, TetMesh, UsedVertices, boundary_edges, boundary_triangles, validate,
};
use unwrapd_method::energy::{RestShape, Row, voronoi_areas};
use unwrapd_method::numerics::principal_axes::PrincipalAxes;
use unwrapd_method::numerics::square::{Matrix, Square, apply, transposed};
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
        Self {
            rest: vertices.as_flattened().to_vec(),
            elements: BodyElements::Triangles {
                rest: triangles
                    .iter()
                    .map(|t: &[u32; 3]| {
                        let [a, b, c] = t.map(|v| vertices[v as usize]);
                        RestShape::from_edges(sub(b, a), sub(c, a))
                    })
                    .collect(),
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
                corners
                    .iter()
                    .map(|t: &[u32; 3]| {
                        let [a, b, c] = t.map(|v| points[v as usize]);
                        doubled_area(a, b, c)
                    })
                    .collect()
            }
            BodyElements::Tetrahedra { corners, .. } => {
                let points: &[[f64; 3]] = x.as_chunks().0;
                corners
                    .iter()
                    .map(|t: &[u32; 4]| {
                        let [a, b, c, d] = t.map(|v| points[v as usize]);
                        [b, c, d].map(|p| vec3::sub(p, a)).det()
                    })
                    .collect()
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
        let mut corners = self.corners();
        corners.retain(|element| {
            element
                .iter()
                .filter(|v: &&u32| group[**v as usize] != u32::MAX)
                .count()
                >= 2
        });
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

impl BodyElements {
    /// Returns the vertices of the boundary of elements over `n_vertices` vertices, most of them several times.
    pub(super) fn boundary_vertices(&self, n_vertices: usize) -> Vec<u32> {
        match self {
            Self::Triangles { corners, .. } => boundary_edges(n_vertices, corners).into_flattened(),
            Self::Tetrahedra { corners, .. } => boundary_triangles(corners).into_flattened(),
        }
    }
}

// Axes about which paths are bent.

/// Returns the axis of the plane, or the principal axes of a body of space, that of its least extent first: they turn
/// with the body.
pub(super) fn axes(body: &Body) -> Vec<[f64; 3]> {
    if body.dim() == 2 {
        return vec![[0.0, 0.0, 1.0]];
    }
    let places: &[[f64; 3]] = body.rest.as_chunks().0;
    let [long, middle, short] = PrincipalAxes::of(places.iter().copied()).axes;
    vec![short, middle, long]
}

// Treatment of the boundary of a map of the plane.

/// Treatment of the boundary of a map of the plane while handles pull it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum Boundary {
    /// The boundary is free.
    #[default]
    Free,
    /// The boundary stays fixed. A map without overlaps stays without overlaps.
    Fixed,
}

impl Boundary {
    /// Returns the vertices of `triangles` that stay fixed, in increasing order.
    pub(super) fn held(self, n_vertices: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
        if self == Self::Free {
            return Vec::new();
        }
        let edges = boundary_edges(n_vertices, triangles);
        UsedVertices::new(edges.into_iter().flatten()).into_vec()
    }
}

// Point location: the element that contains a point.

/// Share of an element by which points on an edge between two elements may lie outside both.
const ROUNDING: f64 = 1e-9;

/// Finds the element at rest that contains a point and returns the point's barycentric coordinates; the first if there
/// are several.
pub(super) fn locate<const D: usize>(body: &Body, at: [f64; D]) -> Option<Row>
where
    Matrix<D>: Square<D>,
{
    let place = |v: u32| -> [f64; D] { std::array::from_fn(|k| body.rest[D * v as usize + k]) };
    for element in body.corners() {
        let origin = place(element[0]);
        let edges: Matrix<D> = std::array::from_fn(|k| {
            let corner = place(element[k + 1]);
            std::array::from_fn(|c| corner[c] - origin[c])
        });
        let arm: [f64; D] = std::array::from_fn(|k| at[k] - origin[k]);
        if !is_within_reach(&edges, &arm) {
            continue;
        }
        let inverse = transposed(&edges.inverse(edges.det()));
        let others = apply(&inverse, &arm);
        let first = 1.0 - others.iter().sum::<f64>();
        if first >= -ROUNDING && others.iter().all(|&w| w >= -ROUNDING) {
            let weights = std::iter::once(first).chain(others);
            let mut row: Row = element.iter().copied().zip(weights).collect();
            row.sort_unstable_by_key(|&(v, _)| v);
            return Some(row);
        }
    }
    None
}

/// Returns the vertex at which a point lies, if any.
pub(super) fn sole_vertex(row: &Row) -> Option<u32> {
    row.iter()
        .find(|&&(_, weight): &&(u32, f64)| weight >= 1.0 - ROUNDING)
        .map(|&(vertex, _)| vertex)
}

/// Returns whether the element's box, slightly enlarged, contains the point: a cheap test before the exact one.
fn is_within_reach<const D: usize>(edges: &Matrix<D>, arm: &[f64; D]) -> bool {
    (0..D).all(|k| {
        let along = edges.iter().map(|edge| edge[k]);
        let (low, high) = along.fold((0.0, 0.0), |(low, high): (f64, f64), x| {
            (low.min(x), high.max(x))
        });
        let margin = ROUNDING * D as f64 * (high - low);
        (low - margin..=high + margin).contains(&arm[k])
    })
}

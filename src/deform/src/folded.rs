//! Meshes that are folded themselves, and their untangling.
//!
//! A body has its rest shapes from a mesh without inversions. A folded mesh has none: some of its elements are inverted,
//! so their shapes say nothing. Their rest shapes are given by another mesh, implied by the elements that are positive,
//! or regular. Which side of an element is positive follows from its neighbors: all elements of a connected part are
//! wound alike, so that the signed size of the part is positive.

use super::body::{Body, BodyElements, Boundary};
use super::problem::{Model, Problem};
use super::problem_error::ProblemError;
use super::untangle::{StillFolded, bad_elements, untangled};
use super::winding::wind_alike;
use serde::{Deserialize, Serialize};
use unwrapd_files::io::Elements;
use unwrapd_maps::mesh::{ElementError, UsedVertices, validate};
use unwrapd_method::energy::RestShape;
use unwrapd_method::numerics::square::Square;
use unwrapd_method::numerics::vec2::{doubled_area, sub};
use unwrapd_method::numerics::vec3;
use unwrapd_method::solver::{Handles, Watch};

/// Rest shapes of the elements of a folded mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum RestOfFolded {
    /// The present shape of each element that is not inverted; the others are regular.
    #[default]
    Implied,
    /// All elements are regular and of the same size.
    Regular,
}

/// A mesh of the plane or of tetrahedra, some of whose elements may be inverted or empty.
#[derive(Clone, Debug)]
pub struct FoldedMesh {
    body: Body,
    turned: usize,
}

/// A mesh without inversions and the amount of change.
#[derive(Clone, Debug)]
pub struct Unfolded {
    /// Positions, coordinates one after another.
    pub x: Vec<f64>,
    /// Number of elements that were inverted or empty.
    pub inverted: usize,
    /// Number of vertices that moved.
    pub moved: usize,
    /// The smallest size of an element over its rest size.
    pub smallest: f64,
}

impl FoldedMesh {
    /// Reads a mesh of tetrahedra, or of triangles in the plane, and winds its elements alike. `given` has the rest
    /// shapes of the elements instead of `rest`, if present: a mesh of as many vertices.
    ///
    /// # Errors
    /// If the elements are invalid, not orientable, or have no size in total; or if `given` does not fit or is folded.
    pub fn new(
        mesh: &Elements,
        rest: RestOfFolded,
        given: Option<&Elements>,
    ) -> Result<Self, ProblemError> {
        if let Some(given) = given
            && given.vertices.len() != mesh.vertices.len()
        {
            return Err(ProblemError::WrongRest {
                found: given.vertices.len(),
                expected: mesh.vertices.len(),
            });
        }
        if mesh.tets.is_empty() {
            let vertices = planar(&mesh.vertices)?;
            let places = given.map(|given| planar(&given.vertices));
            let places = places.transpose()?;
            Self::of(
                &TRIANGLES,
                &vertices,
                &mesh.triangles,
                rest,
                places.as_deref(),
            )
        } else {
            let places = given.map(|given| &*given.vertices);
            Self::of(&TETRAHEDRA, &mesh.vertices, &mesh.tets, rest, places)
        }
    }

    fn of<const D: usize, const N: usize>(
        kind: &ElementKind<D, N>,
        vertices: &[[f64; D]],
        elements: &[[u32; N]],
        rest: RestOfFolded,
        given: Option<&[[f64; D]]>,
    ) -> Result<Self, ProblemError> {
        validate(vertices, elements, kind.noun)?;
        let places = given.unwrap_or(vertices);
        let corners = |element: &[u32; N]| element.map(|v| places[v as usize]);
        let present = |element: &[u32; N]| (kind.shape)(corners(element));
        let wound = Wound::new(elements, |element| (kind.size)(corners(element)))?;
        let shapes = match given {
            Some(_) => wound.given_shapes(present)?,
            None => wound.shapes(present, &(kind.shape)(kind.regular), rest),
        };
        Ok(Self {
            turned: wound.turned,
            body: Body {
                rest: vertices.as_flattened().to_vec(),
                elements: (kind.join)(wound.elements, shapes),
            },
        })
    }

    /// Returns the elements at the positions `x`, wound alike.
    pub fn elements_at(&self, x: &[f64]) -> Elements {
        let vertices = x.chunks_exact(self.body.dim());
        let vertices = vertices.map(|p| [p[0], p[1], p.get(2).copied().unwrap_or(0.0)]);
        let mut elements = Elements {
            vertices: vertices.collect(),
            ..Elements::default()
        };
        match &self.body.elements {
            BodyElements::Triangles { corners, .. } => elements.triangles.clone_from(corners),
            BodyElements::Tetrahedra { corners, .. } => elements.tets.clone_from(corners),
        }
        elements
    }

    /// Returns the number of coordinates of a position.
    pub fn dim(&self) -> usize {
        self.body.dim()
    }

    /// Returns the number of elements whose corners the file has in the opposite order of their neighbors'.
    pub fn turned(&self) -> usize {
        self.turned
    }

    /// Moves vertices until every element is positive, exactly; as few and as little as possible.
    ///
    /// # Errors
    /// If the fixed boundary contradicts every such map, if none is found, or if the watcher ends the work before.
    pub fn untangled(
        &self,
        boundary: Boundary,
        watch: &dyn Watch,
    ) -> Result<Unfolded, ProblemError> {
        let x = &self.body.rest;
        let bad = bad_elements(&self.body, x, 0.0);
        let Some(&element) = bad.first() else {
            return Ok(self.unfolded(x.clone(), 0));
        };
        let held = self.held(boundary);
        self.check_boundary(&held)?;
        match untangled(&self.body, x, &held, 0.0, watch) {
            Ok(moved) => Ok(self.unfolded(moved, bad.len())),
            Err(StillFolded::Stopped) => Err(ProblemError::EndedEarly),
            Err(StillFolded::Failed) => Err(ProblemError::InfeasibleStart {
                element,
                determinant: self.body.determinants_at(x)[element],
                epsilon: 0.0,
            }),
        }
    }

    /// Returns the vertices that stay, in increasing order.
    fn held(&self, boundary: Boundary) -> Vec<u32> {
        match boundary {
            Boundary::Free => Vec::new(),
            Boundary::Fixed => {
                let n_vertices = self.body.n_vertices();
                let vertices = self.body.elements.boundary_vertices(n_vertices);
                UsedVertices::new(vertices).into_vec()
            }
        }
    }

    /// Checks that vertices which stay leave room for a map without inversions.
    fn check_boundary(&self, held: &[u32]) -> Result<(), ProblemError> {
        let dim = self.body.dim();
        let places = held
            .iter()
            .map(|&v| &self.body.rest[dim * v as usize..][..dim]);
        let stay = Handles {
            vertices: held.to_vec(),
            targets: places.flatten().copied().collect(),
            groups: vec![0; held.len()],
            ..Handles::default()
        };
        let problem = Problem::at_rest(self.body.clone(), &Model::default())?;
        let problem = Problem {
            stations: vec![stay],
            ..problem
        };
        problem.check_targets()
    }

    fn unfolded(&self, x: Vec<f64>, inverted: usize) -> Unfolded {
        let dim = self.body.dim();
        let before = self.body.rest.chunks_exact(dim);
        let moved = before.zip(x.chunks_exact(dim)).filter(|(a, b)| a != b);
        let sizes = self.body.determinants_at(&x).into_iter();
        let ratios = sizes
            .zip(self.body.determinants())
            .map(|(now, rest)| now / rest);
        Unfolded {
            inverted,
            moved: moved.count(),
            smallest: ratios.fold(f64::INFINITY, f64::min),
            x,
        }
    }
}

/// Returns the first two coordinates of vertices with the same z.
fn planar(vertices: &[[f64; 3]]) -> Result<Vec<[f64; 2]>, ElementError> {
    let plane = vertices.first().map_or(0.0, |p| p[2]);
    match vertices.iter().position(|p| p[2] != plane) {
        Some(vertex) => Err(ElementError::NotPlanar {
            vertex,
            z: vertices[vertex][2],
            plane,
        }),
        None => Ok(vertices.iter().map(|p| [p[0], p[1]]).collect()),
    }
}

// Triangles and tetrahedra.

/// Elements with N corners in D dimensions.
struct ElementKind<const D: usize, const N: usize> {
    noun: &'static str,
    /// Signed size.
    size: fn([[f64; D]; N]) -> f64,
    shape: fn([[f64; D]; N]) -> RestShape<D>,
    /// Corners of a regular element, of any size.
    regular: [[f64; D]; N],
    join: fn(Vec<[u32; N]>, Vec<RestShape<D>>) -> BodyElements,
}

const TRIANGLES: ElementKind<2, 3> = ElementKind {
    noun: "triangles",
    size: |[a, b, c]| 0.5 * doubled_area(a, b, c),
    shape: |[a, b, c]| RestShape::from_edges(sub(b, a), sub(c, a)),
    regular: [[0.0, 0.0], [1.0, 0.0], [0.5, 0.866_025_403_784_438_6]],
    join: |corners, rest| BodyElements::Triangles { corners, rest },
};

const TETRAHEDRA: ElementKind<3, 4> = ElementKind {
    noun: "tetrahedra",
    size: |[a, b, c, d]| [b, c, d].map(|p| vec3::sub(p, a)).det() / 6.0,
    shape: RestShape::from_tetrahedron,
    // Four corners of a cube, no two of them adjacent.
    regular: [
        [0.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 1.0],
        [1.0, 0.0, 1.0],
    ],
    join: |corners, rest| BodyElements::Tetrahedra { corners, rest },
};

// Elements wound alike.

/// Elements wound alike, so that each connected part has a positive size in total.
struct Wound<const N: usize> {
    elements: Vec<[u32; N]>,
    /// Number of elements whose winding changed.
    turned: usize,
    /// Mean signed size of an element.
    mean: f64,
}

impl<const N: usize> Wound<N> {
    fn new(given: &[[u32; N]], size: impl Fn(&[u32; N]) -> f64) -> Result<Self, ProblemError> {
        let mut elements = given.to_vec();
        let part = wind_alike(&mut elements)?;
        // Turn the parts of negative size around.
        let n_parts = part.iter().max().map_or(0, |&last| last as usize + 1);
        let mut totals = vec![0.0; n_parts];
        for (element, &part) in elements.iter().zip(&part) {
            totals[part as usize] += size(element);
        }
        if let Some(empty) = totals.iter().position(|&total| total == 0.0) {
            let element = part.iter().position(|&part| part as usize == empty);
            let element = element.unwrap_or_default();
            return Err(ElementError::ZeroSize { element }.into());
        }
        for (element, &part) in elements.iter_mut().zip(&part) {
            if totals[part as usize] < 0.0 {
                element.swap(N - 2, N - 1);
            }
        }
        let total: f64 = totals.iter().map(|total| total.abs()).sum();
        Ok(Self {
            turned: elements.iter().zip(given).filter(|(a, b)| a != b).count(),
            mean: total / elements.len() as f64,
            elements,
        })
    }

    /// Returns the shapes that another mesh gives.
    fn given_shapes<const D: usize>(
        &self,
        shape: impl Fn(&[u32; N]) -> RestShape<D>,
    ) -> Result<Vec<RestShape<D>>, ProblemError> {
        let shapes: Vec<RestShape<D>> = self.elements.iter().map(shape).collect();
        match shapes.iter().position(|shape| !is_usable(shape)) {
            Some(element) => Err(ProblemError::InvertedRest { element }),
            None => Ok(shapes),
        }
    }

    /// Returns the `present` shapes of elements where `rest` takes them, and the regular one elsewhere.
    fn shapes<const D: usize>(
        &self,
        present: impl Fn(&[u32; N]) -> RestShape<D>,
        regular: &RestShape<D>,
        rest: RestOfFolded,
    ) -> Vec<RestShape<D>> {
        let regular = regular.in_unit((regular.size / self.mean).powf(1.0 / D as f64));
        let of = |element: &[u32; N]| {
            let present = present(element);
            if rest == RestOfFolded::Implied && is_usable(&present) {
                present
            } else {
                regular
            }
        };
        self.elements.iter().map(of).collect()
    }
}

/// Returns whether an element has a positive size and a shape that floating point can represent.
fn is_usable<const D: usize>(shape: &RestShape<D>) -> bool {
    shape.size > 0.0 && shape.inverse.as_flattened().iter().all(|x| x.is_finite())
}

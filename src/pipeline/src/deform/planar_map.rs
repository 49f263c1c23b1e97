//! The map defined by a deformed planar mesh, applied to the document that it was read from.

use std::collections::HashMap;

use unwrapd_files::document::SpaceMap;
use unwrapd_files::io::Elements;
use unwrapd_method::numerics::square::{Matrix, Square, apply, apply_transposed, times};
use unwrapd_method::numerics::vec3;

/// Map of vertices in a plane z = const, which keeps z. Other places, those of vertices without triangles, stay.
pub struct PlanarMap<'a> {
    vertices: HashMap<[u32; 3], usize>,
    to: &'a [[f64; 2]],
    /// Jacobian of the map at each vertex: the mean over its triangles weighted by area. Not invertible if they
    /// cancel.
    jacobians: Vec<Matrix<2>>,
}

impl<'a> PlanarMap<'a> {
    /// Creates the map from the mesh at rest, with the vertices of the document, and its deformed vertices.
    pub fn new(rest: &Elements, to: &'a [[f64; 2]]) -> Self {
        let mut jacobians = vec![[[0.0; 2]; 2]; to.len()];
        let mut areas = vec![0.0; to.len()];
        for &[a, b, c] in &rest.triangles {
            let [a, b, c] = [a, b, c].map(|v| v as usize);
            let edges = |p: &dyn Fn(usize, usize) -> f64| {
                [0, 1].map(|k| [p(b, k) - p(a, k), p(c, k) - p(a, k)])
            };
            let (before, after) = (edges(&|v, k| rest.vertices[v][k]), edges(&|v, k| to[v][k]));
            let det = before.det();
            let jacobian = times(&after, &before.inverse(det));
            for v in [a, b, c] {
                areas[v] += det.abs();
                for (sum, row) in jacobians[v].iter_mut().zip(&jacobian) {
                    for (sum, entry) in sum.iter_mut().zip(row) {
                        *sum += det.abs() * entry;
                    }
                }
            }
        }
        // Divide the sums by the areas.
        for (sum, area) in jacobians.iter_mut().zip(&areas) {
            *sum = sum.map(|row| row.map(|entry| entry / area));
        }
        let places = rest.vertices.iter().enumerate();
        Self {
            vertices: places.map(|(v, p)| (key(p.map(|x| x as f32)), v)).collect(),
            to,
            jacobians,
        }
    }

    fn vertex(&self, place: &[f32; 3]) -> Option<usize> {
        self.vertices.get(&key(*place)).copied()
    }

    /// Applies a linear map, derived from the Jacobian at each place, to the first two coordinates of vectors, and
    /// normalizes them.
    fn turned(
        &self,
        places: &[[f32; 3]],
        vectors: &[[f32; 3]],
        linear: impl Fn(&Matrix<2>, &[f64; 2]) -> [f64; 2],
    ) -> Vec<[f32; 3]> {
        let turned = places.iter().zip(vectors).map(|(place, vector)| {
            let jacobian = self.vertex(place).map(|v| self.jacobians[v]);
            match jacobian.filter(|jacobian| jacobian.det() > 0.0) {
                Some(jacobian) => {
                    let [x, y, z] = vector.map(f64::from);
                    let [x, y] = linear(&jacobian, &[x, y]);
                    vec3::unit([x, y, z]).map(|x| x as f32)
                }
                None => *vector,
            }
        });
        turned.collect()
    }
}

impl SpaceMap for PlanarMap<'_> {
    fn positions(&self, places: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let moved = places.iter().map(|place| match self.vertex(place) {
            Some(v) => [self.to[v][0] as f32, self.to[v][1] as f32, place[2]],
            None => *place,
        });
        moved.collect()
    }

    fn normals(&self, places: &[[f32; 3]], normals: &[[f32; 3]]) -> Vec<[f32; 3]> {
        self.turned(places, normals, |jacobian, normal| {
            apply_transposed(&jacobian.inverse(jacobian.det()), normal)
        })
    }

    fn tangents(&self, places: &[[f32; 3]], tangents: &[[f32; 3]]) -> Vec<[f32; 3]> {
        self.turned(places, tangents, apply)
    }
}

/// Returns a key that is equal for equal places.
fn key(place: [f32; 3]) -> [u32; 3] {
    // −0 is 0.
    place.map(|x| (x + 0.0).to_bits())
}

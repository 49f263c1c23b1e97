//! Rest shapes of triangles in the plane.

use unwrapd_method::energy::RestShape;
use unwrapd_method::numerics::vec2;
use unwrapd_method::numerics::vec3::{area_vector, distance, dot, norm, sub};

/// Least altitude of a rest shape, as a share of its longest edge: below it, a map that keeps the shape would need
/// coordinates of ten digits to stay free of flips.
const SMALLEST_ASPECT: f64 = 1e-4;

/// Least altitude if most of the area is thinner than the first limit but not than this one, as in a fan of a hundred
/// thousand triangles around one vertex: substitutes would fit together there no better.
const THINNEST_ASPECT: f64 = 1e-5;

/// Share of the chart's size to which smaller shapes are enlarged. An atlas stores coordinates to 2⁻²³ of its width, so
/// smaller triangles would be indistinguishable from points, and are invisible.
const SMALLEST_SIZE: f64 = 1.0 / (1_u64 << 20) as f64;

/// Weight of a substitute shape beyond the triangle's true area, as a share of the substitute's area: enough to keep
/// the substitute in shape, too little to pull on its neighbors.
const SUBSTITUTE_WEIGHT: f64 = 1e-3;

/// Rest shapes of all triangles of a chart: the shapes that the map keeps if possible.
///
/// Each triangle is flattened isometrically. One of zero or nearly zero area (it still needs a positive area in the
/// plane) gets a substitute of bounded aspect: its longest edge and the foot on it are kept, its altitude is raised.
/// Its weight is its true area plus a small share of the substitute's. All lengths are divided by `scale`, so that the
/// mean area is 1: barrier strength and tolerances then mean the same for a ring and a city.
#[derive(Clone, Debug, PartialEq)]
pub struct RestShapes {
    /// One shape per triangle.
    pub shapes: Vec<RestShape>,
    /// Length in the mesh's unit of a length 1 here.
    pub scale: f64,
    /// Sum of the areas of the shapes, in the mesh's unit.
    pub area: f64,
    /// Sum of the triangles' true areas, in the mesh's unit.
    pub true_area: f64,
    /// Least size of shapes, in the unit of the shapes.
    pub(super) least: Least,
}

/// Least size to which shapes are enlarged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Least {
    /// Length of the longest edge.
    pub size: f64,
    /// Altitude over that length.
    pub aspect: f64,
}

/// Returns the rest shapes of triangles with three distinct corners each.
///
/// Accepts any finite coordinates, from 1e-40 to 1e40 in the same mesh.
pub fn rest_shapes(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> RestShapes {
    let corners = |t: &[u32; 3]| t.map(|v| positions[v as usize]);
    let longest_edges: Vec<(usize, f64)> =
        triangles.iter().map(|t| longest_edge(corners(t))).collect();
    // Lengths relative to the longest edge: no square overflows, and what underflows is enlarged anyway.
    let longest = (longest_edges.iter()).fold(f64::MIN_POSITIVE, |longest, &(_, length)| {
        longest.max(length)
    });
    let relative = |t: &[u32; 3]| corners(t).map(|p| p.map(|x| x / longest));
    let measures: Vec<RestMeasure> = (triangles.iter().zip(longest_edges))
        .map(|(t, (first, length))| RestMeasure::along(relative(t), first, length / longest))
        .collect();
    // Find the least size and aspect, relative to the whole chart.
    let aspect = least_aspect(&measures);
    let size = (measures.iter())
        .map(|m| m.area.max(0.5 * aspect * m.length * m.length))
        .sum::<f64>()
        .sqrt();
    let least = Least {
        size: SMALLEST_SIZE * size,
        aspect,
    };
    // Make the shapes, then scale them to a mean area of 1.
    let measured = triangles.iter().zip(&measures);
    let mut shapes: Vec<_> = measured
        .map(|(t, measure)| measure.rest_shape(relative(t), least))
        .collect();
    let total: f64 = shapes.iter().map(|shape| shape.size).sum();
    let unit = (total / triangles.len().max(1) as f64).sqrt();
    for shape in &mut shapes {
        *shape = RestShape {
            inverse: shape.inverse.map(|row| row.map(|x| x * unit)),
            size: shape.size / (unit * unit),
            weight: shape.weight / (unit * unit),
        };
    }
    let true_area: f64 = measures.iter().map(|m| m.area).sum();
    RestShapes {
        shapes,
        scale: unit * longest,
        area: total * longest * longest,
        true_area: true_area * longest * longest,
        least: Least {
            size: least.size / unit,
            aspect,
        },
    }
}

impl RestShapes {
    /// Multiplies the weight of each shape by a factor, one per triangle; leaves them as they are without factors.
    pub(super) fn weighted(mut self, factors: &[f64]) -> Self {
        for (shape, factor) in self.shapes.iter_mut().zip(factors) {
            shape.weight *= factor;
        }
        self
    }
}

/// Returns the aspect below which shapes get a substitute.
fn least_aspect(triangles: &[RestMeasure]) -> f64 {
    let (mut all, mut thin) = (0.0, 0.0);
    for triangle in triangles {
        all += triangle.area;
        if triangle.is_thinner(SMALLEST_ASPECT) && !triangle.is_thinner(THINNEST_ASPECT) {
            thin += triangle.area;
        }
    }
    if thin > 0.5 * all {
        THINNEST_ASPECT
    } else {
        SMALLEST_ASPECT
    }
}

/// Returns the rest shape of one triangle.
pub(super) fn rest_shape(p: [[f64; 3]; 3], least: Least) -> RestShape {
    RestMeasure::of(p).rest_shape(p, least)
}

/// Returns whether a triangle is so thin that it gets a substitute in any chart: no map that is made here keeps its
/// shape.
pub fn is_needle(p: [[f64; 3]; 3]) -> bool {
    RestMeasure::of(p).is_thinner(THINNEST_ASPECT)
}

/// A triangle's longest edge and its area.
struct RestMeasure {
    /// Corner at which the edge starts.
    first: usize,
    length: f64,
    area: f64,
}

impl RestMeasure {
    fn of(p: [[f64; 3]; 3]) -> Self {
        let (first, length) = longest_edge(p);
        Self::along(p, first, length)
    }

    /// Measures a triangle with a known longest edge. The area is measured from the opposite corner, where the rounding
    /// is least.
    fn along(p: [[f64; 3]; 3], first: usize, length: f64) -> Self {
        let [a, b, apex] = [first, (first + 1) % 3, (first + 2) % 3];
        Self {
            first,
            length,
            area: 0.5 * norm(area_vector(p[apex], p[a], p[b])),
        }
    }

    /// Returns whether the altitude on the longest edge is less than this share of it.
    fn is_thinner(&self, aspect: f64) -> bool {
        2.0 * self.area < aspect * self.length * self.length
    }

    /// Lays the triangle on its longest edge, no shorter than the least and with a bounded aspect.
    fn rest_shape(&self, p: [[f64; 3]; 3], least: Least) -> RestShape {
        let (smallest, length) = (least.size, self.length);
        let [a, b, c] = [self.first, (self.first + 1) % 3, (self.first + 2) % 3];
        let (base, foot, altitude) = if length < smallest {
            (smallest, 0.5 * smallest, 0.75_f64.sqrt() * smallest)
        } else {
            let (edge, side) = (sub(p[b], p[a]), sub(p[c], p[a]));
            let altitude = 2.0 * self.area / length;
            let floor = (least.aspect * length).max(0.5 * smallest);
            (length, dot(edge, side) / length, altitude.max(floor))
        };
        let mut corners = [[0.0; 2]; 3];
        corners[b] = [base, 0.0];
        corners[c] = [foot, altitude];
        let shape = RestShape::from_edges(
            vec2::sub(corners[1], corners[0]),
            vec2::sub(corners[2], corners[0]),
        );
        let is_substitute = shape.size > 1.01 * self.area;
        let extra = if is_substitute {
            SUBSTITUTE_WEIGHT * shape.size
        } else {
            0.0
        };
        RestShape {
            weight: self.area + extra,
            ..shape
        }
    }
}

/// Returns the corner at which the longest edge starts, and its length.
fn longest_edge(p: [[f64; 3]; 3]) -> (usize, f64) {
    (0..3)
        .map(|k| (k, distance(p[k], p[(k + 1) % 3])))
        .fold(
            (0, 0.0),
            |best, edge| if edge.1 > best.1 { edge } else { best },
        )
}

//! What each triangle should look like in the plane.

use unwrapd_method::energy::RestShape;
use unwrapd_method::numerics::vec2;
use unwrapd_method::numerics::vec3::{area_vector, distance, dot, norm, sub};

/// A triangle whose altitude is a smaller part of its longest edge is given this altitude: below it, a map that keeps
/// the shape would have to hold coordinates to ten digits to stay unflipped.
const SMALLEST_ASPECT: f64 = 1e-4;

/// The same where most of the area is thinner than that but not than this, as in a fan of a hundred thousand around one vertex: there
/// substitutes would fit together no better than they would around it.
const THINNEST_ASPECT: f64 = 1e-5;

/// Shapes below this part of the chart's size are enlarged to it. An atlas stores coordinates to 2⁻²³ of its width, so
/// smaller triangles could not be told from points there, and nobody can see them.
const SMALLEST_SIZE: f64 = 1.0 / (1_u64 << 20) as f64;

/// What a substitute shape weighs beyond the triangle's true area, as part of the substitute's area: enough to keep the
/// substitute in shape, too little to pull on its neighbors.
const SUBSTITUTE_WEIGHT: f64 = 1e-3;

/// The rest shape of every triangle of a chart: what the map would keep if it could.
///
/// Each triangle is flattened isometrically. One of zero or nearly zero area (it still needs a positive area in the
/// plane) gets a substitute of bounded aspect: its longest edge and the foot on it kept, its altitude raised. Its weight
/// is its true area and a small part of the substitute's.
/// All lengths are divided by `scale`, so that the mean area is 1: barrier strength and tolerances then mean the same
/// for a ring and a city.
#[derive(Clone, Debug, PartialEq)]
pub struct RestShapes {
    /// The shapes, one per triangle.
    pub shapes: Vec<RestShape>,
    /// Length in the mesh's unit of a length 1 here.
    pub scale: f64,
    /// Sum of the areas of the shapes, in the mesh's unit.
    pub area: f64,
    /// Sum of the triangles' true areas, in the mesh's unit.
    pub true_area: f64,
    /// What shapes were enlarged to, in the unit of the shapes.
    pub(super) least: Least,
}

/// The least that shapes are enlarged to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Least {
    /// Length of the longest edge.
    pub size: f64,
    /// Altitude over that length.
    pub aspect: f64,
}

/// The rest shapes of triangles with three distinct corners each.
///
/// Any finite coordinates are welcome, from 1e-40 to 1e40 in the same mesh.
pub fn rest_shapes(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> RestShapes {
    let corners = |t: &[u32; 3]| t.map(|v| positions[v as usize]);
    let longest_edges: Vec<(usize, f64)> =
        triangles.iter().map(|t| longest_edge(corners(t))).collect();
    // Lengths relative to the longest edge: no square overflows, and what underflows is enlarged anyway.
    let longest = (longest_edges.iter()).fold(f64::MIN_POSITIVE, |longest, &(_, length)| {
        longest.max(length)
    });
    let relative = |t: &[u32; 3]| corners(t).map(|p| p.map(|x| x / longest));
    let measures: Vec<Measure> = (triangles.iter().zip(longest_edges))
        .map(|(t, (first, length))| Measure::along(relative(t), first, length / longest))
        .collect();
    let aspect = least_aspect(&measures);
    let size = (measures.iter())
        .map(|m| m.area.max(0.5 * aspect * m.length * m.length))
        .sum::<f64>()
        .sqrt();
    let least = Least {
        size: SMALLEST_SIZE * size,
        aspect,
    };
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

/// The aspect below which shapes get a substitute.
fn least_aspect(triangles: &[Measure]) -> f64 {
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

/// The rest shape of one triangle.
pub(super) fn rest_shape(p: [[f64; 3]; 3], least: Least) -> RestShape {
    Measure::of(p).rest_shape(p, least)
}

/// Whether a triangle is so thin that it gets a substitute wherever it is: no map that is made here keeps its shape.
pub fn is_needle(p: [[f64; 3]; 3]) -> bool {
    Measure::of(p).is_thinner(THINNEST_ASPECT)
}

/// A triangle's longest edge and its area.
struct Measure {
    /// The corner that the edge starts from.
    first: usize,
    length: f64,
    area: f64,
}

impl Measure {
    fn of(p: [[f64; 3]; 3]) -> Self {
        let (first, length) = longest_edge(p);
        Self::along(p, first, length)
    }

    /// Of a triangle of which the longest edge is known. The area is measured from the corner opposite to it: there the rounding is
    /// least.
    fn along(p: [[f64; 3]; 3], first: usize, length: f64) -> Self {
        let [a, b, apex] = [first, (first + 1) % 3, (first + 2) % 3];
        Self {
            first,
            length,
            area: 0.5 * norm(area_vector(p[apex], p[a], p[b])),
        }
    }

    /// Whether the altitude on the longest edge is a smaller part of it.
    fn is_thinner(&self, aspect: f64) -> bool {
        2.0 * self.area < aspect * self.length * self.length
    }

    /// The triangle laid on its longest edge, no shorter than the least and with a bounded aspect.
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

/// The corner the longest edge starts from, and its length.
fn longest_edge(p: [[f64; 3]; 3]) -> (usize, f64) {
    (0..3)
        .map(|k| (k, distance(p[k], p[(k + 1) % 3])))
        .fold(
            (0, 0.0),
            |best, edge| if edge.1 > best.1 { edge } else { best },
        )
}

//! Meshes of one shape: equal but for a rigid motion and a uniform scale.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use super::seams::Seams;
use unwrapd_maps::mesh::Surface;
use unwrapd_method::numerics::vec3::{cross, dot, norm, sub};

/// Error of f32 coordinates after a motion, in units of the largest coordinate: a few roundings of 2⁻²⁴.
const ROUNDINGS: f64 = 8.0 / 16_777_216.0;
/// Largest such error, as a share of a mesh's radius: a mesh farther from its origin shows too little of its shape.
const MOST_BLURRED: f64 = 1e-5;

/// The first mesh of a shape, and the size of this mesh relative to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alike {
    pub first: usize,
    pub size: f64,
}

/// Returns for each surface, cut along its seams, the first one of its shape. Triangles and seams must be equal,
/// number for number; positions may differ by a rigid motion and a scale.
pub fn alike(surfaces: &[&Surface], seams: &[&Seams]) -> Vec<Alike> {
    // By everything but positions, then by a number that motions and scales keep.
    let mut firsts: BTreeMap<(u64, u64), Vec<usize>> = BTreeMap::new();
    let mut found = Vec::with_capacity(surfaces.len());
    for (index, (surface, own)) in surfaces.iter().zip(seams).enumerate() {
        let shape = Shape::new(surface);
        let hash = hash(surface);
        let near = |factor: f64| (hash, (shape.roundness * factor).to_bits());
        let candidates =
            firsts.range(near(1.0 - 4.0 * MOST_BLURRED)..=near(1.0 + 4.0 * MOST_BLURRED));
        let candidates = candidates.flat_map(|(_, of_number)| of_number);
        let same = candidates.copied().find_map(|first| {
            let is_same = surfaces[first].triangles == surface.triangles
                && surfaces[first].faces == surface.faces
                && seams[first] == *own;
            let size = is_same.then(|| size_over(surface, surfaces[first]))??;
            Some(Alike { first, size })
        });
        found.push(same.unwrap_or_else(|| {
            firsts.entry(near(1.0)).or_default().push(index);
            Alike {
                first: index,
                size: 1.0,
            }
        }));
    }
    found
}

fn hash(surface: &Surface) -> u64 {
    let mut hasher = DefaultHasher::new();
    surface.triangles.hash(&mut hasher);
    surface.faces.hash(&mut hasher);
    hasher.finish()
}

/// Place and size of a mesh.
struct Shape {
    origin: [f64; 3],
    /// Distance from the origin to the farthest vertex.
    radius: f64,
    /// Mean distance over the largest.
    roundness: f64,
    /// Rounding error of positions, over the radius.
    blur: f64,
}

impl Shape {
    fn new(surface: &Surface) -> Self {
        let corners = || {
            surface
                .triangles
                .as_flattened()
                .iter()
                .map(|&v| surface.positions[v as usize])
        };
        let origin = corners().next().unwrap_or_default();
        let distances = || corners().map(|p| norm(sub(p, origin)));
        let radius = distances().fold(0.0, f64::max);
        let farthest = corners()
            .flatten()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        let n = (3 * surface.triangles.len()).max(1);
        Self {
            origin,
            radius,
            roundness: distances().sum::<f64>() / n as f64 / radius.max(f64::MIN_POSITIVE),
            blur: ROUNDINGS * farthest / radius.max(f64::MIN_POSITIVE),
        }
    }
}

/// Returns the size of a surface relative to another with the same triangles if they are equal up to a rigid motion
/// and a scale.
fn size_over(surface: &Surface, other: &Surface) -> Option<f64> {
    let is_used = |&v: &u32| (surface.positions[v as usize], other.positions[v as usize]);
    if (surface.triangles.as_flattened().iter().map(is_used)).all(|(p, q)| p == q) {
        return Some(1.0);
    }
    let shapes = [Shape::new(surface), Shape::new(other)];
    let blur = shapes[0].blur + shapes[1].blur;
    let size = shapes[0].radius / shapes[1].radius;
    if !size.is_normal() || blur > MOST_BLURRED {
        return None;
    }
    let landmarks = landmarks(other)?;
    let [own, others] = [(surface, &shapes[0]), (other, &shapes[1])]
        .map(|(mesh, shape)| Frame::new(mesh, shape.origin, landmarks));
    let (own, others) = (own?, others?);
    let is_near = |(p, q): ([f64; 3], [f64; 3])| {
        let apart = sub(own.of(p).map(|x| x / size), others.of(q));
        norm(apart) <= 4.0 * blur * shapes[1].radius
    };
    (surface.triangles.as_flattened().iter().map(is_used))
        .all(is_near)
        .then_some(size)
}

/// Returns two corners that span a large triangle with the first one: the farthest from it, and the farthest from the
/// line through both.
fn landmarks(surface: &Surface) -> Option<[u32; 2]> {
    let vertices = surface.triangles.as_flattened();
    let origin = surface.positions[*vertices.first()? as usize];
    let offset = |v: u32| sub(surface.positions[v as usize], origin);
    let farthest = |height: &dyn Fn(u32) -> f64| {
        vertices
            .iter()
            .copied()
            .max_by(|&a, &b| height(a).total_cmp(&height(b)))
    };
    let first = farthest(&|v| norm(offset(v)))?;
    let second = farthest(&|v| norm(cross(offset(first), offset(v))))?;
    Some([first, second])
}

/// Coordinates that move with a mesh.
struct Frame {
    origin: [f64; 3],
    axes: [[f64; 3]; 3],
}

impl Frame {
    /// Creates the frame; returns `None` if the landmarks lie on a line.
    fn new(surface: &Surface, origin: [f64; 3], landmarks: [u32; 2]) -> Option<Self> {
        let [a, b] = landmarks.map(|v| sub(surface.positions[v as usize], origin));
        let unit = |v: [f64; 3]| {
            let length = norm(v);
            (length > 0.0).then(|| v.map(|x| x / length))
        };
        let z = unit(cross(a, b))?;
        let x = unit(a)?;
        Some(Self {
            origin,
            axes: [x, cross(z, x), z],
        })
    }

    fn of(&self, p: [f64; 3]) -> [f64; 3] {
        self.axes.map(|axis| dot(axis, sub(p, self.origin)))
    }
}

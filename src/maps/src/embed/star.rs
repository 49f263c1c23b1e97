//! The symmetric Dirichlet energy around one vertex, as a function of its position.
//!
//! In the plane ‖J⁻¹‖² = ‖J‖²/det²J, ‖J‖² is a sum over squared edges, and det J is linear in one vertex: two dozen
//! operations per triangle for the value, and again for its derivatives.

use unwrapd_method::energy::RestShape;
use unwrapd_method::numerics::vec2::{cross, dot, sub};

/// Most Newton steps on a vertex in one visit. A step widens a squeezed triangle by a third, as Newton's method does
/// with 1/x², so that this many widen one by a factor of 5,000.
const MOST_STEPS: usize = 30;

/// Share of the energy around a vertex that a step must remove for another to follow. Most vertices need one; the few
/// others would keep most of the remaining energy and cost global steps: eleven factorizations on the finest level
/// instead of six (camelhead), fifteen instead of two (bimba_89k).
const WORTH_ANOTHER: f64 = 0.02;

/// Most halvings before a vertex stays in place: a step shorter than 2⁻⁸ would hardly move it.
const MAX_HALVINGS: usize = 8;

/// Least curvature, as a share of the greatest: keeps steps along flat directions finite.
const FLATTEST: f64 = 1e-9;

/// Rest shape of a triangle in the form that its energy needs: weight·‖J‖² = Σ edgesᵢ |edge opposite to corner i|²,
/// and the factor of the doubled area in det J.
#[derive(Clone, Copy, Debug)]
pub struct Corners {
    edges: [f64; 3],
    per_doubled_area: f64,
}

impl Corners {
    /// Computes the factors from ‖J‖² = −Σ over edges of |edge|² gᵢ·gⱼ, with the gradients g of the barycentric
    /// coordinates of its ends.
    pub fn new(rest: &RestShape) -> Self {
        let [g1, g2] = rest.inverse;
        let g0 = [-g1[0] - g2[0], -g1[1] - g2[1]];
        let edge = |g, h| -rest.weight * dot(g, h);
        Self {
            edges: [edge(g1, g2), edge(g2, g0), edge(g0, g1)],
            per_doubled_area: 0.5 / rest.size,
        }
    }
}

/// A triangle with one free corner, given by the corners after it, counter-clockwise.
#[derive(Clone, Copy, Debug)]
struct StarFace {
    ends: [[f64; 2]; 2],
    /// Factors of the edge between the ends, of the edge to the second and of that to the first.
    edges: [f64; 3],
    per_doubled_area: f64,
}

/// The triangles around a vertex.
#[derive(Clone, Debug, Default)]
pub struct Star {
    faces: Vec<StarFace>,
}

impl Star {
    /// Removes all triangles.
    pub fn clear(&mut self) {
        self.faces.clear();
    }

    /// Adds a triangle whose corner number `corner` is the vertex; the two after it are at `ends`.
    pub fn push(&mut self, corners: &Corners, corner: usize, ends: [[f64; 2]; 2]) {
        let edge = |i: usize| corners.edges[(corner + i) % 3];
        self.faces.push(StarFace {
            ends,
            edges: [edge(0), edge(1), edge(2)],
            per_doubled_area: corners.per_doubled_area,
        });
    }

    /// Returns the position after Newton steps from `start`, each accepted, as long as they gain enough; the energy
    /// falls.
    ///
    /// A triangle's area is linear in one vertex, so no inversion can hide between the end points of a step.
    pub fn settle(&self, start: [f64; 2], is_accepted: impl Fn([f64; 2]) -> bool) -> [f64; 2] {
        let mut at = start;
        let mut energy = self.value(at);
        for _ in 0..MOST_STEPS {
            let Some((next, next_energy)) = self.step(at, energy) else {
                break;
            };
            if !is_accepted(next) {
                break;
            }
            let is_last = energy - next_energy < WORTH_ANOTHER * energy;
            (at, energy) = (next, next_energy);
            if is_last {
                break;
            }
        }
        at
    }

    /// Takes one Newton step, halved until the energy falls; returns the position and its energy.
    fn step(&self, at: [f64; 2], energy: f64) -> Option<([f64; 2], f64)> {
        let mut direction = self.newton_direction(at);
        for _ in 0..MAX_HALVINGS {
            let next = [at[0] + direction[0], at[1] + direction[1]];
            let next_energy = self.value(next);
            if next_energy < energy {
                return Some((next, next_energy));
            }
            direction = direction.map(|d| 0.5 * d);
        }
        None
    }

    /// Returns the energy with the vertex at `x`, +∞ if a triangle is not positive.
    ///
    /// Σ over the triangles of weight·‖J‖²(1 + 1/det²J). Test: `embed::taylor_star`.
    pub fn value(&self, x: [f64; 2]) -> f64 {
        self.faces.iter().map(|face| face.value(x)).sum()
    }

    /// Returns the gradient and the entries xx, xy, yy of the Hessian with the vertex at `x`.
    pub fn derivatives(&self, x: [f64; 2]) -> ([f64; 2], [f64; 3]) {
        let (mut gradient, mut hessian) = ([0.0; 2], [0.0; 3]);
        for face in &self.faces {
            face.add_derivatives(x, &mut gradient, &mut hessian);
        }
        (gradient, hessian)
    }

    /// Returns −|H|⁻¹g, where |H| has the absolute eigenvalues of the Hessian.
    fn newton_direction(&self, x: [f64; 2]) -> [f64; 2] {
        let (g, [a, b, c]) = self.derivatives(x);
        let (mean, half) = (0.5 * (a + c), 0.5 * (a - c));
        let radius = half.hypot(b);
        let floor = (FLATTEST * (mean.abs() + radius)).max(f64::MIN_POSITIVE);
        let first = if half >= 0.0 {
            [half + radius, b]
        } else {
            [b, radius - half]
        };
        let length = first[0].hypot(first[1]);
        let [u, v] = if length > 0.0 {
            first.map(|x| x / length)
        } else {
            [1.0, 0.0]
        };
        let along = -(g[0] * u + g[1] * v) / (mean + radius).abs().max(floor);
        let across = -(g[1] * u - g[0] * v) / (mean - radius).abs().max(floor);
        [along * u - across * v, along * v + across * u]
    }
}

impl StarFace {
    /// Returns weight·‖J‖² and det J.
    fn parts(&self, x: [f64; 2]) -> (f64, f64) {
        let [b, c] = self.ends;
        let (edge, to_b, to_c) = (sub(c, b), sub(b, x), sub(c, x));
        let [w, w_c, w_b] = self.edges;
        let norm = w * dot(edge, edge) + w_c * dot(to_c, to_c) + w_b * dot(to_b, to_b);
        (norm, self.per_doubled_area * cross(to_b, to_c))
    }

    fn value(&self, x: [f64; 2]) -> f64 {
        let (norm, det) = self.parts(x);
        if det > 0.0 {
            norm * (1.0 + 1.0 / (det * det))
        } else {
            f64::INFINITY
        }
    }

    /// Adds the gradient and the entries xx, xy, yy of the Hessian.
    fn add_derivatives(&self, x: [f64; 2], gradient: &mut [f64; 2], hessian: &mut [f64; 3]) {
        let (norm, det) = self.parts(x);
        let [b, c] = self.ends;
        let [_, w_c, w_b] = self.edges;
        let n: [f64; 2] =
            std::array::from_fn(|k| 2.0 * (w_c * (x[k] - c[k]) + w_b * (x[k] - b[k])));
        let d = [b[1] - c[1], c[0] - b[0]].map(|x| self.per_doubled_area * x);
        let inverse = 1.0 / det;
        let squared = inverse * inverse;
        let (first, second) = (-2.0 * squared * inverse, 6.0 * norm * squared * squared);
        for k in 0..2 {
            gradient[k] += (1.0 + squared) * n[k] + first * norm * d[k];
        }
        let straight = 2.0 * (w_c + w_b) * (1.0 + squared);
        hessian[0] += straight + 2.0 * first * n[0] * d[0] + second * d[0] * d[0];
        hessian[1] += first * (n[0] * d[1] + n[1] * d[0]) + second * d[0] * d[1];
        hessian[2] += straight + 2.0 * first * n[1] * d[1] + second * d[1] * d[1];
    }
}

//! Distance of a vertex from an edge, with first and second derivatives of functions of it.

use unwrapd_method::numerics::vec2::{cross, dot, sub};

/// The vector from the nearest point of an edge to a vertex.
///
/// Continuously differentiable in all three positions while its length is positive; the second derivative jumps where
/// the nearest point reaches an end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    pub distance: f64,
    /// Direction, of length 1.
    normal: [f64; 2],
    /// Direction across it: that of the edge, if the nearest point is not an end.
    tangent: [f64; 2],
    /// Derivatives of the distance along the normal with respect to the vertex and the ends of the edge.
    weights: [f64; 3],
    /// One over the edge's length; `None` if the nearest point is an end.
    curvature: Option<f64>,
}

/// A summand λuuᵀ of a Hessian, with u given at the vertex and the ends of the edge.
pub(super) type GapCurvature = (f64, [[f64; 2]; 3]);

impl Gap {
    /// Computes the gap between the vertex at `p` and the edge from `a` to `b`.
    pub fn new([p, a, b]: [[f64; 2]; 3]) -> Self {
        let (edge, arm) = (sub(b, a), sub(p, a));
        let length_squared = dot(edge, edge);
        let along = dot(arm, edge);
        if along <= 0.0 {
            return Self::to_end(arm, [1.0, -1.0, 0.0]);
        }
        if along >= length_squared {
            return Self::to_end(sub(p, b), [1.0, 0.0, -1.0]);
        }
        let length = length_squared.sqrt();
        let height = cross(edge, arm) / length;
        let side = 1.0_f64.copysign(height);
        let tangent = edge.map(|x| x / length);
        let share = along / length_squared;
        Self {
            distance: height.abs(),
            normal: [-side * tangent[1], side * tangent[0]],
            tangent,
            weights: [1.0, share - 1.0, -share],
            curvature: Some(1.0 / length),
        }
    }

    fn to_end(arm: [f64; 2], weights: [f64; 3]) -> Self {
        let distance = arm[0].hypot(arm[1]);
        let normal = arm.map(|x| x / distance);
        Self {
            distance,
            normal,
            tangent: [-normal[1], normal[0]],
            weights,
            curvature: None,
        }
    }

    /// Returns the gradient of a function of the distance with the derivative `first`.
    pub fn gradient(&self, first: f64) -> [[f64; 2]; 3] {
        self.weights.map(|w| self.normal.map(|n| first * w * n))
    }

    /// Returns the Hessian of a function of the distance with these derivatives, the first of them negative or zero.
    ///
    /// Let q be the weighted moves, h = n·q and k = τ·q along normal and edge, and θ the turn of the edge. The Hessian
    /// is φ″h² + φ′(k²/d) at an end and φ″h² − φ′(2θk + dθ²) along the edge. k and θ are orthogonal, so the
    /// eigenvectors of the part with φ′ are known.
    pub fn modes(&self, [first, second]: [f64; 2]) -> [GapCurvature; 3] {
        let spread = |direction: [f64; 2], weights: [f64; 3], factor: f64| {
            weights.map(|w| direction.map(|x| factor * w * x))
        };
        let pushing = (second, spread(self.normal, self.weights, 1.0));
        // At an end of the edge the second mode slides around that end.
        let Some(curvature) = self.curvature else {
            let sliding = spread(self.tangent, self.weights, 1.0);
            return [
                pushing,
                (first / self.distance, sliding),
                (0.0, [[0.0; 2]; 3]),
            ];
        };
        // Along the edge sliding and turning are coupled: find the eigenvectors of the part with φ′ in closed form.
        let norm = self.weights.iter().map(|w| w * w).sum::<f64>().sqrt();
        let sliding = spread(self.tangent, self.weights, 1.0 / norm);
        let turning = spread(self.normal, [0.0, -1.0, 1.0], 0.5_f64.sqrt());
        let mixed = 2.0_f64.sqrt() * norm * curvature;
        let half = self.distance * curvature * curvature;
        let root = half.hypot(mixed);
        let mode = |lambda: f64| {
            let length = lambda.hypot(mixed);
            let (c, s) = (mixed / length, lambda / length);
            let mix = |k: usize| [0, 1].map(|i| c * sliding[k][i] + s * turning[k][i]);
            (-first * lambda, [mix(0), mix(1), mix(2)])
        };
        [
            pushing,
            mode(half + root),
            mode(-mixed * mixed / (half + root)),
        ]
    }
}

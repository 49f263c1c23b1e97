//! One triangle: from vertex positions to its Jacobian, and from derivatives in J back to the vertices.

use std::f64::consts::FRAC_1_SQRT_2;

use super::{Derivatives, Jacobian, RestShape};
use crate::numerics::vec2::{cross, sub};

/// A triangle as the sums need it: vertices in increasing order, because then the blocks of its Hessian lie in the
/// lower triangle of the matrix without a question. Its orientation is in the order of `gradients`.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    pub vertices: [u32; 3],
    /// Gradients of the barycentric coordinates of the second and the third vertex.
    gradients: [[f64; 2]; 2],
    /// Their cross product: one over twice the rest area, with the sign of the reordering.
    cross: f64,
    pub area: f64,
    pub weight: f64,
    /// det J must stay above this.
    pub floor: f64,
}

/// Gradient and Hessian of one triangle's energy in J, the latter as a matrix in the basis (similar, reflected).
#[derive(Clone, Copy, Debug)]
pub struct Pulled {
    gradient: [f64; 4],
    hessian: [[f64; 4]; 4],
}

impl Element {
    pub fn new(triangle: [u32; 3], rest: &RestShape, floor: f64) -> Self {
        let [first, second] = rest.inverse;
        let zeroth = [-first[0] - second[0], -first[1] - second[1]];
        let mut corners = [0, 1, 2].map(|k| (triangle[k], [zeroth, first, second][k]));
        corners.sort_unstable_by_key(|&(vertex, _)| vertex);
        let gradients = [corners[1].1, corners[2].1];
        Self {
            vertices: corners.map(|(vertex, _)| vertex),
            gradients,
            cross: cross(gradients[0], gradients[1]),
            area: rest.area,
            weight: rest.weight,
            floor,
        }
    }

    pub fn corners(&self, x: &[f64]) -> [[f64; 2]; 3] {
        self.vertices.map(|v| {
            let at = 2 * v as usize;
            [x[at], x[at + 1]]
        })
    }

    fn edges(&self, x: &[f64]) -> [[f64; 2]; 2] {
        let [a, b, c] = self.corners(x);
        [sub(b, a), sub(c, a)]
    }

    pub fn det(&self, x: &[f64]) -> f64 {
        let [first, second] = self.edges(x);
        cross(first, second) * self.cross
    }

    pub fn jacobian(&self, x: &[f64]) -> Jacobian {
        let [[e0, e1], [f0, f1]] = self.edges(x);
        let [[g0, g1], [h0, h1]] = self.gradients;
        let rows = [
            [e0 * g0 + f0 * h0, e0 * g1 + f0 * h1],
            [e1 * g0 + f1 * h0, e1 * g1 + f1 * h1],
        ];
        Jacobian {
            det: (e0 * f1 - e1 * f0) * self.cross,
            ..Jacobian::from_rows(rows)
        }
    }

    /// Coefficients of det J(x + t d) − floor in powers of t.
    pub fn margin_polynomial(&self, x: &[f64], d: &[f64]) -> [f64; 3] {
        let ([e, f], [de, df]) = (self.edges(x), self.edges(d));
        [
            cross(e, f) * self.cross - self.floor,
            (cross(e, df) + cross(de, f)) * self.cross,
            cross(de, df) * self.cross,
        ]
    }

    /// The 4×2 matrices that take a move of the second and of the third vertex to the change of J.
    fn lifts(&self) -> [[[f64; 2]; 4]; 2] {
        self.gradients.map(|[g0, g1]| {
            let (r, s) = (FRAC_1_SQRT_2 * g0, FRAC_1_SQRT_2 * g1);
            [[r, s], [-s, r], [r, -s], [s, r]]
        })
    }

    /// The gradient at each of the three vertices: derivatives in J pulled back.
    pub fn gradients(&self, pulled: &Pulled) -> [[f64; 2]; 3] {
        let [first, second] = self
            .lifts()
            .map(|lift| transposed_times(&lift, &pulled.gradient));
        [
            [-first[0] - second[0], -first[1] - second[1]],
            first,
            second,
        ]
    }

    /// The Hessian's blocks: of the three vertices with themselves, `[h00, h10, h11]`, and of the pairs (second, first),
    /// (third, first), (third, second), `[column][row]`.
    ///
    /// Blocks of the first vertex follow from the others, because moving all three alike changes nothing.
    pub fn blocks(&self, pulled: &Pulled) -> ([[f64; 3]; 3], [[[f64; 2]; 2]; 3]) {
        let [first, second] = self.lifts();
        let h11 = block(&first, &pulled.hessian, &first);
        let h22 = block(&second, &pulled.hessian, &second);
        let h21 = block(&second, &pulled.hessian, &first);
        let h12 = [[h21[0][0], h21[1][0]], [h21[0][1], h21[1][1]]];
        let h10 = minus_sum(h11, h12);
        let h20 = minus_sum(h21, h22);
        let h00 = [0, 1].map(|c| [0, 1].map(|r| h11[c][r] + h12[c][r] + h21[c][r] + h22[c][r]));
        let lower = |h: [[f64; 2]; 2]| [h[0][0], h[0][1], h[1][1]];
        ([lower(h00), lower(h11), lower(h22)], [h10, h20, h21])
    }
}

impl Pulled {
    /// Gradient and projected Hessian of a function with these derivatives at `j`.
    pub fn new(derivatives: Derivatives, j: &Jacobian, tau: f64) -> Self {
        let ([a, b], [c, d]) = (j.similar, j.reflected);
        let Derivatives { twist, flip, .. } = derivatives;
        let h = derivatives.project(tau);
        let (u, v) = (unit([a, b], j.p()), unit([c, d], j.m()));
        let (p, m) = (h.pp - h.twist, h.mm - h.flip);
        let q = [u[0] * v[0], u[0] * v[1], u[1] * v[0], u[1] * v[1]].map(|q| h.pm * q);
        let (p10, m10) = (p * u[0] * u[1], m * v[0] * v[1]);
        Self {
            gradient: [twist * a, twist * b, flip * c, flip * d],
            hessian: [
                [h.twist + p * u[0] * u[0], p10, q[0], q[1]],
                [p10, h.twist + p * u[1] * u[1], q[2], q[3]],
                [q[0], q[2], h.flip + m * v[0] * v[0], m10],
                [q[1], q[3], m10, h.flip + m * v[1] * v[1]],
            ],
        }
    }
}

/// Any unit vector serves where the part vanishes: there the two derivatives across it agree.
fn unit([x, y]: [f64; 2], norm: f64) -> [f64; 2] {
    if norm > 0.0 {
        [x / norm, y / norm]
    } else {
        [1.0, 0.0]
    }
}

fn transposed_times(lift: &[[f64; 2]; 4], q: &[f64; 4]) -> [f64; 2] {
    [0, 1].map(|c| (0..4).map(|i| lift[i][c] * q[i]).sum())
}

/// `rows`ᵀ · `hessian` · `columns`, as `[column][row]`.
fn block(rows: &[[f64; 2]; 4], hessian: &[[f64; 4]; 4], columns: &[[f64; 2]; 4]) -> [[f64; 2]; 2] {
    [0, 1].map(|c| {
        let image = [0, 1, 2, 3].map(|i| (0..4).map(|j| hessian[i][j] * columns[j][c]).sum());
        transposed_times(rows, &image)
    })
}

fn minus_sum(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    [0, 1].map(|c| [0, 1].map(|r| -a[c][r] - b[c][r]))
}

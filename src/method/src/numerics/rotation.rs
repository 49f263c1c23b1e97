//! Rotations of plane and space, their logarithms, and best-fitting rotations.

use super::square::{Matrix, Square, identity, times, transposed};
use super::vec3;

/// Rotations and their logarithms.
pub trait Rotation<const D: usize> {
    /// Returns the antisymmetric matrix of the rotation with the smallest angle; at half a turn one of the two.
    fn log(&self) -> Matrix<D>;
    /// Returns the rotation exp(s·log).
    fn exp(log: &Matrix<D>, s: f64) -> Matrix<D>;
    /// Returns the logarithm of a turn by an angle in radians, counter-clockwise seen against the axis; in the plane
    /// the axis is ignored.
    fn about(axis: [f64; 3], angle: f64) -> Matrix<D>;
    /// Returns the angle in radians by which a logarithm turns about a unit axis: the inverse of
    /// [`about`](Self::about).
    fn angle(log: &Matrix<D>, axis: [f64; 3]) -> f64;
}

impl Rotation<2> for Matrix<2> {
    fn log(&self) -> Self {
        Self::about([0.0; 3], self[1][0].atan2(self[0][0]))
    }

    fn exp(log: &Self, s: f64) -> Self {
        let (sin, cos) = (s * log[1][0]).sin_cos();
        [[cos, -sin], [sin, cos]]
    }

    fn about(_: [f64; 3], angle: f64) -> Self {
        [[0.0, -angle], [angle, 0.0]]
    }

    fn angle(log: &Self, _: [f64; 3]) -> f64 {
        log[1][0]
    }
}

impl Rotation<3> for Matrix<3> {
    fn log(&self) -> Self {
        let trace = self[0][0] + self[1][1] + self[2][2];
        let twice_axis = [
            self[2][1] - self[1][2],
            self[0][2] - self[2][0],
            self[1][0] - self[0][1],
        ];
        let sin = 0.5 * vec3::norm(twice_axis);
        let angle = sin.atan2(0.5 * (trace - 1.0));
        if sin > 1e-6 {
            Self::about(twice_axis.map(|a| a / (2.0 * sin)), angle)
        } else if trace > 0.0 {
            [[0.0; 3]; 3]
        } else {
            Self::about(half_turn_axis(self), angle)
        }
    }

    /// Uses Rodrigues' formula.
    fn exp(log: &Self, s: f64) -> Self {
        let speed = vec3::norm(vector(log));
        if speed == 0.0 {
            return identity(1.0);
        }
        let square = times(log, log);
        let (sin, cos) = (s * speed).sin_cos();
        let (a, b) = (sin / speed, (1.0 - cos) / (speed * speed));
        std::array::from_fn(|r| {
            std::array::from_fn(|c| f64::from(u8::from(r == c)) + a * log[r][c] + b * square[r][c])
        })
    }

    fn about(axis: [f64; 3], angle: f64) -> Self {
        let [x, y, z] = axis.map(|a| angle * a);
        [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    }

    fn angle(log: &Self, axis: [f64; 3]) -> f64 {
        vec3::dot(vector(log), axis)
    }
}

/// Returns the axis of an antisymmetric matrix, scaled by its angle.
fn vector(log: &Matrix<3>) -> [f64; 3] {
    [log[2][1], log[0][2], log[1][0]]
}

/// Returns the axis of a rotation by half a turn, R = 2aaᵀ − I.
fn half_turn_axis(rotation: &Matrix<3>) -> [f64; 3] {
    let largest = (0..3)
        .max_by(|&i, &j| rotation[i][i].total_cmp(&rotation[j][j]))
        .unwrap_or(0);
    let column = std::array::from_fn(|r| rotation[r][largest] + f64::from(u8::from(r == largest)));
    vec3::unit(column)
}

/// Returns the rotation that best takes places to others, in the least-squares sense, each about their centroid. `None`
/// for a single place, and in space for places on a line.
pub fn best_rotation<const D: usize>(pairs: &[([f64; D], [f64; D])]) -> Option<Matrix<D>>
where
    Matrix<D>: Square<D>,
{
    let (from, to) = centroids(pairs);
    let mut covariance = [[0.0; D]; D];
    for (p, q) in pairs {
        for r in 0..D {
            for c in 0..D {
                covariance[r][c] += (q[r] - to[r]) * (p[c] - from[c]);
            }
        }
    }
    let svd = covariance.svd(covariance.det());
    let is_determined = svd.sigma[D - 2] > 1e-9 * svd.sigma[0] || D == 2 && svd.sigma[0] > 0.0;
    is_determined.then(|| times(&svd.u, &transposed(&svd.v)))
}

/// Returns the means of both places of pairs; the origin if there are no pairs.
pub fn centroids<const D: usize>(pairs: &[([f64; D], [f64; D])]) -> ([f64; D], [f64; D]) {
    let n = pairs.len().max(1) as f64;
    let (mut from, mut to) = ([0.0; D], [0.0; D]);
    for (p, q) in pairs {
        for k in 0..D {
            from[k] += p[k] / n;
            to[k] += q[k] / n;
        }
    }
    (from, to)
}

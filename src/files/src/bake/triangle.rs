//! Places in a triangle of the plane.

use super::Corners;

/// Weights of the corners of a triangle.
pub(super) type Barycentric = [f64; 3];

/// A triangle with the data for locating points in it.
pub(super) struct Triangle {
    corners: Corners,
    /// Derivatives of the weights of the second and third corner.
    gradients: [[f64; 2]; 2],
}

impl Triangle {
    /// Creates the triangle; returns `None` if it has no area.
    pub fn new(corners: Corners) -> Option<Self> {
        let [a, b, c] = corners;
        let (e, f) = (difference(b, a), difference(c, a));
        let area = e[0] * f[1] - e[1] * f[0];
        let inverse = 1.0 / area;
        inverse.is_finite().then_some(Self {
            corners,
            gradients: [
                [f[1] * inverse, -f[0] * inverse],
                [-e[1] * inverse, e[0] * inverse],
            ],
        })
    }

    /// Returns the weights at a place, some negative outside.
    pub fn weights(&self, at: [f64; 2]) -> Barycentric {
        let d = difference(at, self.corners[0]);
        let [s, t] = self.gradients.map(|g| g[0] * d[0] + g[1] * d[1]);
        [1.0 - s - t, s, t]
    }

    /// Returns the Jacobian of the affine map that takes the corners to `to`, row by row.
    pub fn jacobian(&self, to: &Corners) -> [[f64; 2]; 2] {
        let (e, f) = (difference(to[1], to[0]), difference(to[2], to[0]));
        let [g, h] = self.gradients;
        [0, 1].map(|row| [0, 1].map(|column| e[row] * g[column] + f[row] * h[column]))
    }

    /// Returns the weights at the triangle's point nearest to a place, and the square of its distance.
    pub fn nearest(&self, at: [f64; 2]) -> (Barycentric, f64) {
        let weights = self.weights(at);
        if weights.iter().all(|w| *w >= 0.0) {
            return (weights, 0.0);
        }
        nearest_on_edges(&self.corners, at)
    }
}

/// Returns the weights at the nearest point of a triangle's edges, and the square of its distance.
pub(super) fn nearest_on_edges(corners: &Corners, at: [f64; 2]) -> (Barycentric, f64) {
    let mut nearest = ([0.0; 3], f64::INFINITY);
    for k in 0..3 {
        let next = (k + 1) % 3;
        let edge = difference(corners[next], corners[k]);
        let d = difference(at, corners[k]);
        let length2 = edge[0] * edge[0] + edge[1] * edge[1];
        let along = d[0] * edge[0] + d[1] * edge[1];
        let t = if length2 > 0.0 {
            (along / length2).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let off = [d[0] - t * edge[0], d[1] - t * edge[1]];
        let distance2 = off[0] * off[0] + off[1] * off[1];
        if distance2 < nearest.1 {
            let mut weights = [0.0; 3];
            weights[k] = 1.0 - t;
            weights[next] = t;
            nearest = (weights, distance2);
        }
    }
    nearest
}

/// Returns the weighted mean of the corners.
pub(super) fn blended(weights: Barycentric, corners: &Corners) -> [f64; 2] {
    [0, 1].map(|k| (0..3).map(|c| weights[c] * corners[c][k]).sum())
}

fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

//! A mirror plane.

use unwrapd_method::numerics::vec3::{add_scaled, dot};

/// The points x with normal · x = offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MirrorPlane {
    /// Of length 1.
    pub normal: [f64; 3],
    /// The distance of the plane from the origin along the normal.
    pub offset: f64,
}

impl MirrorPlane {
    /// The plane through a point.
    pub fn through(point: [f64; 3], normal: [f64; 3]) -> Self {
        Self {
            normal,
            offset: dot(normal, point),
        }
    }

    /// How far in front of the plane a point lies; negative behind it.
    pub fn height(&self, p: [f64; 3]) -> f64 {
        dot(self.normal, p) - self.offset
    }

    /// The mirror image of a point.
    pub fn mirrored(&self, p: [f64; 3]) -> [f64; 3] {
        add_scaled(p, -2.0 * self.height(p), self.normal)
    }

    /// The mirror image of a direction.
    pub fn mirrored_direction(&self, v: [f64; 3]) -> [f64; 3] {
        add_scaled(v, -2.0 * dot(self.normal, v), self.normal)
    }
}

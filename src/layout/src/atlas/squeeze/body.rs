//! A chart that is pushed about.
use super::contour::{Run, runs};
use super::field::Field;
use crate::atlas::Rotation;
use crate::atlas::outline::Outline;

/// Where a body is and how it is turned.
#[derive(Clone, Copy, Debug)]
pub(in crate::atlas) struct Pose {
    /// Where its middle is.
    pub middle: [f64; 2],
    /// The angle by which it is turned, counter-clockwise.
    pub angle: f64,
    /// Its cosine and sine.
    turn: [f64; 2],
}

impl Pose {
    pub(in crate::atlas) fn new(middle: [f64; 2], angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self {
            middle,
            angle,
            turn: [cos, sin],
        }
    }

    /// Turned further, and shifted.
    pub(super) fn moved(&self, by: [f64; 2], angle: f64) -> Self {
        Self::new([0, 1].map(|k| self.middle[k] + by[k]), self.angle + angle)
    }

    /// From the frame of the body.
    pub(super) fn place(&self, p: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.turned(p);
        [self.middle[0] + x, self.middle[1] + y]
    }

    /// A vector in the frame of the body.
    pub(super) fn turned(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.turn;
        [c * x - s * y, s * x + c * y]
    }

    /// To the frame of the body.
    pub(super) fn back(&self, p: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.turn;
        let [x, y] = [p[0] - self.middle[0], p[1] - self.middle[1]];
        [c * x + s * y, c * y - s * x]
    }
}

/// A chart in a frame whose origin is the middle of its rectangle, in cells.
pub(in crate::atlas) struct Body {
    pub(super) field: Field,
    pub(super) runs: Vec<Run>,
    /// Half the sides of its rectangle.
    pub(super) half: [f64; 2],
    /// How far it reaches.
    pub(super) radius: f64,
    pub(super) rotation: Rotation,
}

impl Body {
    /// An outline at so many cells per mesh unit, which keeps others so many cells away.
    pub(in crate::atlas) fn new(outline: &Outline, scale: f64, kept: f64) -> Self {
        let half = outline.extent.map(|x| x * scale / 2.0);
        let place = |p: [f64; 2]| [p[0] * scale - half[0], p[1] * scale - half[1]];
        let edges: Vec<[[f64; 2]; 2]> = outline.edges().map(|edge| edge.map(place)).collect();
        let field = Field::new(&edges, kept);
        // A point in a slit touches nothing.
        let runs = runs(&edges, |p| field.at(p).0 > -1.5 * kept - 0.5);
        Self {
            runs,
            field,
            half,
            radius: half[0].hypot(half[1]).max(1.0),
            rotation: if outline.has_copies {
                Rotation::None
            } else {
                outline.rotation()
            },
        }
    }

    /// A rectangle around it.
    pub(super) fn bounds(&self, pose: &Pose) -> [[f64; 2]; 2] {
        let [c, s] = pose.turn.map(f64::abs);
        let [w, h] = self.half;
        let half = [c * w + s * h, s * w + c * h];
        [[-1.0; 2], [1.0; 2]].map(|sign| [0, 1].map(|k| pose.middle[k] + sign[k] * half[k]))
    }
}

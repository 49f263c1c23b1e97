//! The ways in which one chart may lie.
use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, OnceLock};

use super::mask::{Distances, Mask};
use super::outline::Outline;
use super::squeeze::Body;
use super::turned::Turned;

/// Angles within a quarter turn.
const ANGLES: usize = 16;
/// What is kept free beside the padding, as distances are looked up roughly and rounded up to cells of the fine raster later.
const ROOM: f64 = 0.2;

/// The angle of a pose; a chart that is upright is turned by quarters only.
fn angle_of(pose: usize, is_upright: bool) -> f64 {
    let sixteenths = if is_upright { 0 } else { pose / 4 };
    FRAC_PI_2 * (sixteenths as f64 / ANGLES as f64 + (pose % 4) as f64)
}

/// An outline at 64 angles, each rastered when it is first asked for.
pub(super) struct Poses {
    /// One that is upright has the same at every angle.
    outlines: Vec<Outline>,
    masks: Vec<OnceLock<Turned>>,
    body: OnceLock<Arc<Body>>,
    scale: f64,
    distances: Distances,
}

impl Poses {
    /// Pose `4 a + t` is turned by t quarters and a sixteenths of a quarter.
    pub(super) const COUNT: usize = 4 * ANGLES;

    pub(super) fn new(outline: &Outline, scale: f64, distances: Distances) -> Self {
        let angle = |k: usize| angle_of(4 * k, outline.upright.is_some());
        Self {
            outlines: (0..ANGLES).map(|k| outline.rotated(angle(k))).collect(),
            masks: (0..Self::COUNT).map(|_| OnceLock::new()).collect(),
            body: OnceLock::new(),
            scale,
            distances,
        }
    }

    /// The pose at the next angle, or that before.
    pub(super) fn next_angle(pose: usize, is_after: bool) -> usize {
        let by = if is_after { 4 } else { Self::COUNT - 4 };
        (pose + by) % Self::COUNT
    }

    /// The outline of a pose, without its quarter turns.
    pub(super) fn outline(&self, pose: usize) -> &Outline {
        &self.outlines[pose / 4]
    }

    /// The quarter turns of a pose.
    pub(super) fn turns(pose: usize) -> u32 {
        pose as u32 % 4
    }

    /// The angle of a pose.
    pub(super) fn angle(&self, pose: usize) -> f64 {
        angle_of(pose, self.outlines[0].upright.is_some())
    }

    /// The chart at the first angle, to be pushed about.
    pub(super) fn body(&self) -> Arc<Body> {
        let new = || Body::new(self.outline(0), self.scale, self.distances.padding + ROOM);
        self.body.get_or_init(|| Arc::new(new())).clone()
    }

    pub(super) fn mask(&self, pose: usize) -> &Turned {
        self.masks[pose].get_or_init(|| {
            let mask = Mask::new(self.outline(pose), self.scale, self.distances);
            Turned::new(mask, Self::turns(pose))
        })
    }
}

//! The ways in which one chart may lie.
use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, OnceLock};

use super::Rotation;
use super::mask::{Distances, Mask};
use super::orientation::smallest_page;
use super::outline::Outline;
use super::squeeze::Body;
use super::turned::Turned;
use unwrapd_method::numerics::hull::convex_hull;

/// Angles within a quarter turn.
const ANGLES: usize = 16;
/// What is kept free beside the padding, in cells: distances are looked up roughly.
const ROOM: f64 = 0.1;

/// The ways in which an outline may lie, each rastered when it is first asked for: 64, four quarter turns, or one.
///
/// Pose `4 a + t` is turned by t quarters and a sixteenths of a quarter.
pub(super) struct Poses {
    /// For each angle within a quarter turn.
    outlines: Vec<Outline>,
    masks: Vec<OnceLock<Turned>>,
    /// Poses of which no two look alike.
    distinct: OnceLock<Vec<usize>>,
    body: OnceLock<Arc<Body>>,
    least_page: OnceLock<f64>,
    scale: f64,
    distances: Distances,
}

impl Poses {
    pub(super) fn new(outline: &Outline, scale: f64, distances: Distances) -> Self {
        let (angles, quarters) = match outline.rotation() {
            Rotation::Any => (ANGLES, 4),
            Rotation::Quarter => (1, 4),
            Rotation::None => (1, 1),
        };
        let angle = |a: usize| FRAC_PI_2 * a as f64 / ANGLES as f64;
        Self {
            outlines: (0..angles).map(|a| outline.rotated(angle(a))).collect(),
            masks: (0..quarters * angles).map(|_| OnceLock::new()).collect(),
            distinct: OnceLock::new(),
            body: OnceLock::new(),
            least_page: OnceLock::new(),
            scale,
            distances,
        }
    }

    /// Poses of which no two look alike on the raster: of a rectangle there are two, of a square there is one.
    pub(super) fn distinct(&self) -> &[usize] {
        self.distinct.get_or_init(|| {
            let mut distinct: Vec<usize> = Vec::new();
            for pose in 0..self.masks.len() {
                let is_new = |&known: &usize| !self.mask(known).is_like(self.mask(pose));
                if self.outlines.len() > 1 || distinct.iter().all(is_new) {
                    distinct.push(pose);
                }
            }
            distinct
        })
    }

    /// The pose at the next angle, or that before.
    pub(super) fn next_angle(&self, pose: usize, is_after: bool) -> usize {
        let angles = self.outlines.len();
        let next = |place: usize, all: usize| (place + if is_after { 1 } else { all - 1 }) % all;
        if angles == 1 {
            let distinct = self.distinct();
            let place = distinct.iter().position(|&known| known == pose);
            return distinct[next(place.unwrap_or(0), distinct.len())];
        }
        let place = next(angles * (pose % 4) + pose / 4, self.masks.len());
        4 * (place % angles) + place / angles
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
    pub(super) fn angle(pose: usize) -> f64 {
        FRAC_PI_2 * ((pose / 4) as f64 / ANGLES as f64 + (pose % 4) as f64)
    }

    /// The chart at the first angle, to be pushed about.
    pub(super) fn body(&self) -> Arc<Body> {
        let new = || Body::new(self.outline(0), self.scale, self.distances.padding + ROOM);
        self.body.get_or_init(|| Arc::new(new())).clone()
    }

    /// The longer side of the smallest page around it, without borders, in mesh units; of pages whose sides along u and v are the
    /// longer one halved so often.
    pub(super) fn least_page(&self, halvings: [u32; 2]) -> f64 {
        let least = || smallest_page(&convex_hull(self.outline(0).corners()), halvings).1;
        *self.least_page.get_or_init(least)
    }

    pub(super) fn mask(&self, pose: usize) -> &Turned {
        self.masks[pose].get_or_init(|| {
            let mask = Mask::new(self.outline(pose), self.scale, self.distances);
            Turned::new(mask, Self::turns(pose))
        })
    }
}

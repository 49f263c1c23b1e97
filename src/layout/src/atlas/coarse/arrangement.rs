//! Arrangements: an order of the charts and a pose for each, from which their places follow.
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use crate::atlas::mask::{Distances, Mask, Turned};
use crate::atlas::occupancy::{Corner, Occupancy, Window};
use crate::atlas::outline::Outline;
use crate::atlas::problem::Rotation;
use crate::atlas::squeeze::Body;
use unwrapd_method::numerics::random::Random;

/// Number of random poses tried to fit a chart to its place.
const FITTED: usize = 12;

/// Order of the charts, pose of each, and the resulting places.
#[derive(Clone)]
pub(super) struct Arrangement {
    pub order: Vec<usize>,
    pub pose: Vec<usize>,
    /// Lower left corner of each chart.
    pub corners: Vec<Corner>,
    pub side: u32,
    /// Side in cells, plus a fraction below 1 that increases with the mean distance to which charts extend.
    pub cost: f64,
}

impl Arrangement {
    /// Occupies the cells of the charts at `places` of the order.
    pub(super) fn take(
        &self,
        poses: &[Arc<Poses>],
        occupancy: &mut Occupancy,
        places: Range<usize>,
    ) {
        for &chart in &self.order[places] {
            occupancy.take(poses[chart].mask(self.pose[chart]), self.corners[chart]);
        }
    }

    /// Places the charts at `places` of the order on an occupancy that holds the charts before them; later charts do not count.
    /// Does not occupy the cells of the last one. Returns `None` if a page of side `largest` is too small.
    pub(super) fn lay_out(
        &mut self,
        poses: &[Arc<Poses>],
        occupancy: &mut Occupancy,
        places: Range<usize>,
        largest: u32,
    ) -> Option<()> {
        occupancy.capacity = largest;
        let form = occupancy.form;
        let (mut reach, mut side) = (0, 0);
        for (place, &chart) in self.order[..places.end].iter().enumerate() {
            let mask = poses[chart].mask(self.pose[chart]);
            if place >= places.start {
                let (_, corner) = occupancy.find(std::slice::from_ref(mask), Window::ALL)?;
                self.corners[chart] = corner;
                if place + 1 < places.end {
                    occupancy.take(mask, corner);
                }
            }
            let corner = self.corners[chart];
            let [width, height] = mask.size;
            let far = form.side([corner.x + width, corner.y + height]);
            reach += far;
            side = side.max(far);
        }
        if side > largest {
            return None;
        }
        self.side = side;
        let most = f64::from(side) * places.end as f64 + 1.0;
        self.cost = f64::from(side) + f64::from(reach) / most;
        Some(())
    }

    /// Turns the chart at a place of the order to the best of a few poses: the one in which it extends least far on an occupancy
    /// that holds the charts before it, within its capacity. Leaves the chart as it is if no pose fits.
    pub(super) fn fit(
        &mut self,
        place: usize,
        poses: &[Arc<Poses>],
        occupancy: &mut Occupancy,
        random: &mut Random,
    ) {
        let chart = self.order[place];
        let distinct = poses[chart].distinct();
        let mut least = u64::MAX;
        for _ in 0..FITTED {
            let pose = distinct[random.below(distinct.len())];
            let mask = poses[chart].mask(pose);
            let Some((_, corner)) = occupancy.find(std::slice::from_ref(mask), Window::ALL) else {
                continue;
            };
            let [width, height] = mask.size;
            let far = [corner.x + width, corner.y + height];
            let side = occupancy.form.side(far).max(occupancy.side());
            let reach = u64::from(side) << 32 | u64::from(far[0] + far[1]);
            if reach < least {
                (least, self.pose[chart]) = (reach, pose);
                // A pose that needs a longer side is no better.
                occupancy.capacity = side;
            }
        }
    }

    /// Gives the pose of the chart at a place to its copies. Returns the first place that changed.
    pub(super) fn copy_pose(&mut self, place: usize, kind: &[usize]) -> usize {
        let chart = self.order[place];
        let pose = self.pose[chart];
        let mut first = place;
        for (other, &copy) in self.order.iter().enumerate() {
            if kind[copy] == kind[chart] && self.pose[copy] != pose {
                self.pose[copy] = pose;
                first = first.min(other);
            }
        }
        first
    }

    /// Changes the place of a random chart among the first `n` of the order, or its pose. Returns the first place that is affected,
    /// and whether the chart there is to be [fitted](Self::fit).
    pub(super) fn change(
        &mut self,
        n: usize,
        poses: &[Arc<Poses>],
        random: &mut Random,
    ) -> (usize, bool) {
        let [i, j] = [random.below(n), random.below(n)];
        let chart = self.order[i];
        let of_chart = &poses[chart];
        let pose = &mut self.pose[chart];
        match random.below(5) {
            0 => self.order.swap(i, j),
            1 => {
                self.order.remove(i);
                self.order.insert(j, chart);
            }
            2 => {
                *pose = of_chart.next_angle(*pose, random.below(2) == 0);
                return (i, false);
            }
            3 => return (i, true),
            _ => {
                let distinct = of_chart.distinct();
                *pose = distinct[random.below(distinct.len())];
                return (i, false);
            }
        }
        (i.min(j), false)
    }

    /// Returns whether every chart has the same pose and place in both.
    pub(super) fn lies_like(&self, other: &Self) -> bool {
        self.pose == other.pose && self.corners == other.corners
    }

    /// Returns a hash that almost surely differs between arrangements that look different. `kind` contains for each chart the first
    /// chart that looks like it in each pose.
    ///
    /// From: Fowler, Noll, Vo 1991 (FNV-1a), over words.
    pub(super) fn key(&self, kind: &[usize]) -> u64 {
        let looks = |&chart: &usize| (kind[chart] as u64) << 8 | self.pose[chart] as u64;
        let mixed = |key: u64, effort: u64| (key ^ effort).wrapping_mul(0x0000_0100_0000_01b3);
        let looks = self.order.iter().map(looks);
        looks.fold(0xcbf2_9ce4_8422_2325, |key, effort| {
            let key = mixed(key, effort);
            key ^ key >> 29
        })
    }
}

/// Occupancies with all charts before each place of an arrangement, so that a trial need not occupy their cells again.
pub(super) struct Prefixes {
    /// Snapshots that were needed so far.
    snapshots: Vec<Occupancy>,
}

impl Prefixes {
    /// Creates the snapshots of an arrangement from an empty occupancy.
    pub(super) fn new(empty: Occupancy) -> Self {
        Self {
            snapshots: vec![empty],
        }
    }

    /// Makes an occupancy hold the charts of an arrangement before a place, and nothing else.
    pub(super) fn hold(
        &mut self,
        occupancy: &mut Occupancy,
        state: &Arrangement,
        poses: &[Arc<Poses>],
        place: usize,
    ) {
        for n in self.snapshots.len()..=place {
            let mut next = self.snapshots[n - 1].clone();
            state.take(poses, &mut next, n - 1..n);
            self.snapshots.push(next);
        }
        occupancy.restore(&self.snapshots[place]);
    }

    /// Removes the snapshots that are outdated once the charts from a place on have changed.
    pub(super) fn change(&mut self, place: usize) {
        self.snapshots.truncate(place + 1);
    }
}

/// Number of angles within a quarter turn.
const ANGLES: usize = 16;

/// Poses of an outline, each rasterized when it is first needed: 64 for any angle, 4 for quarter turns, or 1.
///
/// Pose `4 a + t` is turned by t quarters and a sixteenths of a quarter.
pub(super) struct Poses {
    /// Outline at each angle within a quarter turn.
    outlines: Vec<Outline>,
    /// Mask at each of these angles.
    masks: Vec<OnceLock<Mask>>,
    /// Mask of each pose.
    turned: Vec<OnceLock<Turned>>,
    /// Poses that differ on the raster.
    distinct: OnceLock<Vec<usize>>,
    body: OnceLock<Arc<Body>>,
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
            masks: (0..angles).map(|_| OnceLock::new()).collect(),
            turned: (0..quarters * angles).map(|_| OnceLock::new()).collect(),
            distinct: OnceLock::new(),
            body: OnceLock::new(),
            scale,
            distances,
        }
    }

    /// Returns the poses that differ on the raster. If only quarter turns are permitted, a rectangle has two and a square has one.
    /// If any angle is permitted, returns all poses.
    pub(super) fn distinct(&self) -> &[usize] {
        self.distinct.get_or_init(|| {
            let mut distinct: Vec<usize> = Vec::new();
            for pose in 0..self.turned.len() {
                let is_new = |&known: &usize| !self.mask(known).is_like(self.mask(pose));
                if self.outlines.len() > 1 || distinct.iter().all(is_new) {
                    distinct.push(pose);
                }
            }
            distinct
        })
    }

    /// Returns the pose at the next angle, or at the previous one.
    pub(super) fn next_angle(&self, pose: usize, is_after: bool) -> usize {
        let angles = self.outlines.len();
        let next = |place: usize, all: usize| (place + if is_after { 1 } else { all - 1 }) % all;
        if angles == 1 {
            let distinct = self.distinct();
            let place = distinct.iter().position(|&known| known == pose);
            return distinct[next(place.unwrap_or(0), distinct.len())];
        }
        let place = next(angles * (pose % 4) + pose / 4, self.turned.len());
        4 * (place % angles) + place / angles
    }

    /// Returns the outline of the first pose.
    pub(super) fn level(&self) -> &Outline {
        &self.outlines[0]
    }

    /// Returns the position of the center of the first pose in a pose, from its lower left corner, in cells.
    pub(super) fn middle(&self, pose: usize) -> [f64; 2] {
        let middle = self.outlines[pose / 4].place(self.level().middle());
        let [i, j] = middle.map(|x| x * self.scale);
        let [width, height] = self.mask(pose).size.map(f64::from);
        match pose % 4 {
            0 => [i, j],
            1 => [width - j, i],
            2 => [width - i, height - j],
            _ => [j, height - i],
        }
    }

    /// Returns the angle of a pose, in radians.
    pub(super) fn angle(pose: usize) -> f64 {
        FRAC_PI_2 * ((pose / 4) as f64 / ANGLES as f64 + (pose % 4) as f64)
    }

    /// Returns the chart at the first angle, as a body that can be moved.
    pub(super) fn body(&self) -> Arc<Body> {
        let new = || Body::new(self.level(), self.scale, self.distances.padding);
        self.body.get_or_init(|| Arc::new(new())).clone()
    }

    pub(super) fn mask(&self, pose: usize) -> &Turned {
        let outline = &self.outlines[pose / 4];
        let new = || Mask::new(outline, self.scale, self.distances);
        let mask = || self.masks[pose / 4].get_or_init(new);
        self.turned[pose].get_or_init(|| Turned::new(mask(), pose as u32 % 4))
    }
}

//! Layouts squeezed into a smaller page.
//!
//! Placing charts one after the other leaves room between them that no order and no small set of angles removes. Here, all charts
//! move and turn at once: the page shrinks a little, and charts that then overlap are pushed apart. This minimizes the sum of the
//! squared depths of points of one chart within the reach of another (Levenberg's method).
//!
//! Distances are looked up in rasters, so a layout is only accurate to a fraction of a cell, and the caller has to measure it.
//!
//! From: Imamichi, Yagiura, Nagamochi 2009, An iterated local search algorithm based on nonlinear programming for the irregular
//! strip packing problem.
mod body;
mod field;
mod overlap;

use std::sync::Arc;

use super::effort::{OnRead, ReadLimit, UNHEARD};
use super::outline::Outline;
use super::page::Frame;
pub(super) use body::{Body, Pose};
use overlap::{Equations, Scene};
use unwrapd_method::numerics::bounds::Bounds;

/// Share by which the side of the page shrinks at a time: at first, and at last, when shrinking ends.
const SHRINKS: [f64; 2] = [0.01, 4e-4];
/// First share by which a page shrinks that has already been squeezed. With the share above, pages are as full, but charts end farther
/// apart than they have to be.
const LEAP: f64 = 0.004;
/// Share by which the page grows while charts overlap.
const GROWTH: f64 = 0.01;
/// Share of the energy of an overlap that is left after growing from which on growing does not help.
const STUCK: f64 = 0.9;
/// Maximum number of times that the page grows. Where many small charts overlap, each of them may have to jump; with 16, one of 121 sets
/// of charts could not be separated.
const MOST_GROWTHS: usize = 48;

/// State in which squeezing ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// Charts overlap.
    Overlapping,
    /// The page may shrink further.
    OutOfWords,
    /// Charts leave no room for a smaller page.
    Stuck,
}

/// Poses of charts on a page, or on several pages with islands that stay.
#[derive(Clone)]
pub(super) struct Squeezed {
    pub poses: Vec<Pose>,
    /// Longer side of the page, without borders, in cells.
    pub side: f64,
    /// Distance kept between charts, and to two opposite borders together, in cells.
    pub padding: f64,
    /// Cells per mesh unit.
    pub scale: f64,
    /// Frame of each chart.
    pub frames: Arc<[Frame]>,
    pub fixed: Arc<[FixedBody]>,
}

/// Island that stays where it is on the page, and grows with it.
#[derive(Clone)]
pub(in crate::atlas) struct FixedBody {
    body: Arc<Body>,
    /// Center of its bounding rectangle, in longer sides of a page with its borders.
    middle: [f64; 2],
    /// Angle by which it is turned, in radians.
    angle: f64,
    /// Longer side of a page with its borders for which the body was made, in cells.
    page: f64,
}

impl FixedBody {
    /// Creates an island from its outline in longer sides of a page, which has `page` cells along that side with its borders. Other
    /// charts keep `kept` cells away.
    pub(super) fn new(outline: &Outline, page: f64, kept: f64) -> Self {
        let upright = outline.turned([1.0, 0.0]);
        Self {
            body: Arc::new(Body::new(&upright, page, kept)),
            middle: upright.middle(),
            angle: 0.0,
            page,
        }
    }

    /// Returns the island at another center and angle.
    pub(super) fn moved(&self, middle: [f64; 2], angle: f64) -> Self {
        Self {
            middle,
            angle,
            ..self.clone()
        }
    }

    /// Returns the pose on a page with `side` cells along its longer side without borders.
    fn pose(&self, side: f64, padding: f64) -> Pose {
        let page = side + padding;
        let middle = self.middle.map(|x| x * page - padding / 2.0);
        Pose::new(middle, self.angle).stretched(page / self.page)
    }
}

impl Squeezed {
    /// Creates a page with `page` cells along its longer side, borders included, from the pose and the frame of each chart.
    pub(super) fn new(
        charts: impl Iterator<Item = (Pose, Frame)>,
        fixed: Arc<[FixedBody]>,
        page: f64,
        padding: f64,
        scale: f64,
    ) -> Self {
        let (poses, frames): (_, Vec<Frame>) = charts.unzip();
        Self {
            poses,
            frames: frames.into(),
            fixed,
            side: page - padding,
            padding,
            scale,
        }
    }

    /// Separates overlapping charts, growing the page if needed, then shrinks the page as far as charts make room for each other
    /// where they are. Stops shrinking once about `words` words are read.
    pub(super) fn settle(&mut self, bodies: &[Arc<Body>], words: u64, on_read: &OnRead) -> End {
        self.squeeze(bodies, 0.0, SHRINKS[0], ReadLimit::new(words, on_read))
    }

    /// Separates charts by `room` more cells than their bodies keep, then shrinks the page, at first by the share `first`.
    fn squeeze(&mut self, bodies: &[Arc<Body>], room: f64, first: f64, limit: ReadLimit) -> End {
        let mut scene = Scene::new(bodies, self, room, limit);
        if !self.grow(&mut scene) {
            return End::Overlapping;
        }
        let mut by = first;
        while by > SHRINKS[1] {
            if !scene.may_read() {
                return End::OutOfWords;
            }
            if !self.shrink_once(&mut scene, by) {
                by /= 2.0;
            }
        }
        End::Stuck
    }

    /// Returns the bounds of each chart, in cells.
    pub(super) fn bounds(&self) -> Vec<Bounds> {
        let frames = self.frames.iter();
        frames
            .map(|frame| frame.bounds(self.side, self.padding))
            .collect()
    }

    /// Separates charts, growing the page whenever that fails. Where growing does not help, a chart lies in a gap of
    /// another one that is too narrow, and jumps out of it. Returns whether the charts are apart.
    fn grow(&mut self, scene: &mut Scene) -> bool {
        let mut before = f64::INFINITY;
        for _ in 0..MOST_GROWTHS {
            let left = scene.separate(&mut self.poses);
            if left.are_apart() {
                return true;
            }
            self.enlarge(1.0 + GROWTH);
            scene.resize(self);
            if left.energy > STUCK * before
                && let Some(pair) = left.deepest_pair
            {
                scene.jump(&mut self.poses, pair);
            }
            before = left.energy;
        }
        false
    }

    /// Makes charts keep `room` more cells than their bodies require, growing the page if needed, then shrinks the page. Stops
    /// shrinking once about `words` words are read. Returns whether charts keep that distance.
    pub(super) fn loosen(
        &mut self,
        bodies: &[Arc<Body>],
        room: f64,
        words: u64,
        on_read: &OnRead,
    ) -> bool {
        let limit = ReadLimit::new(words, on_read);
        self.squeeze(bodies, room, LEAP, limit) != End::Overlapping
    }

    /// Separates charts after an island has moved, growing the page if needed, then shrinks it to `side` as far as they make room. Returns
    /// whether no overlap remains.
    pub(super) fn follow(&mut self, bodies: &[Arc<Body>], side: f64) -> bool {
        let limit = ReadLimit::new(u64::MAX, UNHEARD);
        let mut scene = Scene::new(bodies, self, 0.0, limit);
        scene.most_steps = STEPS_PER_MOVE;
        let is_apart = self.grow(&mut scene);
        let by = LEAP.min(1.0 - side / self.side);
        if is_apart && by > 0.0 {
            self.shrink_once(&mut scene, by);
        }
        is_apart
    }

    /// Returns the page on a raster that is `by` times as fine.
    pub(super) fn refined(&self, by: f64) -> Self {
        let mut refined = self.clone();
        refined.enlarge(by);
        refined.padding = by * self.padding;
        refined.scale = by * self.scale;
        refined
    }

    /// Returns the page with the distances between the charts scaled.
    pub(super) fn spread(&self, by: f64) -> Self {
        let mut spread = self.clone();
        spread.enlarge(by);
        spread
    }

    /// Scales the page and the positions on it, but not the charts.
    fn enlarge(&mut self, by: f64) {
        self.side *= by;
        for pose in &mut self.poses {
            pose.middle = pose.middle.map(|x| x * by);
        }
    }

    /// Shrinks the page by a share if the charts can then be separated where they are. Returns whether they can.
    fn shrink_once(&mut self, scene: &mut Scene, by: f64) -> bool {
        let mut trial = self.clone();
        trial.enlarge(1.0 - by);
        scene.resize(&trial);
        let are_apart = scene.separate(&mut trial.poses).are_apart();
        if are_apart {
            *self = trial;
        }
        are_apart
    }
}

impl<'a> Scene<'a> {
    fn new(bodies: &[Arc<Body>], squeezed: &Squeezed, room: f64, limit: ReadLimit<'a>) -> Self {
        let fixed = squeezed.fixed.iter().map(|fixed| &fixed.body);
        let mut scene = Self {
            bodies: bodies.iter().chain(fixed).cloned().collect(),
            bounds: Vec::new(),
            fixed: Vec::new(),
            room,
            most_steps: STEPS,
            work: 0,
            limit,
        };
        scene.resize(squeezed);
        scene
    }

    /// Updates everything that grows with the page.
    fn resize(&mut self, squeezed: &Squeezed) {
        let Squeezed { side, padding, .. } = *squeezed;
        let fixed = squeezed.fixed.iter();
        self.bounds = squeezed.bounds();
        self.fixed = fixed.map(|fixed| fixed.pose(side, padding)).collect();
    }

    /// Returns whether the search may go on.
    fn may_read(&mut self) -> bool {
        self.limit.admits(self.work)
    }

    /// Returns whether the caller has ended the search.
    fn is_ended(&mut self) -> bool {
        self.limit.is_ended(self.work)
    }
}

/// Maximum number of steps that separate bodies. With 50, 108 sets of charts are fuller by .0001 at the mean; with 10, emptier by .0005.
const STEPS: usize = 25;
/// Value that replaces [`STEPS`] while an island is dragged: with few charts in the way, a few steps are enough.
const STEPS_PER_MOVE: usize = 10;
/// Initial damping of Levenberg's method.
const DAMPING: f64 = 1e-2;
/// Factors of the damping after a step that is accepted and after one that is rejected.
const AFTER_STEP: [f64; 2] = [0.25, 6.0];
/// A step is slow if it leaves more than this share of the energy. With .97, packing 36 sets of charts takes a fifth longer, and they are
/// no fuller (`tests/bench/stable.rs`, `tests/bench/packing.rs`).
const SLOW: f64 = 0.9;
/// Number of consecutive slow steps that end the iteration. With two, some charts lose .03 of fill
/// (`optima::charts_that_lie_rotated_fill_as_much`).
const MOST_SLOW: usize = 3;
/// Number of places along each side of a page that a body that jumps may choose among.
const PLACES: usize = 32;

impl Scene<'_> {
    /// Separates all bodies, as far as possible from where they are. Returns the equations of the overlaps that are left.
    ///
    /// From: Levenberg 1944, A Method for the Solution of Certain Non-Linear Problems in Least Squares.
    fn separate(&mut self, poses: &mut Vec<Pose>) -> Equations {
        let mut now = Equations::new(self, poses);
        let mut damping = DAMPING;
        let mut slow = 0;
        for _ in 0..self.most_steps {
            if now.are_apart() || slow == MOST_SLOW || self.is_ended() {
                break;
            }
            let trial = now.step(damping).map(|step| self.stepped(poses, &step));
            let next = trial.map(|trial| (Equations::new(self, &trial), trial));
            if let Some((next, trial)) = next.filter(|(next, _)| next.energy < now.energy) {
                slow = if next.energy > SLOW * now.energy {
                    slow + 1
                } else {
                    0
                };
                (now, *poses) = (next, trial);
                damping *= AFTER_STEP[0];
            } else {
                damping *= AFTER_STEP[1];
            }
        }
        now
    }

    /// Moves the smaller of two bodies to the lowest place of its page with room for it, or else to the one farthest from all others.
    fn jump(&mut self, poses: &mut [Pose], [a, b]: [usize; 2]) {
        let radius = |body: usize| self.bodies[body].radius;
        // Bodies that stay come last.
        let body = if b >= poses.len() || radius(a) < radius(b) {
            a
        } else {
            b
        };
        let [low, high] = self.bounds[body];
        let all: Vec<Pose> = poses.iter().chain(&self.fixed).copied().collect();
        let others = || (0..all.len()).filter(|&other| other != body);
        let mut farthest = (f64::NEG_INFINITY, poses[body].middle);
        for place in 0..PLACES * PLACES {
            let at = |k: usize, step: usize| {
                low[k] + (step as f64 + 0.5) / PLACES as f64 * (high[k] - low[k])
            };
            let middle = [at(0, place % PLACES), at(1, place / PLACES)];
            let distance = |other: usize| self.bodies[other].least_distance(&all[other], middle);
            let free = others().map(distance).fold(f64::INFINITY, f64::min);
            if free > farthest.0 {
                farthest = (free, middle);
            }
            if free >= radius(body) {
                break;
            }
        }
        self.work += (PLACES * PLACES * all.len()) as u64;
        poses[body].middle = farthest.1;
    }

    fn stepped(&self, poses: &[Pose], step: &[[f64; 3]]) -> Vec<Pose> {
        let bodies = self.bodies.iter().zip(poses).zip(step);
        bodies
            .map(|((body, pose), &[x, y, arc])| pose.moved([x, y], arc / body.radius))
            .collect()
    }
}

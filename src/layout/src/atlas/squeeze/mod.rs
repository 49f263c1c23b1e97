//! Layouts squeezed into a smaller square.
//!
//! Placing charts one after the other leaves room between them that no order and no angle out of a few takes away. Here all
//! charts move and turn at once: the square shrinks by a little, and where charts overlap then they are pushed apart, the sum of
//! squares of how deep points of one lie within the reach of another being minimized (Levenberg's method). Where that does not
//! help, the charts that overlap try other places, overlaps that persist weighing more and more.
//!
//! Distances are looked up in rasters, so a layout is right up to a fraction of a cell; whoever uses it has to effort again.
//! From: Egeblad, Nielsen, Odgaard 2007, Fast neighborhood search for two- and three-dimensional nesting problems (guided local
//! search); Imamichi, Yagiura, Nagamochi 2009, An iterated local search algorithm based on nonlinear programming for the
//! irregular strip packing problem.
mod body;
mod field;
mod overlap;
mod relocate;

use std::sync::Arc;

use super::OnRead;
use super::effort::ReadLimit;
use super::page::Shape;
pub(super) use body::{Body, Pose};
use overlap::{Equations, Pairs, Scene};
use unwrapd_method::numerics::random::Random;

/// By how much the square's side shrinks at a time, at first and at last, as a share.
const SHRINKS: [f64; 2] = [0.01, 4e-4];
/// The same where charts may go elsewhere.
const LEAP: f64 = 0.004;
/// By how much the page grows where charts overlap, and where they need a little more room, and how often at most.
const GROWTHS: [f64; 2] = [0.01, 1e-3];
const MOST_GROWTHS: usize = 16;
/// Steps that separate charts.
const STEPS: usize = 50;
/// Rounds of moves elsewhere that do not lessen the overlap, after which the square is as small as it gets from there.
const MOST_IDLE: usize = 6;
/// A round is idle that leaves more than this share of the least overlap so far.
const IDLE: f64 = 0.98;
/// What an overlap's weight is multiplied by in each round while it lasts, at least and at most, and once it is gone.
const HEAVIER: [f64; 2] = [1.2, 2.0];
const LIGHTER: f64 = 0.95;

/// Charts on a page whose longer side, without its borders, has some length.
#[derive(Clone)]
pub(super) struct Squeezed {
    pub poses: Vec<Pose>,
    pub side: f64,
    pub shape: Shape,
}

impl Squeezed {
    /// Lets charts that overlap go apart, the page growing as it takes, then shrinks it as far as they make room for each other where
    /// they are; reads about so many words at most. Whether they are apart.
    pub(super) fn settle(&mut self, bodies: &[Arc<Body>], words: u64, on_read: &OnRead) -> bool {
        let limit = ReadLimit::new(words, on_read);
        let mut scene = Scene::new(bodies, self.reach(), 0.0, limit);
        let is_apart = self.grow(&mut scene, GROWTHS[0]);
        if is_apart {
            self.shrink(&mut scene, SHRINKS[0]);
        }
        is_apart
    }

    /// How far charts may reach to the right and up.
    fn reach(&self) -> [f64; 2] {
        self.shape.reach(self.side)
    }

    /// Brings charts apart, the page growing by such a share at a time; whether they are.
    fn grow(&mut self, scene: &mut Scene, by: f64) -> bool {
        for _ in 0..MOST_GROWTHS {
            if scene.separate(&mut self.poses, STEPS).1 {
                return true;
            }
            self.scale(1.0 + by);
            scene.reach = self.reach();
        }
        false
    }

    /// Makes charts keep `room` more than before, the square as small as is found while about so many words are read; whether
    /// they do.
    pub(super) fn loosen(
        &mut self,
        bodies: &[Arc<Body>],
        room: f64,
        (words, on_read): (u64, &OnRead),
    ) -> bool {
        let limit = ReadLimit::new(words, on_read);
        let mut scene = Scene::new(bodies, self.reach(), room, limit);
        let is_apart = self.grow(&mut scene, GROWTHS[1]);
        if is_apart {
            self.shrink(&mut scene, LEAP);
        }
        is_apart
    }

    /// Shrinks the square as far as is found while about so many words are read.
    pub(super) fn search(&mut self, bodies: &[Arc<Body>], words: u64, seed: u64, on_read: &OnRead) {
        let mut random = Random::new(seed);
        let limit = ReadLimit::new(words, on_read);
        let mut scene = Scene::new(bodies, self.reach(), 0.0, limit);
        let mut is_stuck = false;
        while scene.may_read() {
            let mut trial = self.clone();
            if is_stuck {
                trial.swap(&mut random);
            }
            trial.scale(1.0 - LEAP);
            is_stuck = !trial.relocate(&mut scene, &mut random);
            if !is_stuck {
                trial.shrink(&mut scene, LEAP);
                *self = trial;
            }
        }
    }

    /// Lets two charts change places.
    fn swap(&mut self, random: &mut Random) {
        let [a, b] = [0, 1].map(|_| random.below(self.poses.len()));
        let middle = self.poses[a].middle;
        self.poses[a].middle = std::mem::replace(&mut self.poses[b].middle, middle);
    }

    /// The same on a raster so many times as fine.
    pub(super) fn refined(&self, by: f64) -> Self {
        let mut refined = self.clone();
        refined.scale(by);
        refined.shape = self.shape.scaled(by);
        refined
    }

    /// Scales the page and the places on it, not the charts.
    fn scale(&mut self, by: f64) {
        self.side *= by;
        for pose in &mut self.poses {
            pose.middle = pose.middle.map(|x| x * by);
        }
    }

    fn shrink(&mut self, scene: &mut Scene, first: f64) {
        scene.weights = Pairs::new(self.poses.len(), 1.0);
        let mut by = first;
        while by > SHRINKS[1] && scene.may_read() {
            let mut trial = self.clone();
            trial.scale(1.0 - by);
            scene.reach = trial.reach();
            if scene.separate(&mut trial.poses, STEPS).1 {
                *self = trial;
            } else {
                by /= 2.0;
            }
        }
    }

    /// Separates charts by moving those that overlap to wherever they overlap least; whether that succeeded.
    fn relocate(&mut self, scene: &mut Scene, random: &mut Random) -> bool {
        scene.reach = self.reach();
        scene.weights = Pairs::new(self.poses.len(), 1.0);
        let (mut overlap, mut is_apart) = scene.separate(&mut self.poses, STEPS);
        let (mut least, mut idle) = (f64::INFINITY, 0);
        while !is_apart && idle < MOST_IDLE && scene.may_read() {
            scene.reweigh(&overlap);
            scene.move_overlapping(&mut self.poses, &overlap, random);
            (overlap, is_apart) = scene.separate(&mut self.poses, STEPS / 2);
            let sum: f64 = overlap.iter().map(|(.., overlap)| overlap).sum();
            idle = if sum < IDLE * least { 0 } else { idle + 1 };
            least = least.min(sum);
        }
        is_apart
    }
}

impl<'a> Scene<'a> {
    fn new(bodies: &'a [Arc<Body>], reach: [f64; 2], room: f64, limit: ReadLimit<'a>) -> Self {
        Self {
            bodies,
            reach,
            room,
            weights: Pairs::new(bodies.len(), 1.0),
            work: 0,
            limit,
        }
    }

    /// Whether the search goes on.
    fn may_read(&mut self) -> bool {
        self.limit.admits(self.work)
    }

    /// Whether the caller has ended it.
    fn is_ended(&mut self) -> bool {
        self.limit.is_ended(self.work)
    }

    /// Makes overlaps count more that are there still.
    fn reweigh(&mut self, overlap: &Pairs) {
        let most = overlap
            .iter()
            .map(|(.., overlap)| overlap)
            .fold(0.0, f64::max);
        for (a, b, overlap) in overlap.iter() {
            let weight = self.weights.get_mut(a, b);
            *weight *= if overlap > 0.0 {
                HEAVIER[0] + (HEAVIER[1] - HEAVIER[0]) * overlap / most
            } else {
                LIGHTER
            };
            *weight = weight.max(1.0);
        }
    }
}

/// Levenberg's damping at first, its factors after a step that is taken and one that is not, and where it is given up.
const DAMPING: f64 = 1e-2;
const AFTER_STEP: [f64; 2] = [0.25, 6.0];
const LEAST_DAMPING: f64 = 1e-7;
const MOST_DAMPING: f64 = 1e3;
/// The longest step, in cells.
const LONGEST: f64 = 4.0;
/// Steps that leave more than this share of the energy, of which so many in a row are enough.
const SLOW: f64 = 0.97;
const MOST_SLOW: usize = 5;
/// What the equations of a step cost for each body, in the words that other searches read.
const WORDS_PER_BODY: u64 = 500;
/// Bodies that overlap less are apart, in cells.
pub(super) const TOLERANCE: f64 = 0.04;

impl Scene<'_> {
    /// Brings all bodies apart, as far as that goes from where they are; how they overlap then, and whether they are apart.
    ///
    /// From: Levenberg 1944, A Method for the Solution of Certain Non-Linear Problems in Least Squares.
    pub(super) fn separate(&mut self, poses: &mut Vec<Pose>, most_steps: usize) -> (Pairs, bool) {
        let mut now = Equations::of_all(self, poses);
        let mut damping = DAMPING;
        let mut slow = 0;
        for _ in 0..most_steps {
            let is_over = now.deepest < TOLERANCE || slow == MOST_SLOW || damping > MOST_DAMPING;
            if is_over || self.is_ended() {
                break;
            }
            self.work += WORDS_PER_BODY * poses.len() as u64;
            let trial = now.step(damping).map(|step| self.stepped(poses, &step));
            let next = trial.map(|trial| (Equations::of_all(self, &trial), trial));
            if let Some((next, trial)) = next.filter(|(next, _)| next.energy < now.energy) {
                slow = if next.energy > SLOW * now.energy {
                    slow + 1
                } else {
                    0
                };
                (now, *poses) = (next, trial);
                damping = (damping * AFTER_STEP[0]).max(LEAST_DAMPING);
            } else {
                damping *= AFTER_STEP[1];
            }
        }
        let is_apart = now.deepest < TOLERANCE;
        (now.overlap, is_apart)
    }

    /// Brings one body away from all others, as far as that goes from a pose; that pose and its energy.
    pub(super) fn settle(
        &mut self,
        poses: &[Pose],
        body: usize,
        from: Pose,
        most_steps: usize,
    ) -> (f64, Pose) {
        let mut pose = from;
        let mut now = Equations::of_one(self, poses, body, &pose);
        let mut damping = DAMPING;
        for _ in 0..most_steps {
            if now.deepest < TOLERANCE || damping > MOST_DAMPING {
                break;
            }
            let step = now.step(damping).unwrap_or_default();
            let trial = self.stepped_one(body, &pose, step.first().copied().unwrap_or_default());
            let next = Equations::of_one(self, poses, body, &trial);
            if next.energy < now.energy {
                (now, pose) = (next, trial);
                damping = (damping * AFTER_STEP[0]).max(LEAST_DAMPING);
            } else {
                damping *= AFTER_STEP[1];
            }
        }
        (now.energy, pose)
    }

    fn stepped(&self, poses: &[Pose], step: &[[f64; 3]]) -> Vec<Pose> {
        let bodies = poses.iter().zip(step).enumerate();
        bodies
            .map(|(i, (pose, &step))| self.stepped_one(i, pose, step))
            .collect()
    }

    fn stepped_one(&self, body: usize, pose: &Pose, step: [f64; 3]) -> Pose {
        let longest = step.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let [x, y, arc] = step.map(|x| x * (LONGEST / longest.max(LONGEST)));
        pose.moved([x, y], arc / self.bodies[body].radius)
    }
}

//! Relocation of charts that overlap.
use std::f64::consts::{FRAC_PI_2, TAU};

use super::body::Pose;
use super::overlap::{Equations, Pairs, Scene};
use crate::atlas::Rotation;
use unwrapd_method::numerics::random::Random;

/// Number of poses tried anywhere on the page.
const ANYWHERE: usize = 24;
/// Number of poses tried near the pose of the body.
const NEARBY: usize = 16;
/// Number of the best of these poses, from which the body is pushed out of others.
const SETTLED: usize = 3;
/// Maximum number of steps that push a body.
const STEPS: usize = 12;
/// Largest shift to a nearby pose along each axis, as a share of the page's side.
const WAY: f64 = 0.06;
/// Largest turn to a nearby pose, in radians.
const ANGLE: f64 = 0.3;
/// Share of nearby poses that are turned by quarters.
const QUARTERS: f64 = 0.3;
/// Number of cells by which the rectangle around a body may exceed the page.
const ROUGHLY: f64 = 4.0;
/// Overlaps below this value, in square cells, are left to the common steps of all bodies.
const NEGLIGIBLE: f64 = 1e-3;

impl Scene<'_> {
    /// Moves each overlapping body, one after the other in random order, to the best place found for it.
    pub(super) fn move_overlapping(
        &mut self,
        poses: &mut [Pose],
        overlap: &Pairs,
        random: &mut Random,
    ) {
        let mut overlapping = vec![false; poses.len()];
        for (a, b, overlap) in overlap.iter() {
            if overlap > NEGLIGIBLE {
                overlapping[a] = true;
                overlapping[b] = true;
            }
        }
        let mut order: Vec<usize> = (0..poses.len()).filter(|&i| overlapping[i]).collect();
        for k in (1..order.len()).rev() {
            order.swap(k, random.below(k + 1));
        }
        for body in order {
            poses[body] = self.best_place(poses, body, random);
        }
    }

    fn best_place(&mut self, poses: &[Pose], body: usize, random: &mut Random) -> Pose {
        let here = poses[body];
        let energy = Equations::of_one(self, poses, body, &here).energy;
        if energy < NEGLIGIBLE {
            return here;
        }
        let mut best = vec![(self.rough_energy(poses, body, &here, f64::INFINITY), here)];
        for k in 0..ANYWHERE + NEARBY {
            let pose = if k < ANYWHERE {
                self.anywhere(body, &here, random)
            } else {
                self.nearby(body, &here, random)
            };
            let Some(pose) = self.within(body, pose) else {
                continue;
            };
            let limit = best.get(SETTLED - 1).map_or(f64::INFINITY, |worst| worst.0);
            let energy = self.rough_energy(poses, body, &pose, limit);
            if energy < limit {
                best.push((energy, pose));
                best.sort_by(|a, b| a.0.total_cmp(&b.0));
                best.truncate(SETTLED);
            }
        }
        let settled = best
            .into_iter()
            .map(|(_, pose)| self.settle(poses, body, pose, STEPS));
        let settled: Vec<(f64, Pose)> = settled.collect();
        let best = settled.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
        best.filter(|best| best.0 < energy)
            .map_or(here, |best| best.1)
    }

    /// Estimates the energy of a body's overlaps with other bodies, and stops once it exceeds `limit`. Ignores the border, so the
    /// body must not lie far beyond it.
    fn rough_energy(&mut self, poses: &[Pose], a: usize, pose: &Pose, limit: f64) -> f64 {
        let bodies = self.bodies;
        let bounds = bodies[a].bounds(pose);
        let mut energy = 0.0;
        for b in (0..poses.len()).filter(|&b| b != a) {
            if energy > limit {
                break;
            }
            if Scene::are_near(&bounds, &bodies[b].bounds(&poses[b])) {
                let depths =
                    self.rough([a, b], [pose, &poses[b]]) + self.rough([b, a], [&poses[b], pose]);
                energy += self.weights.get(a, b) * depths;
            }
        }
        energy
    }

    fn anywhere(&self, body: usize, here: &Pose, random: &mut Random) -> Pose {
        let middle = self.reach.map(|reach| random.unit() * reach);
        let angle = random.unit() * TAU;
        let angle = match self.bodies[body].rotation {
            Rotation::Any => angle,
            Rotation::Quarter => FRAC_PI_2 * (angle / FRAC_PI_2).floor(),
            Rotation::None => here.angle,
        };
        Pose::new(middle, angle)
    }

    fn nearby(&self, body: usize, here: &Pose, random: &mut Random) -> Pose {
        let mut about = |width: f64| width * (2.0 * random.unit() - 1.0);
        let by = self.reach.map(|reach| about(WAY * reach));
        let angle = about(ANGLE);
        let quarters = if random.unit() < QUARTERS {
            FRAC_PI_2 * (1 + random.below(3)) as f64
        } else {
            0.0
        };
        let angle = match self.bodies[body].rotation {
            Rotation::Any if quarters == 0.0 => angle,
            Rotation::Any | Rotation::Quarter => quarters,
            Rotation::None => 0.0,
        };
        here.moved(by, angle)
    }

    /// Returns the pose shifted so that the body's rectangle lies within the page; `None` if it exceeds the page by more than
    /// [`ROUGHLY`].
    fn within(&self, body: usize, pose: Pose) -> Option<Pose> {
        let [low, high] = self.bodies[body].bounds(&pose);
        let mut by = [0.0; 2];
        for k in 0..2 {
            let (least, most) = (-low[k], self.reach[k] - high[k]);
            if least > most + ROUGHLY {
                return None;
            }
            by[k] = 0.0_f64.min(most).max(least);
        }
        Some(pose.moved(by, 0.0))
    }
}

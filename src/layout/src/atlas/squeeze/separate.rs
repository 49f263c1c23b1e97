//! Steps that bring bodies apart.
use super::body::Pose;
use super::contacts::{Pairs, Scene};
use super::equations::Equations;

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

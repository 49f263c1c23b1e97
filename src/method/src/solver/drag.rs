//! Handles that are being moved: [`follow()`](super::follow()) an iteration at a time.

use super::handles::{Handles, HandlesError};
use super::journey::{HARD, HARDENED, LEAST_PROGRESS, ROUNDING};
use super::kept::Kept;
use super::objective::Objective;
use super::path::Rotation;
use super::relaxation::Relaxation;
use super::settings::{Projection, Summary};
use super::travel::{PATIENCE, SOFT, Travel};
use crate::energy::Positional;
use crate::numerics::square::{Matrix, Square};

/// The rest is settled when the decrease that the quadratic model promises is at most this share of the energy. Convergence is
/// quadratic there, so what is left to gain is far less.
const TOLERANCE: f64 = 1e-9;

/// A step of at least this length confirms what the model promised.
const CONFIRMING: f64 = 0.5;

/// Where a drag stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// More iterations change the map.
    Moving,
    /// The handles are at their targets and the rest at a minimum.
    Settled,
    /// The handles cannot come nearer to their targets this way; the rest is at a minimum.
    Unreachable,
}

/// Handles on their way to targets that may change at any time, and what is known of the map meanwhile.
///
/// Each iteration is one of [`follow()`](super::follow())'s and leaves the map in the domain; left alone, the drag ends where
/// `follow` does. The objective's analysis is kept: vertices are held by clearing rows and columns of one pattern, and points lie
/// within elements, whose vertices meet in that pattern already.
pub struct Drag<const D: usize> {
    travel: Travel<D>,
    vertices: Vec<u32>,
    phase: Phase,
    /// The last factorization, if it is to be kept.
    kept: Option<Kept>,
}

/// What comes next.
#[derive(Clone, Copy, PartialEq)]
enum Phase {
    /// Advances of the handles. So many iterations before brought none; the round began at this share of the way.
    Advance { stuck: usize, from: f64 },
    /// The rest settles, between rounds or at the end.
    Settle { from: f64 },
    /// Points meet their targets, which they were so far from before: constraints of this strength.
    Harden { strength: f64, before: f64 },
    /// Nothing.
    Done(Stage),
}

impl<const D: usize> Drag<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// Nothing is pulled yet; the map `x` settles.
    ///
    /// # Errors
    /// If `x` is no map of the plane or of space.
    pub fn new(objective: &mut Objective, x: &[f64]) -> Result<Self, HandlesError> {
        let relaxation = Relaxation::new(Projection::Relaxed);
        let mut travel = Travel::new(objective, x, &Handles::default(), relaxation)?;
        travel.s = 1.0;
        Ok(Self {
            travel,
            vertices: Vec::new(),
            phase: Phase::Settle { from: 1.0 },
            kept: None,
        })
    }

    /// Takes these handles in place of those before, from wherever they are.
    ///
    /// # Errors
    /// If they do not fit each other or the map. Then all is as it was.
    pub fn aim(
        &mut self,
        objective: &mut Objective,
        x: &[f64],
        handles: &Handles,
    ) -> Result<(), HandlesError> {
        handles.check(D, x.len())?;
        if handles.vertices != self.vertices {
            self.vertices.clone_from(&handles.vertices);
            objective.fix(&handles.vertices);
        }
        let rows = objective
            .constraints()
            .map_or(&[][..], |points| &points.rows);
        if rows != handles.points {
            objective.pull_at(Positional {
                dim: D,
                rows: handles.points.clone(),
                targets: handles.point_targets.clone(),
                alpha: 0.0,
            });
        }
        let known = (self.travel.relaxation, self.travel.summary);
        self.travel = Travel::continued(objective, x, handles, known)?;
        self.phase = if is_there(x, handles) {
            self.travel.s = 1.0;
            Phase::Settle { from: 1.0 }
        } else {
            Phase::Advance {
                stuck: 0,
                from: 0.0,
            }
        };
        self.travel
            .points
            .pull::<D>(objective, x, SOFT, self.travel.s);
        // With other points it is another one, and elsewhere too.
        self.travel.summary.energy_last = f64::NAN;
        Ok(())
    }

    /// One iteration, unless there is nothing left to do.
    ///
    /// Cost: one assembly, one factorization, two or more solves, one or two evaluations; where a factorization takes longer than the
    /// rest, most advances take one gradient and one solve with that of an iteration before.
    pub fn step(&mut self, objective: &mut Objective, x: &mut [f64]) -> Stage {
        if let Phase::Advance { from, .. } = self.phase
            && let Some(kept) = self.kept.take()
        {
            self.kept = kept.advance(&mut self.travel, objective, x);
            if self.kept.is_some() {
                self.phase = Phase::Settle { from };
                return self.stage();
            }
        }
        if self.travel.summary.energy_last.is_nan() {
            self.travel.summary.energy_last = objective.value(x);
        }
        let phase = self.phase;
        self.phase = match phase {
            Phase::Advance { stuck, from } => self.advance(objective, x, stuck, from),
            Phase::Settle { from } if self.settle(objective, x) => {
                self.after_round(objective, x, from)
            }
            Phase::Harden { strength, before } if self.settle(objective, x) => {
                self.harden(objective, x, strength, before)
            }
            unchanged => unchanged,
        };
        self.travel.summary.factorizations = objective.factorizations();
        self.stage()
    }

    /// Where it stands.
    pub fn stage(&self) -> Stage {
        match self.phase {
            Phase::Done(stage) => stage,
            _ => Stage::Moving,
        }
    }

    /// What was done since the beginning.
    pub fn summary(&self) -> &Summary {
        &self.travel.summary
    }

    fn advance(
        &mut self,
        objective: &mut Objective,
        x: &mut [f64],
        stuck: usize,
        from: f64,
    ) -> Phase {
        let before = self.travel.s;
        let found = self.travel.iterate(objective, x);
        self.kept = Kept::of(objective);
        let stuck = if self.travel.s > before { 0 } else { stuck + 1 };
        if found.is_none() || self.travel.s >= 1.0 || stuck >= PATIENCE {
            Phase::Settle { from }
        } else {
            Phase::Advance { stuck, from }
        }
    }

    /// A Newton step with the handles held where they are; true if it is settled.
    fn settle(&mut self, objective: &mut Objective, x: &mut [f64]) -> bool {
        let travel = &mut self.travel;
        let energy = travel.summary.energy_last;
        let Some(decrement) = travel.find_newton_step(objective, x) else {
            return true;
        };
        self.kept = Kept::of(objective);
        let length = travel.relax(objective, x, decrement);
        travel.summary.iterations += 1;
        let unit = objective.reference(energy);
        let is_small = decrement <= TOLERANCE * unit;
        if length > 0.0 {
            let decrease = energy - travel.summary.energy_last;
            travel.relaxation.after_step(length, decrease / unit);
            is_small && length >= CONFIRMING
        } else {
            is_small || !travel.relaxation.after_useless_direction()
        }
    }

    /// The rest has settled: on, if the round before brought the handles nearer.
    fn after_round(&mut self, objective: &mut Objective, x: &[f64], from: f64) -> Phase {
        let travel = &mut self.travel;
        if travel.s >= 1.0 {
            let before = travel.points.farthest(objective, x);
            return self.harden(objective, x, SOFT, before);
        }
        if travel.s < from + LEAST_PROGRESS {
            return Phase::Done(Stage::Unreachable);
        }
        travel.start_over();
        travel.points.pull::<D>(objective, x, SOFT, travel.s);
        Phase::Advance {
            stuck: 0,
            from: travel.s,
        }
    }

    /// The map has settled with points held this strongly.
    fn harden(
        &mut self,
        objective: &mut Objective,
        x: &[f64],
        strength: f64,
        before: f64,
    ) -> Phase {
        let points = &mut self.travel.points;
        if !points.is_empty() && strength < HARD {
            let strength = 10.0 * strength;
            points.pull::<D>(objective, x, strength, 1.0);
            self.travel.summary.energy_last = objective.value(x);
            return Phase::Harden { strength, before };
        }
        let rounding = ROUNDING * x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let is_near = points.farthest(objective, x) <= (HARDENED * before).max(rounding);
        Phase::Done(if is_near {
            Stage::Settled
        } else {
            Stage::Unreachable
        })
    }
}

/// Are the vertices at their targets, and no points pulled?
fn is_there(x: &[f64], handles: &Handles) -> bool {
    let dim = handles.targets.len() / handles.vertices.len().max(1);
    let place = |v: &u32| &x[dim * *v as usize..dim * (*v as usize + 1)];
    handles.points.is_empty() && handles.vertices.iter().flat_map(place).eq(&handles.targets)
}

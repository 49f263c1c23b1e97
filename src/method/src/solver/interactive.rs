//! Interactive handles: [`follow()`](super::follow()) one iteration at a time.

use super::continuation::{HARD, HARDENED, LEAST_PROGRESS, ROUNDING};
use super::handles::{Handles, HandlesError, Rotation};
use super::load_steps::{LoadSteps, PATIENCE, SOFT};
use super::objective::Objective;
use super::relaxation::Relaxation;
use super::settings::{Projection, Summary};
use crate::energy::Positional;
use crate::numerics::square::{Matrix, Square};

/// The free vertices are settled when the decrease predicted by the quadratic model is at most this share of the
/// energy. Convergence is quadratic there, so the remaining gain is far smaller.
const TOLERANCE: f64 = 1e-9;

/// Shortest step that confirms the prediction of the model: a longer one leaves less than (1 − ½)² of the predicted
/// decrease.
const CONFIRMING: f64 = 0.5;

/// State of a drag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// More iterations change the map.
    Moving,
    /// The handles are at their targets and the free vertices at a minimum.
    Settled,
    /// The handles cannot come nearer to their targets along this path; the free vertices are at a minimum.
    Unreachable,
}

/// Handles on their path to targets that may change at any time, with the solver's state between iterations.
///
/// Each iteration is one of [`follow()`](super::follow())'s and leaves the map in the domain; without new targets the
/// drag ends where `follow` does. The objective's analysis is kept: vertices are held by clearing rows and columns of
/// one pattern, and points lie within elements, whose vertices meet in that pattern already.
pub struct InteractiveContinuation<const D: usize> {
    load_steps: LoadSteps<D>,
    vertices: Vec<u32>,
    phase: Phase,
    /// The last factorization, if it is worth keeping.
    reused: Option<FactorUse>,
}

/// Next phase of a drag.
#[derive(Clone, Copy, PartialEq)]
enum Phase {
    /// Advances the handles. `stuck` iterations in a row brought no advance; the round began at the share `from` of the
    /// path.
    Advance { stuck: usize, from: f64 },
    /// Settles the free vertices, between rounds or at the end.
    Settle { from: f64 },
    /// Stiffens the point constraints tenfold per round; `before` is the largest distance at the start of hardening.
    Harden { strength: f64, before: f64 },
    /// No iterations left.
    Done(Stage),
}

impl<const D: usize> InteractiveContinuation<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// Starts a drag without handles; the map `x` settles.
    ///
    /// # Errors
    /// If `x` is no map of the plane or of space.
    pub fn new(objective: &mut Objective, x: &[f64]) -> Result<Self, HandlesError> {
        let relaxation = Relaxation::new(Projection::Relaxed);
        let mut load_steps = LoadSteps::new(objective, x, &Handles::default(), relaxation)?;
        load_steps.s = 1.0;
        Ok(Self {
            load_steps,
            vertices: Vec::new(),
            phase: Phase::Settle { from: 1.0 },
            reused: None,
        })
    }

    /// Replaces the handles by new ones, which start from their present positions.
    ///
    /// # Errors
    /// If the handles do not fit each other or the map. The drag is then unchanged.
    pub fn aim(
        &mut self,
        objective: &mut Objective,
        x: &[f64],
        handles: &Handles,
    ) -> Result<(), HandlesError> {
        handles.check(D, x.len())?;
        // Fix the new vertices and constrain the new points, if they differ from the old ones.
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
        // Start a new path from the present map; the relaxation and the totals carry over.
        let (relaxation, summary) = (self.load_steps.relaxation, self.load_steps.summary);
        self.load_steps = LoadSteps::continued(objective, x, handles, relaxation, summary)?;
        self.phase = if is_there(x, handles) {
            self.load_steps.s = 1.0;
            Phase::Settle { from: 1.0 }
        } else {
            Phase::Advance {
                stuck: 0,
                from: 0.0,
            }
        };
        self.load_steps
            .points
            .pull::<D>(objective, x, SOFT, self.load_steps.s);
        // The pull has changed, so the last energy no longer holds.
        self.load_steps.summary.energy_last = f64::NAN;
        Ok(())
    }

    /// Runs one iteration, unless the drag is done.
    ///
    /// Cost: one assembly, one factorization, two or more solves, one or two evaluations; where a factorization takes
    /// longer than everything else, most advances take one gradient and one solve with an earlier factorization.
    pub fn step(&mut self, objective: &mut Objective, x: &mut [f64]) -> Stage {
        if let Phase::Advance { from, .. } = self.phase
            && let Some(reused) = self.reused.take()
        {
            self.reused = reused.advance(&mut self.load_steps, objective, x);
            if self.reused.is_some() {
                self.phase = Phase::Settle { from };
                return self.stage();
            }
        }
        if self.load_steps.summary.energy_last.is_nan() {
            self.load_steps.summary.energy_last = objective.value(x);
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
        self.load_steps.summary.factorizations = objective.factorizations();
        self.stage()
    }

    /// Returns the state of the drag.
    pub fn stage(&self) -> Stage {
        match self.phase {
            Phase::Done(stage) => stage,
            _ => Stage::Moving,
        }
    }

    /// Returns the totals since the beginning.
    pub fn summary(&self) -> &Summary {
        &self.load_steps.summary
    }

    fn advance(
        &mut self,
        objective: &mut Objective,
        x: &mut [f64],
        stuck: usize,
        from: f64,
    ) -> Phase {
        let before = self.load_steps.s;
        let found = self.load_steps.iterate(objective, x);
        self.reused = FactorUse::of(objective);
        let stuck = if self.load_steps.s > before {
            0
        } else {
            stuck + 1
        };
        if found.is_none() || self.load_steps.s >= 1.0 || stuck >= PATIENCE {
            Phase::Settle { from }
        } else {
            Phase::Advance { stuck, from }
        }
    }

    /// Takes a Newton step with the handles fixed; returns whether the map is settled.
    fn settle(&mut self, objective: &mut Objective, x: &mut [f64]) -> bool {
        let load_steps = &mut self.load_steps;
        let energy = load_steps.summary.energy_last;
        let Some(decrement) = load_steps.find_newton_step(objective, x) else {
            return true;
        };
        self.reused = FactorUse::of(objective);
        let length = load_steps.relax(objective, x, decrement);
        load_steps.summary.iterations += 1;
        let unit = objective.reference(energy);
        let is_small = decrement <= TOLERANCE * unit;
        if length > 0.0 {
            let decrease = energy - load_steps.summary.energy_last;
            load_steps.relaxation.after_step(length, decrease / unit);
            is_small && length >= CONFIRMING
        } else {
            is_small || !load_steps.relaxation.after_useless_direction()
        }
    }

    /// Chooses the next phase once the map has settled: another round if the last one brought the handles nearer.
    fn after_round(&mut self, objective: &mut Objective, x: &[f64], from: f64) -> Phase {
        let load_steps = &mut self.load_steps;
        if load_steps.s >= 1.0 {
            let before = load_steps.points.farthest(objective, x);
            return self.harden(objective, x, SOFT, before);
        }
        if load_steps.s < from + LEAST_PROGRESS {
            return Phase::Done(Stage::Unreachable);
        }
        load_steps.start_over();
        load_steps
            .points
            .pull::<D>(objective, x, SOFT, load_steps.s);
        Phase::Advance {
            stuck: 0,
            from: load_steps.s,
        }
    }

    /// Chooses the next phase once the map has settled with points of this strength.
    fn harden(
        &mut self,
        objective: &mut Objective,
        x: &[f64],
        strength: f64,
        before: f64,
    ) -> Phase {
        let points = &mut self.load_steps.points;
        if !points.is_empty() && strength < HARD {
            let strength = 10.0 * strength;
            points.pull::<D>(objective, x, strength, 1.0);
            self.load_steps.summary.energy_last = objective.value(x);
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

/// Returns whether the vertices are at their targets and no points are pulled.
fn is_there(x: &[f64], handles: &Handles) -> bool {
    let dim = handles.targets.len() / handles.vertices.len().max(1);
    handles.points.is_empty()
        && handles
            .vertices
            .iter()
            .flat_map(|v: &u32| &x[dim * *v as usize..dim * (*v as usize + 1)])
            .eq(&handles.targets)
}

// A factorization that serves several advances of handles.

/// Flops beyond which a factorization takes longer than everything else in a frame, about 5 ms.
const COSTLY: f64 = 1e8;

/// Most advances per factorization. More save factorizations, but each belongs to an ever more distant point.
const MOST_ADVANCES: usize = 24;

/// Largest gradient after an advance, as a share of its right-hand side; beyond it the factorization is renewed.
/// Smaller values keep advances nearer to Newton's, larger ones save factorizations.
const WORN: f64 = 0.5;

/// Use of a factorization since it was made.
struct FactorUse {
    advances: usize,
    /// Norm of the last right-hand side.
    norm: f64,
}

impl FactorUse {
    /// Keeps the factorization that an objective has just made; returns `None` if making one is cheap.
    pub fn of(objective: &Objective) -> Option<Self> {
        let is_costly = objective.work().is_some_and(|work| work.flops > COSTLY);
        is_costly.then_some(Self {
            advances: 0,
            norm: 0.0,
        })
    }

    /// Moves the handles to their targets while the other vertices follow. Returns `None`, without moving anything, if
    /// this needs a new factorization.
    ///
    /// This is a step of the modified Newton method. It leaves little of the gradient while the matrix is a good
    /// approximation, which is checked before the next step. Cost: one gradient, one solve, one largest step.
    pub fn advance<const D: usize>(
        self,
        load_steps: &mut LoadSteps<D>,
        objective: &mut Objective,
        x: &mut [f64],
    ) -> Option<Self>
    where
        Matrix<D>: Square<D> + Rotation<D>,
    {
        // The strength of points is measured by assembling a Hessian, which the factorization then does not belong to.
        let may_serve = self.advances < MOST_ADVANCES && load_steps.points.is_empty();
        if !may_serve || !objective.renew_gradient(x) {
            return None;
        }
        let left = objective
            .gradient()
            .iter()
            .map(|g| g * g)
            .sum::<f64>()
            .sqrt();
        if self.advances > 0 && left > WORN * self.norm {
            return None;
        }
        Some(Self {
            norm: load_steps.step_with_kept(objective, x)?,
            advances: self.advances + 1,
        })
    }
}

//! Points inside elements on their paths to targets: soft constraints of an objective.

use super::handles::Handles;
use super::objective::Objective;
use super::path::aside;

/// Points on straight or bent paths, held with a strength relative to the energy's curvature.
pub(super) struct Points {
    origins: Vec<f64>,
    ways: Vec<f64>,
    /// Bend of each path; empty if all are straight.
    bends: Vec<[f64; 3]>,
    /// Workspace for positions and moves.
    room: Vec<f64>,
    /// Mean curvature of the energy at the start; 0 before it is known.
    unit: f64,
}

impl Points {
    /// Creates the paths of the constraints of `objective` from their positions in `x` to their targets; sets their
    /// strength to 0.
    pub fn new(objective: &mut Objective, x: &[f64], handles: &Handles) -> Self {
        let origins: Vec<f64> = objective
            .constraints()
            .map_or(Vec::new(), |constraints| constraints.places(x).collect());
        objective.set_constraints(0.0, &origins);
        let targets = handles.point_targets.iter();
        let ways = targets
            .zip(&origins)
            .map(|(target, origin)| target - origin);
        let ways: Vec<f64> = ways.collect();
        Self {
            room: vec![0.0; ways.len()],
            ways,
            bends: (handles.bends.iter().skip(handles.n_groups()))
                .copied()
                .collect(),
            origins,
            unit: 0.0,
        }
    }

    pub fn is_empty(&self) -> bool {
        self.ways.is_empty()
    }

    /// Returns the largest distance, in one coordinate, of a point from its target.
    pub fn farthest(&self, objective: &Objective, x: &[f64]) -> f64 {
        let Some(constraints) = objective.constraints() else {
            return 0.0;
        };
        let targets = self.origins.iter().zip(&self.ways).map(|(o, way)| o + way);
        let distances = constraints
            .places(x)
            .zip(targets)
            .map(|(x, t)| (x - t).abs());
        distances.fold(0.0, f64::max)
    }

    /// Returns the moves of the targets between two shares of the path.
    pub fn moves<const D: usize>(&mut self, from: f64, to: f64) -> &[f64] {
        for (room, way) in self.room.iter_mut().zip(&self.ways) {
            *room = (to - from) * way;
        }
        self.bend_room::<D>(to, 1.0);
        self.bend_room::<D>(from, -1.0);
        &self.room
    }

    /// Adds `times` the offset of the bent paths from straight ones at `s` to the workspace.
    fn bend_room<const D: usize>(&mut self, s: f64, times: f64) {
        let rooms = self.room.as_chunks_mut::<D>().0.iter_mut();
        let ways = rooms.zip(self.ways.as_chunks::<D>().0);
        for ((room, way), bend) in ways.zip(&self.bends) {
            for (room, aside) in room.iter_mut().zip(aside(*way, *bend, s)) {
                *room += times * aside;
            }
        }
    }

    /// Moves the targets to the share `s` of their paths and sets the strength, in units of the energy's mean
    /// curvature, which is measured at `x` the first time.
    pub fn pull<const D: usize>(
        &mut self,
        objective: &mut Objective,
        x: &[f64],
        strength: f64,
        s: f64,
    ) {
        if self.is_empty() {
            return;
        }
        if self.unit == 0.0 {
            objective.linearize(x, 0.0);
            self.unit = objective.mean_diagonal();
        }
        let ways = self.origins.iter().zip(&self.ways);
        for (room, (origin, way)) in self.room.iter_mut().zip(ways) {
            *room = origin + s * way;
        }
        self.bend_room::<D>(s, 1.0);
        objective.set_constraints(strength * self.unit, &self.room);
    }
}

//! Where bodies come nearer to each other, or to the border, than they may.
use std::sync::Arc;

use super::body::{Body, Pose};
use super::contour::{RUN, Run};
use crate::atlas::read_limit::ReadLimit;

/// What looking up a distance costs, in the words that other searches read.
const WORDS_PER_LOOKUP: u64 = 8;
/// Bodies whose rectangles are farther apart do not touch, in cells.
const APART: f64 = 2.0;

/// A point that is too near.
pub(super) struct Contact {
    pub point: [f64; 2],
    /// How much too near.
    pub depth: f64,
    /// The direction in which the point would have to go.
    pub out: [f64; 2],
}

/// A page and the bodies that should lie on it.
pub(super) struct Scene<'a> {
    pub bodies: &'a [Arc<Body>],
    /// How far they may reach to the right and up.
    pub reach: [f64; 2],
    /// What is kept between bodies beyond the distance that each keeps.
    pub room: f64,
    /// Weights of the overlaps.
    pub weights: Pairs,
    /// What looking cost so far, in words.
    pub work: u64,
    /// What it may cost.
    pub limit: ReadLimit<'a>,
}

/// A number for each two bodies, and for each body and the border: those at equal indices.
#[derive(Clone)]
pub(super) struct Pairs {
    n: usize,
    values: Vec<f64>,
}

impl Pairs {
    pub(super) fn new(n: usize, value: f64) -> Self {
        Self {
            n,
            values: vec![value; n * n],
        }
    }

    pub(super) fn get(&self, a: usize, b: usize) -> f64 {
        self.values[a.min(b) * self.n + a.max(b)]
    }

    pub(super) fn get_mut(&mut self, a: usize, b: usize) -> &mut f64 {
        &mut self.values[a.min(b) * self.n + a.max(b)]
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        (0..self.n).flat_map(move |a| (a..self.n).map(move |b| (a, b, self.get(a, b))))
    }
}

impl Scene<'_> {
    /// Points of body `a` that are too near to body `b`.
    pub(super) fn contacts(
        &mut self,
        [a, b]: [usize; 2],
        poses: [&Pose; 2],
        mut visit: impl FnMut(Contact),
    ) {
        let (body, other) = (&self.bodies[a], &self.bodies[b]);
        let room = self.room;
        let mut lookups = 0;
        for run in &body.runs {
            lookups += 1;
            let center = poses[1].back(poses[0].place(run.center));
            if other.field.at_least(center) > run.radius + room {
                continue;
            }
            lookups += RUN as u64;
            for &p in &run.points {
                let point = poses[0].place(p);
                let (distance, gradient) = other.field.at(poses[1].back(point));
                if distance < room {
                    visit(Contact {
                        point,
                        depth: room - distance,
                        out: poses[1].turned(gradient),
                    });
                }
            }
        }
        self.work += WORDS_PER_LOOKUP * lookups;
    }

    /// Roughly the sum of squared depths of points of body `a` within the reach of body `b`.
    pub(super) fn rough(&mut self, [a, b]: [usize; 2], poses: [&Pose; 2]) -> f64 {
        let (body, other) = (&self.bodies[a], &self.bodies[b]);
        self.work += WORDS_PER_LOOKUP * body.runs.len() as u64;
        let depth = |run: &Run| {
            let center = poses[1].back(poses[0].place(run.center));
            (self.room - other.field.at(center).0).max(0.0)
        };
        let sum: f64 = body.runs.iter().map(|run| depth(run).powi(2)).sum();
        RUN as f64 * sum
    }

    /// Points of a body that are too near to the border or beyond it.
    pub(super) fn contacts_of_border(
        &mut self,
        a: usize,
        pose: &Pose,
        mut visit: impl FnMut(Contact),
    ) {
        let reach = self.reach;
        let is_within =
            |p: [f64; 2], by: f64| (0..2).all(|k| p[k] - by >= 0.0 && p[k] + by <= reach[k]);
        let body = &self.bodies[a];
        let bounds = body.bounds(pose);
        if bounds.iter().all(|&corner| is_within(corner, 0.0)) {
            return;
        }
        self.work += WORDS_PER_LOOKUP * body.runs.len() as u64;
        for run in &body.runs {
            if is_within(pose.place(run.center), run.radius) {
                continue;
            }
            for point in run.points.map(|p| pose.place(p)) {
                for k in 0..2 {
                    for (depth, sign) in [(-point[k], 1.0), (point[k] - reach[k], -1.0)] {
                        if depth > 0.0 {
                            let mut out = [0.0; 2];
                            out[k] = sign;
                            visit(Contact { point, depth, out });
                        }
                    }
                }
            }
        }
    }

    /// Whether two bodies may touch, by their rectangles.
    pub(super) fn are_near(a: &[[f64; 2]; 2], b: &[[f64; 2]; 2]) -> bool {
        (0..2).all(|k| a[0][k] < b[1][k] + APART && b[0][k] < a[1][k] + APART)
    }
}

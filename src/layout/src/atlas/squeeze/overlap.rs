//! Overlaps of charts with each other and with the border, and the step that reduces them.
use std::sync::Arc;

use super::body::{Body, Pose, RUN, Run};
use crate::atlas::Rotation;
use crate::atlas::effort::ReadLimit;
use unwrapd_method::numerics::cholesky::SymmetricPattern;
use unwrapd_method::numerics::conjugate_gradients::ConjugateGradients;

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

/// Unknowns of a body: two shifts and, times its radius, an angle.
const DOF: usize = 3;
/// Added to the diagonal, so that bodies that touch nothing stay.
const LEAST: f64 = 1e-12;

type Row = [f64; DOF];
type Block = [Row; DOF];

/// How bodies overlap, and what a step of some of them would change: Σ w (d − J·Δ)² over all points that are too near, with
/// their depths d, to be minimized over the movements Δ.
pub(super) struct Equations {
    /// Σ w d².
    pub energy: f64,
    /// The largest depth.
    pub deepest: f64,
    /// Σ d² of each pair, where all bodies move.
    pub overlap: Pairs,
    /// Blocks of Σ w JᵀJ: for each body, and for each two that touch, sorted.
    of_body: Vec<Block>,
    of_pair: Vec<([usize; 2], Block)>,
    /// Σ w Jᵀd.
    right: Vec<Row>,
}

/// How the depth of a contact changes with a body's movement: −∂d.
fn row(body: &Body, pose: &Pose, contact: &Contact) -> Row {
    let Contact { point, out, .. } = contact;
    let arm = [point[0] - pose.middle[0], point[1] - pose.middle[1]];
    let turning = match body.rotation {
        Rotation::Any => (arm[0] * out[1] - arm[1] * out[0]) / body.radius,
        Rotation::Quarter | Rotation::None => 0.0,
    };
    [out[0], out[1], turning]
}

impl Equations {
    /// Of all bodies.
    pub(super) fn of_all(scene: &mut Scene, poses: &[Pose]) -> Self {
        let n = poses.len();
        let bodies = scene.bodies;
        let mut equations = Self::new(n);
        equations.overlap = Pairs::new(n, 0.0);
        let bounds = bodies
            .iter()
            .zip(poses)
            .map(|(body, pose)| body.bounds(pose));
        let bounds: Vec<_> = bounds.collect();
        for a in 0..n {
            *equations.overlap.get_mut(a, a) = equations.touch_border(scene, a, a, &poses[a]);
            for b in (a + 1..n).filter(|&b| Scene::are_near(&bounds[a], &bounds[b])) {
                equations.touch([a, b], scene, poses);
            }
        }
        equations
    }

    /// Of one body, the others staying where they are.
    pub(super) fn of_one(scene: &mut Scene, poses: &[Pose], a: usize, pose: &Pose) -> Self {
        let mut equations = Self::new(1);
        let bodies = scene.bodies;
        let bounds = bodies[a].bounds(pose);
        equations.touch_border(scene, 0, a, pose);
        for b in (0..poses.len()).filter(|&b| b != a) {
            if Scene::are_near(&bounds, &bodies[b].bounds(&poses[b])) {
                let weight = scene.weights.get(a, b);
                scene.contacts([a, b], [pose, &poses[b]], |contact| {
                    equations.add(0, weight, contact.depth, row(&bodies[a], pose, &contact));
                });
                scene.contacts([b, a], [&poses[b], pose], |contact| {
                    let row = row(&bodies[a], pose, &contact).map(|x| -x);
                    equations.add(0, weight, contact.depth, row);
                });
            }
        }
        equations
    }

    fn new(n: usize) -> Self {
        Self {
            energy: 0.0,
            deepest: 0.0,
            overlap: Pairs::new(0, 0.0),
            of_body: vec![[[0.0; DOF]; DOF]; n],
            of_pair: Vec::new(),
            right: vec![[0.0; DOF]; n],
        }
    }

    /// What a body and the border have in common, and its Σ d²; the body's unknowns are those at `index`.
    fn touch_border(&mut self, scene: &mut Scene, index: usize, a: usize, pose: &Pose) -> f64 {
        let body = &scene.bodies[a];
        let weight = scene.weights.get(a, a);
        let mut overlap = 0.0;
        scene.contacts_of_border(a, pose, |contact| {
            self.add(index, weight, contact.depth, row(body, pose, &contact));
            overlap += contact.depth.powi(2);
        });
        overlap
    }

    /// What two bodies have in common.
    fn touch(&mut self, [a, b]: [usize; 2], scene: &mut Scene, poses: &[Pose]) {
        let bodies = scene.bodies;
        let weight = scene.weights.get(a, b);
        let mut overlap = 0.0;
        let mut block = [[0.0; DOF]; DOF];
        for [p, q] in [[a, b], [b, a]] {
            scene.contacts([p, q], [&poses[p], &poses[q]], |contact| {
                let of_p = row(&bodies[p], &poses[p], &contact);
                let of_q = row(&bodies[q], &poses[q], &contact).map(|x| -x);
                self.add(p, weight, contact.depth, of_p);
                self.add_to_diagonal(q, weight, contact.depth, of_q);
                let [of_a, of_b] = if p == a { [of_p, of_q] } else { [of_q, of_p] };
                add_product(&mut block, weight, of_b, of_a);
                overlap += contact.depth.powi(2);
            });
        }
        if overlap > 0.0 {
            self.of_pair.push(([a, b], block));
            *self.overlap.get_mut(a, b) = overlap;
        }
    }

    /// A contact as far as it concerns one body.
    fn add(&mut self, index: usize, weight: f64, depth: f64, row: Row) {
        self.energy += weight * depth * depth;
        self.deepest = self.deepest.max(depth);
        self.add_to_diagonal(index, weight, depth, row);
    }

    fn add_to_diagonal(&mut self, index: usize, weight: f64, depth: f64, row: Row) {
        add_product(&mut self.of_body[index], weight, row, row);
        for (right, x) in self.right[index].iter_mut().zip(row) {
            *right += weight * depth * x;
        }
    }

    /// The movements that minimize the sum with `damping` times the largest diagonal entry added: for each body the shifts, and
    /// the angle times its radius.
    pub(super) fn step(&self, damping: f64) -> Option<Vec<Row>> {
        let diagonal = self
            .of_body
            .iter()
            .flat_map(|block| (0..DOF).map(|k| block[k][k]));
        let damping = damping * diagonal.fold(0.0, f64::max) + LEAST;
        let n = DOF * self.of_body.len();
        let mut entries = Vec::new();
        for (a, block) in self.of_body.iter().enumerate() {
            for (k, i) in (0..DOF).flat_map(|k| (k..DOF).map(move |i| (k, i))) {
                let added = if i == k { damping } else { 0.0 };
                entries.push((place(a, k), place(a, i), block[i][k] + added));
            }
        }
        for &([a, b], block) in &self.of_pair {
            for (i, row) in block.iter().enumerate() {
                let row = (0..).zip(row);
                entries.extend(row.map(|(k, &value)| (place(a, k), place(b, i), value)));
            }
        }
        let (pattern, values) = SymmetricPattern::from_entries(n, entries);
        let mut x = self.right.concat();
        ConjugateGradients::new(n)
            .solve(&pattern, &values, &mut x)
            .ok()?;
        Some(x.chunks_exact(DOF).map(|x| [x[0], x[1], x[2]]).collect())
    }
}

/// The unknown that a degree of freedom of a body is.
fn place(body: usize, freedom: usize) -> u32 {
    (DOF * body + freedom) as u32
}

/// Adds w a bᵀ.
fn add_product(block: &mut Block, weight: f64, a: Row, b: Row) {
    for (row, x) in block.iter_mut().zip(a) {
        for (entry, y) in row.iter_mut().zip(b) {
            *entry += weight * x * y;
        }
    }
}

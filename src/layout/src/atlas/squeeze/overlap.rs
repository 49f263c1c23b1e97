//! Overlaps of charts with each other and with the border, and the step that reduces them.
use std::sync::Arc;

use super::body::{Body, Pose, RUN, Run};
use crate::atlas::Rotation;
use crate::atlas::effort::ReadLimit;
use unwrapd_method::numerics::cholesky::SymmetricPattern;
use unwrapd_method::numerics::conjugate_gradients::ConjugateGradients;

/// Cost of looking up a distance, in words.
const WORDS_PER_LOOKUP: u64 = 8;
/// Two bodies whose rectangles are at least this many cells apart along an axis are not tested for contacts.
const APART: f64 = 2.0;

/// Sample point that is too near to another body, or beyond the border.
pub(super) struct Contact {
    pub point: [f64; 2],
    /// Distance that is missing, in cells.
    pub depth: f64,
    /// Direction in which the point has to move.
    pub out: [f64; 2],
}

/// Page and the bodies that should lie on it.
pub(super) struct Scene<'a> {
    pub bodies: &'a [Arc<Body>],
    /// Distances to which bodies may extend to the right and up, in cells.
    pub reach: [f64; 2],
    /// Distance kept between bodies beyond the one that each keeps, in cells.
    pub room: f64,
    /// Weights of the overlaps.
    pub weights: Pairs,
    /// Cost of the search so far, in words.
    pub work: u64,
    /// Limit of this cost.
    pub limit: ReadLimit<'a>,
}

/// Number for each pair of bodies, and for each body and the border, whose entry has two equal indices.
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
    /// Visits the points of body `a` that are too near to body `b`.
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

    /// Estimates the sum of squared depths of points of body `a` within the reach of body `b`, from the centers of runs.
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

    /// Visits the points of a body that are beyond the border, once for each side.
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

    /// Returns whether the rectangles of two bodies are so near that the bodies are tested for contacts.
    pub(super) fn are_near(a: &[[f64; 2]; 2], b: &[[f64; 2]; 2]) -> bool {
        (0..2).all(|k| a[0][k] < b[1][k] + APART && b[0][k] < a[1][k] + APART)
    }
}

/// Number of unknowns of a body: two shifts, and an angle times its radius.
const DOF: usize = 3;
/// Added to the diagonal, so that bodies that touch nothing stay.
const LEAST: f64 = 1e-12;

type Row = [f64; DOF];
type Block = [Row; DOF];

/// Least-squares equations of a step that reduces overlaps: minimize Σ w (d − J·Δ)² over the movements Δ, where the sum is over all
/// points that are too near, with weights w and depths d.
pub(super) struct Equations {
    /// Σ w d².
    pub energy: f64,
    /// Largest depth.
    pub deepest: f64,
    /// Σ d² of each pair; empty if only one body moves.
    pub overlap: Pairs,
    /// Block of Σ w JᵀJ for each body.
    of_body: Vec<Block>,
    /// Block of Σ w JᵀJ for each two bodies that touch, sorted.
    of_pair: Vec<([usize; 2], Block)>,
    /// Σ w Jᵀd.
    right: Vec<Row>,
}

/// Returns the row of J for a contact: how fast the depth decreases with each unknown of the body whose point it is.
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
    /// Computes the equations of all bodies.
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

    /// Computes the equations of one body, while the others stay where they are.
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

    /// Adds the contacts of a body with the border, and returns their Σ d². The unknowns of the body are those at `index`.
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

    /// Adds the contacts of two bodies.
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

    /// Adds a contact, as far as it concerns one body.
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

    /// Returns the movements that minimize the sum: for each body the two shifts, and the angle times its radius. Adds `damping`
    /// times the largest diagonal entry to the diagonal. Returns `None` if the equations cannot be solved.
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

/// Returns the index of the unknown of a body's degree of freedom.
fn place(body: usize, freedom: usize) -> u32 {
    (DOF * body + freedom) as u32
}

/// Adds w a bᵀ to a block.
fn add_product(block: &mut Block, weight: f64, a: Row, b: Row) {
    for (row, x) in block.iter_mut().zip(a) {
        for (entry, y) in row.iter_mut().zip(b) {
            *entry += weight * x * y;
        }
    }
}

//! The equations of a step that separates bodies.
use super::body::{Body, Pose};
use super::contacts::{Contact, Pairs, Scene};
use crate::numerics::cholesky::SymmetricPattern;
use crate::numerics::conjugate_gradients::ConjugateGradients;

/// Unknowns of a body: two shifts and, times its radius, an angle.
const DOF: usize = 3;

/// How bodies overlap, and what a step of some of them would change: Σ w (d + J·Δ)² over all points that are too near, with
/// their depths d, to be minimized over the movements Δ.
pub(super) struct Equations {
    /// Σ w d².
    pub energy: f64,
    /// The largest depth.
    pub deepest: f64,
    /// Σ d² of each pair, where all bodies move.
    pub overlap: Pairs,
    /// Lower triangle of Σ w JᵀJ by columns, and −Σ w Jᵀd.
    matrix: Vec<f64>,
    right: Vec<f64>,
}

/// How the depth of a contact changes with a body's movement: −∂d.
fn row(body: &Body, pose: &Pose, contact: &Contact) -> [f64; DOF] {
    let Contact { point, out, .. } = contact;
    let arm = [point[0] - pose.middle[0], point[1] - pose.middle[1]];
    [
        out[0],
        out[1],
        (arm[0] * out[1] - arm[1] * out[0]) / body.radius,
    ]
}

impl Equations {
    /// Of all bodies.
    pub(super) fn of_all(scene: &mut Scene, poses: &[Pose]) -> Self {
        let n = poses.len();
        let mut equations = Self::new(n);
        let mut overlap = Pairs::new(n, 0.0);
        let bodies = scene.bodies;
        let bounds: Vec<_> = bodies
            .iter()
            .zip(poses)
            .map(|(b, pose)| b.bounds(pose))
            .collect();
        for a in 0..n {
            let weight = scene.weights.get(a, a);
            scene.contacts_of_border(a, &poses[a], |contact| {
                let row = row(&bodies[a], &poses[a], &contact);
                equations.add(weight, contact.depth, &[(a, row)]);
                *overlap.get_mut(a, a) += contact.depth.powi(2);
            });
            for b in (0..n).filter(|&b| b != a && Scene::are_near(&bounds[a], &bounds[b])) {
                let weight = scene.weights.get(a, b);
                scene.contacts([a, b], [&poses[a], &poses[b]], |contact| {
                    let rows = [
                        (a, row(&bodies[a], &poses[a], &contact)),
                        (b, row(&bodies[b], &poses[b], &contact).map(|x| -x)),
                    ];
                    equations.add(weight, contact.depth, &rows);
                    *overlap.get_mut(a, b) += contact.depth.powi(2);
                });
            }
        }
        equations.overlap = overlap;
        equations
    }

    /// Of one body, the others staying where they are; given up when the energy exceeds the limit.
    pub(super) fn of_one(
        scene: &mut Scene,
        poses: &[Pose],
        a: usize,
        pose: &Pose,
        limit: f64,
    ) -> Self {
        let mut equations = Self::new(1);
        let bodies = scene.bodies;
        let bounds = bodies[a].bounds(pose);
        let weight = scene.weights.get(a, a);
        scene.contacts_of_border(a, pose, |contact| {
            equations.add(
                weight,
                contact.depth,
                &[(0, row(&bodies[a], pose, &contact))],
            );
        });
        for b in (0..poses.len()).filter(|&b| b != a) {
            if equations.energy > limit {
                break;
            }
            if !Scene::are_near(&bounds, &bodies[b].bounds(&poses[b])) {
                continue;
            }
            let weight = scene.weights.get(a, b);
            scene.contacts([a, b], [pose, &poses[b]], |contact| {
                equations.add(
                    weight,
                    contact.depth,
                    &[(0, row(&bodies[a], pose, &contact))],
                );
            });
            scene.contacts([b, a], [&poses[b], pose], |contact| {
                let row = row(&bodies[a], pose, &contact).map(|x| -x);
                equations.add(weight, contact.depth, &[(0, row)]);
            });
        }
        equations
    }

    fn new(n_movable: usize) -> Self {
        let m = DOF * n_movable;
        Self {
            energy: 0.0,
            deepest: 0.0,
            overlap: Pairs::new(0, 0.0),
            matrix: vec![0.0; m * (m + 1) / 2],
            right: vec![0.0; m],
        }
    }

    fn add(&mut self, weight: f64, depth: f64, rows: &[(usize, [f64; DOF])]) {
        self.energy += weight * depth * depth;
        self.deepest = self.deepest.max(depth);
        let m = self.right.len();
        for &(p, of_p) in rows {
            for (k, x) in of_p.into_iter().enumerate() {
                let i = DOF * p + k;
                self.right[i] += weight * depth * x;
                for &(q, of_q) in rows {
                    for (l, y) in of_q.into_iter().enumerate() {
                        let j = DOF * q + l;
                        if j <= i {
                            self.matrix[start(m, j) + i - j] += weight * x * y;
                        }
                    }
                }
            }
        }
    }

    /// The movements that minimize the sum with `damping` times the largest diagonal entry added: for each body the shifts, and
    /// the angle times its radius.
    pub(super) fn step(&self, damping: f64) -> Option<Vec<[f64; DOF]>> {
        let m = self.right.len();
        let diagonal = |j: usize| start(m, j);
        let largest = (0..m).map(|j| self.matrix[diagonal(j)]).fold(0.0, f64::max);
        let mut matrix = self.matrix.clone();
        for j in 0..m {
            matrix[diagonal(j)] += damping * largest + f64::EPSILON;
        }
        let mut x = self.right.clone();
        let pattern = full(m);
        ConjugateGradients::new(m)
            .solve(&pattern, &matrix, &mut x)
            .ok()?;
        Some(x.chunks_exact(DOF).map(|x| [x[0], x[1], x[2]]).collect())
    }
}

/// Where column j of a full lower triangle of size m begins.
fn start(m: usize, j: usize) -> usize {
    j * (2 * m - j + 1) / 2
}

/// The full lower triangle.
fn full(m: usize) -> SymmetricPattern {
    SymmetricPattern {
        n: m,
        col_ptr: (0..=m).map(|j| start(m, j)).collect(),
        row_idx: (0..m).flat_map(|j| j..m).collect(),
    }
}

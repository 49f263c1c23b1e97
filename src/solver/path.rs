//! How handles travel to their targets.

use super::handles::{Handles, HandlesError};
use crate::numerics::square::{Matrix, Square, apply, identity, times, transposed};
use crate::numerics::vec3;

/// The way of handles from where they are to their targets, as a function of s from 0 to 1.
///
/// A group turns by the rotation that best takes it to its targets, at constant speed about its centroid, which moves
/// straight or on a bend; what is left, because the targets are not a rigid copy, is added in proportion to s.
pub struct Path<const D: usize> {
    groups: Vec<RigidMotion<D>>,
    /// Of each handle its group, its place relative to the centroid, and what the rigid motion leaves of its way.
    handles: Vec<(usize, [f64; D], [f64; D])>,
}

struct RigidMotion<const D: usize> {
    from: [f64; D],
    to: [f64; D],
    bend: [f64; 3],
    /// The rotation is exp(s·log).
    log: Matrix<D>,
}

impl<const D: usize> Path<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// From the positions in `x`.
    ///
    /// # Errors
    /// If the handles do not fit each other or `x`.
    pub fn new(handles: &Handles, x: &[f64]) -> Result<Self, HandlesError> {
        handles.check(D, x.len())?;
        let groups = handles.groups();
        let n_groups = handles.n_groups();
        let at = |v: u32| -> [f64; D] { std::array::from_fn(|k| x[D * v as usize + k]) };
        let target = |i: usize| -> [f64; D] { std::array::from_fn(|k| handles.targets[D * i + k]) };
        let mut members = vec![Vec::new(); n_groups];
        for (i, (&v, &g)) in handles.vertices.iter().zip(&*groups).enumerate() {
            members[g as usize].push((at(v), target(i)));
        }
        let bend = |group: usize| handles.bends.get(group).copied().unwrap_or_default();
        let motions: Vec<_> = (members.iter().enumerate())
            .map(|(group, members)| RigidMotion::fit(members, bend(group)))
            .collect();
        let placed = handles.vertices.iter().zip(&*groups).enumerate();
        let handles = placed.map(|(i, (&v, &g))| {
            let motion = &motions[g as usize];
            let arm = difference(at(v), motion.from);
            let rest = difference(target(i), motion.place(arm, 1.0));
            (g as usize, arm, rest)
        });
        Ok(Self {
            handles: handles.collect(),
            groups: motions,
        })
    }

    /// Where handle `i` is at `s`.
    pub fn position(&self, i: usize, s: f64) -> [f64; D] {
        let (group, arm, rest) = self.handles[i];
        let place = self.groups[group].place(arm, s);
        std::array::from_fn(|k| place[k] + s * rest[k])
    }
}

impl<const D: usize> RigidMotion<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    fn fit(members: &[([f64; D], [f64; D])], bend: [f64; 3]) -> Self {
        let n = members.len().max(1) as f64;
        let (mut from, mut to) = ([0.0; D], [0.0; D]);
        for (p, q) in members {
            for k in 0..D {
                from[k] += p[k] / n;
                to[k] += q[k] / n;
            }
        }
        let mut covariance = [[0.0; D]; D];
        for (p, q) in members {
            let (p, q) = (difference(*p, from), difference(*q, to));
            for r in 0..D {
                for c in 0..D {
                    covariance[r][c] += q[r] * p[c];
                }
            }
        }
        let svd = covariance.svd(covariance.det());
        // A group along a line, or a single vertex, has no best rotation.
        let log = if svd.sigma[D - 2] > 1e-9 * svd.sigma[0] || D == 2 && svd.sigma[0] > 0.0 {
            times(&svd.u, &transposed(&svd.v)).log()
        } else {
            [[0.0; D]; D]
        };
        Self {
            from,
            to,
            bend,
            log,
        }
    }

    fn place(&self, arm: [f64; D], s: f64) -> [f64; D] {
        let turned = apply(&Matrix::<D>::exp(&self.log, s), &arm);
        let aside = aside(difference(self.to, self.from), self.bend, s);
        std::array::from_fn(|k| (1.0 - s) * self.from[k] + s * self.to[k] + turned[k] + aside[k])
    }
}

/// How far from a straight way one with this bend, see [`Handles::bends`], is at `s`.
pub(super) fn aside<const D: usize>(way: [f64; D], bend: [f64; 3], s: f64) -> [f64; D] {
    let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
    std::array::from_fn(|k| 2.0 * s * (1.0 - s) * length * bend[k])
}

fn difference<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] - b[k])
}

/// Rotations and their logarithms.
pub trait Rotation<const D: usize> {
    /// The antisymmetric matrix of the rotation with the smallest angle; at half a turn one of the two.
    fn log(&self) -> Matrix<D>;
    /// The rotation exp(s·log).
    fn exp(log: &Matrix<D>, s: f64) -> Matrix<D>;
}

impl Rotation<2> for Matrix<2> {
    fn log(&self) -> Self {
        let angle = self[1][0].atan2(self[0][0]);
        [[0.0, -angle], [angle, 0.0]]
    }

    fn exp(log: &Self, s: f64) -> Self {
        let (sin, cos) = (s * log[1][0]).sin_cos();
        [[cos, -sin], [sin, cos]]
    }
}

impl Rotation<3> for Matrix<3> {
    fn log(&self) -> Self {
        let trace = self[0][0] + self[1][1] + self[2][2];
        let twice_axis = [
            self[2][1] - self[1][2],
            self[0][2] - self[2][0],
            self[1][0] - self[0][1],
        ];
        let sin = 0.5 * vec3::norm(twice_axis);
        let angle = sin.atan2(0.5 * (trace - 1.0));
        let axis = if sin > 1e-6 {
            twice_axis.map(|a| a / (2.0 * sin))
        } else if trace > 0.0 {
            return [[0.0; 3]; 3];
        } else {
            half_turn_axis(self)
        };
        let [x, y, z] = axis.map(|a| angle * a);
        [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    }

    /// Rodrigues.
    fn exp(log: &Self, s: f64) -> Self {
        let w = [log[2][1], log[0][2], log[1][0]];
        let speed = vec3::norm(w);
        if speed == 0.0 {
            return identity(1.0);
        }
        let square = times(log, log);
        let (sin, cos) = (s * speed).sin_cos();
        let (a, b) = (sin / speed, (1.0 - cos) / (speed * speed));
        std::array::from_fn(|r| {
            std::array::from_fn(|c| f64::from(u8::from(r == c)) + a * log[r][c] + b * square[r][c])
        })
    }
}

/// The axis of a rotation by half a turn, R = 2aaᵀ − I.
fn half_turn_axis(rotation: &Matrix<3>) -> [f64; 3] {
    let largest = (0..3)
        .max_by(|&i, &j| rotation[i][i].total_cmp(&rotation[j][j]))
        .unwrap_or(0);
    let column = std::array::from_fn(|r| rotation[r][largest] + f64::from(u8::from(r == largest)));
    vec3::unit(column)
}

//! Paths of handles to their targets.

use super::handles::{Handles, HandlesError};
pub use crate::numerics::rotation::Rotation;
use crate::numerics::rotation::{best_rotation, centroids};
use crate::numerics::square::{Matrix, Square, apply};

/// Path of handles from their positions to their targets, as a function of s from 0 to 1.
///
/// A group turns by the rotation that best takes it to its targets, at constant speed about its centroid, which moves
/// on a straight or bent line. The remainder, if the targets are not a rigid copy, is added in proportion to s.
pub struct Path<const D: usize> {
    groups: Vec<RigidMotion<D>>,
    /// For each handle its group, its position relative to the centroid, and the part of its path that the rigid motion
    /// leaves.
    handles: Vec<(usize, [f64; D], [f64; D])>,
}

struct RigidMotion<const D: usize> {
    from: [f64; D],
    to: [f64; D],
    bend: [f64; 3],
    /// Logarithm of the rotation, which is exp(s·log) at s.
    log: Matrix<D>,
}

impl<const D: usize> Path<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// Creates the paths from the positions in `x`.
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

    /// Returns the position of handle `i` at `s`.
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
        let (from, to) = centroids(members);
        let rotation = best_rotation(members);
        let log = rotation.map_or([[0.0; D]; D], |rotation| rotation.log());
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

/// Returns the offset at `s` of a path with this bend, see [`Handles::bends`], from a straight one.
pub(super) fn aside<const D: usize>(way: [f64; D], bend: [f64; 3], s: f64) -> [f64; D] {
    let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
    std::array::from_fn(|k| 2.0 * s * (1.0 - s) * length * bend[k])
}

fn difference<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] - b[k])
}

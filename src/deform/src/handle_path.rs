//! Path of a handle.

use unwrapd_method::numerics::vec3;
use unwrapd_method::solver::Handles;

/// Bend of paths, in halves of their length: two handles that change places then pass each other at half the distance
/// that they had.
pub(super) const BEND: f64 = 0.5;

/// Path of a group's centroid or of a point; in the plane the third coordinates are 0.
#[derive(Clone, Copy, Default)]
pub(super) struct HandlePath {
    pub from: [f64; 3],
    pub to: [f64; 3],
}

impl HandlePath {
    pub fn length(&self) -> f64 {
        vec3::distance(self.from, self.to)
    }

    /// Returns the unit bend to the left, looking along the path with `axis` up; zero for paths along the axis.
    pub fn left(&self, axis: [f64; 3]) -> [f64; 3] {
        vec3::unit(vec3::cross(axis, vec3::sub(self.to, self.from)))
    }
}

/// Returns the paths of the groups and then of the points from their positions in `x`; a number without a group has a
/// path of length zero.
pub(super) fn paths(dim: usize, handles: &Handles, x: &[f64]) -> Vec<HandlePath> {
    let place = |numbers: &[f64]| -> [f64; 3] {
        std::array::from_fn(|k| numbers.get(k).copied().unwrap_or(0.0))
    };
    let at = |v: u32| place(&x[dim * v as usize..dim * (v as usize + 1)]);
    let mut paths = vec![HandlePath::default(); handles.n_groups()];
    let mut members = vec![0.0; paths.len()];
    let targets = handles.targets.chunks_exact(dim.max(1));
    for ((&v, &group), target) in (handles.vertices.iter().zip(&*handles.groups())).zip(targets) {
        let path = &mut paths[group as usize];
        path.from = vec3::add_scaled(path.from, 1.0, at(v));
        path.to = vec3::add_scaled(path.to, 1.0, place(target));
        members[group as usize] += 1.0;
    }
    for (path, members) in paths.iter_mut().zip(members) {
        if members > 0.0 {
            path.from = path.from.map(|x| x / members);
            path.to = path.to.map(|x| x / members);
        }
    }
    let targets = handles.point_targets.chunks_exact(dim.max(1));
    paths.extend(
        handles
            .points
            .iter()
            .zip(targets)
            .map(|(row, target)| HandlePath {
                from: (row.iter()).fold([0.0; 3], |sum, &(v, weight)| {
                    vec3::add_scaled(sum, weight, at(v))
                }),
                to: place(target),
            }),
    );
    paths
}

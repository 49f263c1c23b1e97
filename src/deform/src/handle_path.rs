//! Path of a handle.

use super::body::axes;
use super::problem::Problem;
use unwrapd_method::numerics::random::Random;
use unwrapd_method::numerics::vec3;
use unwrapd_method::solver::{Handles, Objective};

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

// Bends of paths to try.

/// Most bends that are tried: each may cost as many iterations as the straight paths.
const MOST: usize = 8;

/// A path shorter than this share of the longest counts as having length zero.
const SHORTEST: f64 = 1e-9;

impl Problem {
    /// Returns the bends to try, in order: all to the left and to the right of a few axes, those that keep the handles
    /// apart, stronger ones, and mixed ones.
    pub(super) fn bends(&self) -> Vec<Vec<[f64; 3]>> {
        let Some(last) = self.stations.last() else {
            return Vec::new();
        };
        let paths = paths(self.body.dim(), last, &self.start);
        let longest = paths.iter().map(HandlePath::length).fold(0.0, f64::max);
        let is_moving = |path: &HandlePath| path.length() > SHORTEST * longest;
        let axes = axes(&self.body);
        let bent = |axis: [f64; 3], bend: &dyn Fn(usize) -> f64| {
            let mut n_moving = 0;
            let bends = paths.iter().map(|path| {
                n_moving += usize::from(is_moving(path));
                path.left(axis).map(|x| bend(n_moving) * x)
            });
            bends.collect::<Vec<_>>()
        };
        let mut all = Vec::new();
        for &axis in &axes {
            all.extend([BEND, -BEND].map(|height| bent(axis, &|_| height)));
        }
        let first = axes[0];
        all.push(apart(&paths, &axes));
        all.extend([1.0, -1.0].map(|side| bent(first, &|_| 2.0 * side * BEND)));
        all.extend([0, 1].map(|odd| bent(first, &|n| if n % 2 == odd { BEND } else { -BEND })));
        distinct(all)
    }
}

/// Returns the first bends that differ from straight paths and from each other, at most [`MOST`].
fn distinct(all: Vec<Vec<[f64; 3]>>) -> Vec<Vec<[f64; 3]>> {
    let mut kept: Vec<Vec<[f64; 3]>> = Vec::new();
    for bends in all {
        let is_straight = bends.as_flattened().iter().all(|&x| x == 0.0);
        if !is_straight && !kept.contains(&bends) && kept.len() < MOST {
            kept.push(bends);
        }
    }
    kept
}

// Bends that keep handles apart from each other on their paths.

/// Samples of a path at which it is compared with others. More see closer passes, at a cost in proportion.
const PLACES: usize = 16;

/// Most sweeps in which every path chooses its bend anew.
const SWEEPS: usize = 10;

/// Most paths that are compared pair by pair: 45,000 pairs.
const MOST_COMPARED: usize = 300;

/// Heights of bends to choose from, in units of [`BEND`].
const HEIGHTS: [f64; 6] = [-2.0, -1.0, -0.5, 0.5, 1.0, 2.0];

/// Chooses a bend for each path greedily, in several sweeps, so that handles moving at the same time come as little
/// closer to each other than at the start or the end as possible. With more than [`MOST_COMPARED`] paths all stay
/// straight.
fn apart(paths: &[HandlePath], axes: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut bends = vec![[0.0; 3]; paths.len()];
    if paths.len() > MOST_COMPARED {
        return bends;
    }
    let mut tracks: Vec<Track> = paths.iter().map(|path| track(path, [0.0; 3])).collect();
    for _ in 0..SWEEPS {
        let mut has_changed = false;
        // Let each path in turn choose the bend that crowds the others least.
        for (i, path) in paths
            .iter()
            .enumerate()
            .filter(|(_, path)| path.length() > 0.0)
        {
            let crowding = |candidate: &Track| -> f64 {
                let others = tracks.iter().enumerate().filter(|&(j, _)| j != i);
                others.map(|(_, other)| closeness(candidate, other)).sum()
            };
            let mut least = crowding(&tracks[i]);
            let mut chosen = None;
            for bend in choices(path, axes) {
                let candidate = track(path, bend);
                let crowding = crowding(&candidate);
                // Rounding must not exchange equally good bends: sweeps would not end.
                if crowding < (1.0 - 1e-9) * least {
                    (least, chosen) = (crowding, Some((bend, candidate)));
                }
            }
            if let Some((bend, track)) = chosen {
                (bends[i], tracks[i]) = (bend, track);
                has_changed = true;
            }
        }
        if !has_changed {
            break;
        }
    }
    bends
}

type Track = [[f64; 3]; PLACES + 1];

fn choices(path: &HandlePath, axes: &[[f64; 3]]) -> impl Iterator<Item = [f64; 3]> {
    axes.iter()
        .flat_map(|axis: &[f64; 3]| {
            let left = path.left(*axis);
            HEIGHTS.map(|height| left.map(|x| height * BEND * x))
        })
        .chain([[0.0; 3]])
}

/// Returns the positions of a handle at equal time steps.
fn track(path: &HandlePath, bend: [f64; 3]) -> Track {
    let straight = vec3::sub(path.to, path.from);
    std::array::from_fn(|k| {
        let s = k as f64 / PLACES as f64;
        let height = 2.0 * s * (1.0 - s) * path.length();
        vec3::add_scaled(vec3::add_scaled(path.from, s, straight), height, bend)
    })
}

/// Measures by how much two handles come closer than at the start or the end: the sum of the squared ratios.
fn closeness(one: &Track, other: &Track) -> f64 {
    let squared = |k: usize| {
        let apart = vec3::sub(one[k], other[k]);
        vec3::dot(apart, apart)
    };
    let ends = squared(0).min(squared(PLACES));
    if ends == 0.0 {
        return 0.0;
    }
    (1..PLACES)
        .map(|k| ends / squared(k).max(1e-6 * ends))
        .sum()
}

// Small perturbations that break symmetries.

/// Distance by which free vertices are moved from exact rest, in edges of the smallest element. A straight bar that is
/// pressed then buckles at once instead of staying on the saddle of its symmetry.
const SHAKE: f64 = 1e-3;

impl Problem {
    /// Moves free vertices a little, each toward another one drawn from a fixed seed, independent of unit, place and
    /// direction. Does nothing if that would leave the domain.
    pub(super) fn shake(&self, objective: &Objective, x: &mut [f64]) {
        let (dim, n_vertices) = (self.body.dim(), self.body.n_vertices());
        let sizes = self.body.determinants().into_iter();
        let smallest = sizes.fold(f64::INFINITY, f64::min);
        let amplitude = SHAKE * smallest.powf(1.0 / dim as f64);
        let mut is_held = vec![false; n_vertices];
        for &v in self.stations.iter().flat_map(|handles| &handles.vertices) {
            is_held[v as usize] = true;
        }
        let mut random = Random::new(0);
        let mut moves = vec![0.0; x.len()];
        for v in 0..n_vertices {
            let (other, share) = (random.below(n_vertices), random.unit());
            let path = |k: usize| x[dim * other + k] - x[dim * v + k];
            let length = (0..dim).map(|k| path(k) * path(k)).sum::<f64>().sqrt();
            if is_held[v] || length == 0.0 {
                continue;
            }
            for k in 0..dim {
                moves[dim * v + k] = amplitude * share * path(k) / length;
            }
        }
        if objective.largest_step(x, &moves) > 1.0 {
            for (x, d) in x.iter_mut().zip(moves) {
                *x += d;
            }
        }
    }
}

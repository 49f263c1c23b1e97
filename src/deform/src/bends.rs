//! Bends of paths to try.

use super::axes::axes;
use super::handle_path::{BEND, HandlePath, paths};
use super::problem::Problem;
use unwrapd_method::numerics::vec3;

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
    let bent = |axis: &[f64; 3]| {
        let left = path.left(*axis);
        HEIGHTS.map(|height| left.map(|x| height * BEND * x))
    };
    axes.iter().flat_map(bent).chain([[0.0; 3]])
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

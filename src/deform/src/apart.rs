//! Bends that keep handles apart from each other on their paths.

use super::way::{BEND, Way};
use unwrapd_method::numerics::vec3;

/// Samples of a path at which it is compared with others.
const PLACES: usize = 16;

/// Most sweeps in which every path chooses its bend anew.
const SWEEPS: usize = 10;

/// Most paths that are compared pair by pair.
const MOST: usize = 300;

/// Heights of bends to choose from, in units of [`BEND`].
const HEIGHTS: [f64; 6] = [-2.0, -1.0, -0.5, 0.5, 1.0, 2.0];

/// Chooses a bend for each path greedily, in several sweeps, so that handles moving at the same time come as little
/// closer to each other than at the start or the end as possible. With more than [`MOST`] paths all stay straight.
pub(super) fn apart(ways: &[Way], axes: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut bends = vec![[0.0; 3]; ways.len()];
    if ways.len() > MOST {
        return bends;
    }
    let mut tracks: Vec<Track> = ways.iter().map(|way| track(way, [0.0; 3])).collect();
    for _ in 0..SWEEPS {
        let mut has_changed = false;
        for (i, way) in ways
            .iter()
            .enumerate()
            .filter(|(_, way)| way.length() > 0.0)
        {
            let crowding = |candidate: &Track| -> f64 {
                let others = tracks.iter().enumerate().filter(|&(j, _)| j != i);
                others.map(|(_, other)| closeness(candidate, other)).sum()
            };
            let mut least = crowding(&tracks[i]);
            let mut chosen = None;
            for bend in choices(way, axes) {
                let candidate = track(way, bend);
                let crowding = crowding(&candidate);
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

fn choices(way: &Way, axes: &[[f64; 3]]) -> impl Iterator<Item = [f64; 3]> {
    let bent = |axis: &[f64; 3]| {
        let left = way.left(*axis);
        HEIGHTS.map(|height| left.map(|x| height * BEND * x))
    };
    axes.iter().flat_map(bent).chain([[0.0; 3]])
}

/// Returns the positions of a handle at equal time steps.
fn track(way: &Way, bend: [f64; 3]) -> Track {
    let straight = vec3::sub(way.to, way.from);
    std::array::from_fn(|k| {
        let s = k as f64 / PLACES as f64;
        let height = 2.0 * s * (1.0 - s) * way.length();
        vec3::add_scaled(vec3::add_scaled(way.from, s, straight), height, bend)
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

//! Bends of paths to try.

use super::apart::apart;
use super::axes::axes;
use super::problem::Problem;
use super::way::{BEND, Way, ways};

/// Most bends that are tried.
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
        let ways = ways(self.body.dim(), last, &self.start);
        let longest = ways.iter().map(Way::length).fold(0.0, f64::max);
        let is_moving = |way: &Way| way.length() > SHORTEST * longest;
        let axes = axes(&self.body);
        let bent = |axis: [f64; 3], bend: &dyn Fn(usize) -> f64| {
            let mut n_moving = 0;
            let bends = ways.iter().map(|way| {
                n_moving += usize::from(is_moving(way));
                way.left(axis).map(|x| bend(n_moving) * x)
            });
            bends.collect::<Vec<_>>()
        };
        let mut all = Vec::new();
        for &axis in &axes {
            all.extend([BEND, -BEND].map(|height| bent(axis, &|_| height)));
        }
        let first = axes[0];
        all.push(apart(&ways, &axes));
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

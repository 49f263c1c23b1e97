//! Ragged borders of regions evened out.

use unwrapd_maps::mesh::CUT;
use unwrapd_method::numerics::vec3::{dot, unit};

/// Sweeps over all triangles; a tooth deeper than this many triangles stays.
const SWEEPS: usize = 4;

/// A triangle changes sides only where its normal is at least this close (as a cosine) to the other region's mean.
const CLOSE: f64 = 0.5;

/// Gives triangles that stick out of their region to the region they stick into.
///
/// A triangle with one neighbor in its own region and two in another goes over to it if that shortens the border. It hangs
/// on its region by one edge only, so the region stays connected.
pub fn smooth_borders(
    region: &mut [u32],
    normals: &[[f64; 3]],
    across: &[u32],
    length: impl Fn(u32) -> f64,
) {
    let n_regions = region.iter().max().map_or(0, |&r| r as usize + 1);
    let mut sums = vec![[0.0; 3]; n_regions];
    for (&r, normal) in region.iter().zip(normals) {
        for (s, x) in sums[r as usize].iter_mut().zip(normal) {
            *s += x;
        }
    }
    let axes: Vec<[f64; 3]> = sums.into_iter().map(unit).collect();
    for _ in 0..SWEEPS {
        let mut any = false;
        for f in 0..region.len() as u32 {
            let own = region[f as usize];
            let sides = [3 * f, 3 * f + 1, 3 * f + 2];
            let beyond = sides.map(|h| match across[h as usize] {
                CUT => None,
                t => Some(region[t as usize / 3]),
            });
            let Some(inner) = (0..3).find(|&i| beyond[i] == Some(own)) else {
                continue;
            };
            let (left, right) = ((inner + 1) % 3, (inner + 2) % 3);
            let (Some(other), true) = (beyond[left], beyond[left] == beyond[right]) else {
                continue;
            };
            let saved = length(sides[left]) + length(sides[right]) - length(sides[inner]);
            let direction = unit(normals[f as usize]);
            let fits = direction == [0.0; 3] || dot(direction, axes[other as usize]) > CLOSE;
            if other != own && saved > 0.0 && fits {
                region[f as usize] = other;
                any = true;
            }
        }
        if !any {
            return;
        }
    }
}

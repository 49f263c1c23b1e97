//! Largest step before a boundary meets itself.

use super::gap::Gap;
use super::pairs::{near_pairs, place};

/// Longest step that is ever asked for: twice a Newton step.
pub(super) const LONGEST: f64 = 2.0;

/// Growth of the searched part of a step while it has no contact.
const GROWTH: f64 = 4.0;

/// Least share of a distance left at the reported contact; at most twice that.
const LEFT: f64 = 0.1;

/// Most advances. Each is safe, so a pair that slides for long only gets a shorter step.
const MOST_ADVANCES: usize = 100;

/// Returns a time t > 0 before which no pair of a boundary meets when its vertices move from `x` along `direction`; +∞
/// if none does up to [`LONGEST`]. At most a fifth short of the first contact, unless a pair slides.
///
/// Searches piece by piece, the first no longer than `reach`, so that a long direction does not sweep over everything.
pub(super) fn time_of_contact(edges: &[[u32; 2]], x: &[f64], direction: &[f64], reach: f64) -> f64 {
    let motion = relative(edges, direction);
    let speeds = edges.iter().map(|e| norm(place(&motion, e[0])));
    let fastest = speeds.fold(0.0, f64::max);
    if fastest == 0.0 {
        return f64::INFINITY;
    }
    let mut horizon = (reach / fastest).min(LONGEST);
    loop {
        let to: Vec<f64> = (x.iter().zip(&motion))
            .map(|(x, d)| x + horizon * d)
            .collect();
        let mut first = horizon;
        // The boxes are a little larger than the way, so that rounding hides no contact.
        near_pairs(edges, (x, &to), 1e-6 * reach, |pair| {
            first = contact_before(first, pair.places(x), pair.places(&motion));
        });
        if first < horizon {
            return first;
        }
        if horizon >= LONGEST {
            return f64::INFINITY;
        }
        horizon = (GROWTH * horizon).min(LONGEST);
    }
}

/// Subtracts the mean motion of the boundary, which brings nothing nearer.
fn relative(edges: &[[u32; 2]], direction: &[f64]) -> Vec<f64> {
    let mut mean = [0.0; 2];
    for edge in edges {
        let d = place(direction, edge[0]);
        for k in 0..2 {
            mean[k] += d[k] / edges.len() as f64;
        }
    }
    let mut motion = direction.to_vec();
    for d in motion.as_chunks_mut::<2>().0 {
        *d = [d[0] - mean[0], d[1] - mean[1]];
    }
    motion
}

/// Returns a time before the vertex and the edge of a pair meet if that is less than `most`, else `most`.
///
/// In a time t the distance falls by at most t times the greatest relative speed, so each advance by what this allows
/// is safe.
fn contact_before(most: f64, places: [[f64; 2]; 3], motion: [[f64; 2]; 3]) -> f64 {
    let mean = [0, 1].map(|k| (motion[0][k] + motion[1][k] + motion[2][k]) / 3.0);
    let motion = motion.map(|d| [d[0] - mean[0], d[1] - mean[1]]);
    let speed = norm(motion[0]) + norm(motion[1]).max(norm(motion[2]));
    let distance_at = |t: f64| {
        let moved = [0, 1, 2].map(|i| [0, 1].map(|k| places[i][k] + t * motion[i][k]));
        Gap::new(moved).distance
    };
    let mut distance = distance_at(0.0);
    let left = LEFT * distance;
    let mut time = 0.0;
    for _ in 0..MOST_ADVANCES {
        let advanced = time + (distance - left) / speed;
        if advanced >= most || advanced.is_nan() {
            return most;
        }
        time = advanced;
        distance = distance_at(time);
        if distance < 2.0 * left {
            break;
        }
    }
    time
}

fn norm([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

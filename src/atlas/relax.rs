//! Opens triangles that are too narrow for the grid.
//!
//! Every triangle of a patch gets a rest shape: its own, or, where its smallest height is below a
//! few grid cells, one with that height. The sum of the symmetric Dirichlet energies of the maps
//! from rest to plane,
//!
//! ```text
//! ψ(J) = ‖J‖² (1 + 1 / det J²)      = 4 for a rigid map, ∞ for a triangle without area
//! ```
//!
//! is lowered one vertex at a time by Newton's method in two unknowns (Smith and Schaefer 2015 for
//! the energy). Each step lowers the energy and keeps every triangle of the ring strictly positive,
//! by exact predicates, so the procedure cannot invalidate a map and ends; it stops as soon as all
//! heights survive rounding. Vertices whose ring leaves the patch stay where they are.
use super::snap::Rings;
use crate::numerics::predicates::orient2d_sign;

/// Smallest height of a rest shape, in grid cells.
const REST_HEIGHT: f64 = 4.0;
/// A triangle whose heights are at least this stays positive when its corners are rounded (each moves
/// by √½ at most, so √2 would do) and next to corners that were rounded less luckily before.
const SAFE_HEIGHT: f64 = 2.0;
/// Passes over the patch.
const SWEEPS: usize = 400;
/// Vertex steps over all passes, for large patches.
const STEPS: usize = 4_000_000;
/// A step that lowers a ring's energy by less than this fraction is the last until a neighbour moves.
const PROGRESS: f64 = 1e-4;

/// Moves vertices of the patch so that no height in it is too small for a grid of the given cell;
/// returns the vertices it was allowed to move. `plane` must be strictly positive on the patch.
pub(super) fn relax(
    triangles: &[[u32; 3]],
    rings: &Rings,
    patch: &[u32],
    cell: f64,
    plane: &mut [[f64; 2]],
) -> Vec<u32> {
    let local = |t: u32| patch.binary_search(&t).ok();
    let mut free: Vec<u32> = patch.iter().flat_map(|&t| triangles[t as usize]).collect();
    free.sort_unstable();
    free.dedup();
    free.retain(|&v| rings.of(v).iter().all(|&t| local(t).is_some()));
    let corners = |t: u32, plane: &[[f64; 2]]| triangles[t as usize].map(|v| plane[v as usize]);
    let stars: Vec<Vec<Spoke>> = free
        .iter()
        .map(|&v| {
            let ring = rings.of(v).iter();
            ring.map(|&t| {
                Spoke::new(
                    v,
                    triangles[t as usize],
                    &rest(corners(t, plane), cell * REST_HEIGHT),
                )
            })
            .collect()
        })
        .collect();
    let mut watched: Vec<u32> = patch.to_vec();
    watched.retain(|&t| {
        triangles[t as usize]
            .iter()
            .any(|v| free.binary_search(v).is_ok())
    });
    let mut awake = vec![true; free.len()];
    for _ in 0..SWEEPS.min(STEPS / free.len().max(1)).max(8) {
        if watched
            .iter()
            .all(|&t| height(corners(t, plane)) >= SAFE_HEIGHT * cell)
        {
            break;
        }
        for (i, &v) in free.iter().enumerate() {
            if !std::mem::replace(&mut awake[i], false) || !step(v, &stars[i], plane) {
                continue;
            }
            for w in rings.of(v).iter().flat_map(|&t| triangles[t as usize]) {
                if let Ok(j) = free.binary_search(&w) {
                    awake[j] = true;
                }
            }
        }
        if !awake.contains(&true) {
            break;
        }
    }
    free
}

/// A triangle as one of its vertices sees it.
struct Spoke {
    /// The other two vertices, counter-clockwise.
    others: [u32; 2],
    /// Gradients of the hat functions of the vertex and the first other one, on the rest shape.
    own: [f64; 2],
    next: [f64; 2],
    /// Twice the rest area, inverted.
    density: f64,
}

impl Spoke {
    fn new(v: u32, triangle: [u32; 3], rest: &[[f64; 2]; 3]) -> Self {
        let i = triangle.iter().position(|&w| w == v).unwrap_or(0);
        let [a, b, c] = [0, 1, 2].map(|k| rest[(i + k) % 3]);
        let density = 1.0 / doubled([a, b, c]);
        // The gradient is the opposite edge turned by a quarter, over twice the area.
        let gradient =
            |p: [f64; 2], q: [f64; 2]| [(p[1] - q[1]) * density, (q[0] - p[0]) * density];
        Self {
            others: [triangle[(i + 1) % 3], triangle[(i + 2) % 3]],
            own: gradient(b, c),
            next: gradient(c, a),
            density,
        }
    }

    /// ‖J‖², det J and the first column block J·own for the vertex at `p`; no value if not positive.
    fn jacobian(&self, p: [f64; 2], plane: &[[f64; 2]]) -> Option<(f64, f64, [f64; 2], [f64; 2])> {
        let [b, c] = self.others.map(|w| plane[w as usize]);
        let area = positive_doubled([p, b, c])?;
        let (u, w) = ([p[0] - c[0], p[1] - c[1]], [b[0] - c[0], b[1] - c[1]]);
        let row = |k: usize| [0, 1].map(|j| u[k] * self.own[j] + w[k] * self.next[j]);
        let rows = [row(0), row(1)];
        let norm = rows.iter().flatten().map(|x| x * x).sum();
        let along = rows.map(|row| row[0] * self.own[0] + row[1] * self.own[1]);
        // d(det)/dp: the edge b→c turned by a quarter.
        let turn = [(b[1] - c[1]) * self.density, (c[0] - b[0]) * self.density];
        Some((norm, area * self.density, along, turn))
    }

    fn energy(&self, p: [f64; 2], plane: &[[f64; 2]]) -> f64 {
        self.jacobian(p, plane)
            .map_or(f64::INFINITY, |(norm, det, ..)| {
                norm * (1.0 + 1.0 / (det * det))
            })
    }
}

/// One Newton step of one vertex; whether the energy fell noticeably.
fn step(v: u32, star: &[Spoke], plane: &mut [[f64; 2]]) -> bool {
    let p = plane[v as usize];
    let energy = |p: [f64; 2]| star.iter().map(|spoke| spoke.energy(p, plane)).sum::<f64>();
    let before = energy(p);
    let (mut g, mut h) = ([0.0; 2], [0.0; 3]);
    let mut slopes = Vec::with_capacity(star.len());
    for spoke in star {
        let Some((norm, det, along, turn)) = spoke.jacobian(p, plane) else {
            return false;
        };
        let (inverse, own) = (1.0 / det, spoke.own[0].powi(2) + spoke.own[1].powi(2));
        let (outer, cube) = (1.0 + inverse * inverse, 2.0 * inverse.powi(3));
        let d_norm = along.map(|x| 2.0 * x);
        for k in 0..2 {
            g[k] += d_norm[k] * outer - norm * cube * turn[k];
        }
        let quartic = 3.0 * norm * cube * inverse;
        h[0] += 2.0 * own * outer - 2.0 * cube * d_norm[0] * turn[0] + quartic * turn[0] * turn[0];
        h[1] += -cube * (d_norm[0] * turn[1] + d_norm[1] * turn[0]) + quartic * turn[0] * turn[1];
        h[2] += 2.0 * own * outer - 2.0 * cube * d_norm[1] * turn[1] + quartic * turn[1] * turn[1];
        slopes.push((det, turn));
    }
    let d = newton_direction(g, h);
    let inversion = |&(det, turn): &(f64, [f64; 2])| {
        let slope = turn[0] * d[0] + turn[1] * d[1];
        if slope < 0.0 {
            -det / slope
        } else {
            f64::INFINITY
        }
    };
    let largest = slopes.iter().map(inversion).fold(f64::INFINITY, f64::min);
    let at = |t: f64| [p[0] + t * d[0], p[1] + t * d[1]];
    let mut t = 1.0_f64.min(0.9 * largest);
    let mut value = energy(at(t));
    for _ in 0..60 {
        if value < before {
            break;
        }
        t /= 2.0;
        value = energy(at(t));
    }
    // Far from the minimum a Newton step on an inverse square is short by design.
    while value < before && 2.0 * t < 0.95 * largest && energy(at(2.0 * t)) < value {
        t *= 2.0;
        value = energy(at(t));
    }
    let fell = value < before;
    if fell {
        plane[v as usize] = at(t);
    }
    fell && value < (1.0 - PROGRESS) * before
}

/// −|H|⁻¹ g: the Hessian with the absolute values of its eigenvalues, always a descent direction.
fn newton_direction(g: [f64; 2], [xx, xy, yy]: [f64; 3]) -> [f64; 2] {
    let (mean, half) = (f64::midpoint(xx, yy), (xx - yy) / 2.0);
    let radius = half.hypot(xy);
    let (c, s) = if radius > 0.0 {
        let angle = xy.atan2(half) / 2.0;
        (angle.cos(), angle.sin())
    } else {
        (1.0, 0.0)
    };
    let floor = 1e-12 * (mean.abs() + radius) + f64::MIN_POSITIVE;
    let along = -(c * g[0] + s * g[1]) / (mean + radius).abs().max(floor);
    let across = -(c * g[1] - s * g[0]) / (mean - radius).abs().max(floor);
    [c * along - s * across, s * along + c * across]
}

/// The triangle itself, moved, or opened until its smallest height is `least`.
fn rest(triangle: [[f64; 2]; 3], least: f64) -> [[f64; 2]; 3] {
    let edge = |i: usize| {
        let (p, q) = (triangle[i], triangle[(i + 1) % 3]);
        [q[0] - p[0], q[1] - p[1]]
    };
    let length = |i: usize| edge(i)[0].hypot(edge(i)[1]);
    let longest = (0..3)
        .max_by(|&i, &j| length(i).total_cmp(&length(j)))
        .unwrap_or(0);
    let base = edge(longest);
    let last = edge((longest + 2) % 3);
    // The equilateral triangle of that height has sides 2/√3 times as long.
    let side = length(longest).max(least * 2.0 / 3.0_f64.sqrt());
    let foot = -(last[0] * base[0] + last[1] * base[1]) / length(longest).powi(2);
    let foot = if foot.is_finite() {
        foot.clamp(0.0, 1.0)
    } else {
        0.5
    };
    let mut shape = [[0.0; 2]; 3];
    shape[(longest + 1) % 3] = [side, 0.0];
    shape[(longest + 2) % 3] = [foot * side, height(triangle).max(least)];
    shape
}

/// Smallest height.
fn height([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let length = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let longest = length(a, b).max(length(b, c)).max(length(c, a));
    positive_doubled([a, b, c]).map_or(0.0, |area| area / longest)
}

fn doubled([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Twice the area if that is exactly positive; where rounding hides its value, a small positive one.
fn positive_doubled([a, b, c]: [[f64; 2]; 3]) -> Option<f64> {
    let (left, right) = ((b[0] - a[0]) * (c[1] - a[1]), (b[1] - a[1]) * (c[0] - a[0]));
    let unsure = 1e-15 * (left.abs() + right.abs());
    if left - right > unsure {
        return Some(left - right);
    }
    (orient2d_sign(a, b, c) > 0).then(|| (left - right).max(0.1 * unsure).max(f64::MIN_POSITIVE))
}

//! Vertices that keep their places of the start.

use unwrapd_method::numerics::hull::convex_hull;

/// Vertices that keep their exact places of the start while the others move (Schüller et al. 2013).
///
/// [`Lscm`](unwrapd_method::energy::Lscm) falls when a map shrinks: without pins only the barrier keeps it from
/// collapsing to a point. Two pins fix its size; other energies lose only their freedom to move
/// and to turn, and the distance of the pins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pins {
    /// No vertices.
    #[default]
    None,
    /// Two vertices of the outer boundary that are far from each other in a nearly isometric map, as far apart as
    /// there. Opposite vertices of Tutte's circle, at its diameter, are wrong for a long surface: its least-squares
    /// conformal map would end smaller than the surface and be shaped by the barrier. Energies that depend on size
    /// would pay for any distance except that in a minimum of their own, so it is taken from one, at the price of a
    /// minimization without pins.
    Two,
}

/// Most corners of a convex hull that are compared with each other, two million pairs; of more, as on a circle, every
/// k-th is enough.
const MOST_CORNERS: usize = 2_048;

/// Returns the two vertices of a loop that are farthest apart in a map. O(n log n).
pub(super) fn far_pair(boundary: &[u32], uv: &[[f64; 2]]) -> [u32; 2] {
    let hull = convex_hull(boundary.iter().map(|&v| uv[v as usize]));
    let step = hull.len().div_ceil(MOST_CORNERS).max(1);
    let hull: Vec<[f64; 2]> = hull.into_iter().step_by(step).collect();
    let mut farthest = ([0.0; 2], [0.0; 2], 0.0);
    for (i, &p) in hull.iter().enumerate() {
        for &q in &hull[i + 1..] {
            let apart = (q[0] - p[0]).hypot(q[1] - p[1]);
            if apart > farthest.2 {
                farthest = (p, q, apart);
            }
        }
    }
    let vertex = |p: [f64; 2]| boundary.iter().copied().find(|&v| uv[v as usize] == p);
    let first = boundary.first().copied().unwrap_or_default();
    [farthest.0, farthest.1].map(|p| vertex(p).unwrap_or(first))
}

/// Returns the distance of two vertices in a map.
pub(super) fn distance(uv: &[[f64; 2]], pair: [u32; 2]) -> f64 {
    let [[x, y], [u, v]] = pair.map(|vertex| uv[vertex as usize]);
    (u - x).hypot(v - y)
}

//! Vertices that stay where the start has them.

use unwrapd_method::numerics::hull::convex_hull;

/// Which vertices stay where the start has them, exactly, while the others move (Schüller et al. 2013).
///
/// [`EnergyKind::Lscm`](unwrapd_method::energy::EnergyKind::Lscm) falls when a map shrinks: without pins only the barrier keeps it from
/// a point. Two fix its size; other energies lose no more than their freedom to move and to turn, and the distance of the pins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pins {
    /// None.
    #[default]
    None,
    /// Two vertices of the outer boundary that are far from each other in a nearly isometric map, as far apart as there. Those
    /// opposite each other on Tutte's circle, by its diameter, are wrong for a long surface, whose least-squares conformal map
    /// then ends smaller than the surface and shaped by the barrier. Energies that know sizes would pay for any distance but
    /// that in a minimum of their own, so it is taken from one, at the price of a minimization without pins.
    Two,
}

/// Corners of a convex hull that are compared with each other; of more, as on a circle, a part will do.
const MOST_CORNERS: usize = 2_048;

/// The two vertices of a loop that are farthest apart in a map. O(n log n).
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

/// How far two vertices of a map are apart.
pub(super) fn distance(uv: &[[f64; 2]], pair: [u32; 2]) -> f64 {
    let [[x, y], [u, v]] = pair.map(|vertex| uv[vertex as usize]);
    (u - x).hypot(v - y)
}

//! Vertices that stay where the start has them.

/// Which vertices stay where the start has them, exactly, while the others move (Schüller et al. 2013).
///
/// [`EnergyKind::Lscm`](crate::energy::EnergyKind::Lscm) falls when a map shrinks: without pins only the barrier keeps it from
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

/// Two vertices of a loop that are far apart in a map: the one farthest from the first, and the one farthest from that.
pub(super) fn far_pair(boundary: &[u32], uv: &[[f64; 2]]) -> [u32; 2] {
    let farthest = |from: u32| {
        let farther = |a: u32, b: u32| {
            let is_farther = distance(uv, [from, b]) > distance(uv, [from, a]);
            if is_farther { b } else { a }
        };
        boundary.iter().copied().fold(from, farther)
    };
    let first = farthest(boundary.first().copied().unwrap_or_default());
    [first, farthest(first)]
}

/// How far two vertices of a map are apart.
pub(super) fn distance(uv: &[[f64; 2]], pair: [u32; 2]) -> f64 {
    let [[x, y], [u, v]] = pair.map(|vertex| uv[vertex as usize]);
    (u - x).hypot(v - y)
}

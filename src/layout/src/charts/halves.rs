//! A chart cut in two.

use super::Chart;
use super::parts::{parted, parts};
use unwrapd_maps::mesh::spread;

/// The parts into which a cut across the middle divides a chart: two, or more where the cut meets the boundary again.
///
/// For charts of which floating point finds no valid map: halves are rounder and have fewer vertices, and one triangle can
/// always be mapped. The nearer half, in faces from one far out, is one part, and each connected piece of the rest another;
/// any part of a disk is a disk, holes allowed. O(n log n).
pub fn halves(chart: &Chart) -> Vec<Chart> {
    let twin = chart.disk.twins();
    let far = *by_distance(&twin, 0).last().unwrap_or(&0);
    let order = by_distance(&twin, far);
    let mut is_near = vec![false; order.len()];
    for &f in &order[..order.len() / 2] {
        is_near[f as usize] = true;
    }
    let parts = parts(chart, &parted(&twin, &is_near));
    parts.into_iter().map(|(part, _)| part).collect()
}

/// All faces of a connected sheet by their distance from one of them, the nearest first.
fn by_distance(twin: &[u32], from: u32) -> Vec<u32> {
    let mut seen = vec![false; twin.len() / 3];
    seen[from as usize] = true;
    let mut order = vec![from];
    spread(twin, &mut order, |_, t| {
        !std::mem::replace(&mut seen[t as usize / 3], true)
    });
    order
}

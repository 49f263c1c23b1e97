//! A chart cut in two.

use super::Chart;
use super::chart::connected_faces;
use crate::cut::Sheet;
use crate::mesh::{CUT, Disk, Edges};

/// The parts into which a cut across the middle divides a chart: two, or more where the cut meets the boundary again.
///
/// For charts of which floating point finds no valid map: halves are rounder and have fewer vertices, and one triangle can
/// always be mapped. The nearer half, in faces from one far out, is one part, and each connected piece of the rest another;
/// any part of a disk is a disk, holes allowed. O(n log n).
pub fn halves(chart: &Chart) -> Vec<Chart> {
    let twin = twins(&chart.disk);
    let far = *by_distance(&twin, 0).last().unwrap_or(&0);
    let order = by_distance(&twin, far);
    let mut is_near = vec![false; order.len()];
    for &f in &order[..order.len() / 2] {
        is_near[f as usize] = true;
    }
    let glued: Vec<u32> = (0..)
        .zip(&twin)
        .map(|(h, &t): (usize, _)| {
            let apart = t == CUT || is_near[h / 3] != is_near[t as usize / 3];
            if apart { CUT } else { t }
        })
        .collect();
    let (label, n_parts) = connected_faces(&glued);
    let mesh = (&*chart.disk.triangles, &*chart.positions);
    Sheet::divide(mesh, &glued, &label, n_parts)
        .into_iter()
        .flat_map(|sheet| part(chart, sheet))
        .collect()
}

/// For each halfedge of a disk the one across, or [`CUT`].
fn twins(disk: &Disk) -> Vec<u32> {
    let mut twin = vec![CUT; 3 * disk.triangles.len()];
    for edge in Edges::new(disk.n_vertices, &disk.triangles).iter() {
        if let [a, b] = *edge {
            twin[a as usize] = b;
            twin[b as usize] = a;
        }
    }
    twin
}

/// All faces of a connected sheet by their distance from one of them, the nearest first.
fn by_distance(twin: &[u32], from: u32) -> Vec<u32> {
    let mut seen = vec![false; twin.len() / 3];
    seen[from as usize] = true;
    let mut order = vec![from];
    let mut done = 0;
    while let Some(&f) = order.get(done) {
        done += 1;
        for &t in &twin[3 * f as usize..3 * f as usize + 3] {
            if t != CUT && !std::mem::replace(&mut seen[t as usize / 3], true) {
                order.push(t / 3);
            }
        }
    }
    order
}

/// A sheet of a chart as a chart. Should it not be a disk, its triangles are charts of their own.
fn part(chart: &Chart, sheet: Sheet) -> Vec<Chart> {
    let triangles = sheet.vertex.as_chunks().0.to_vec();
    let corners = |&t: &u32| chart.corners[t as usize];
    match Disk::new(sheet.positions.len(), triangles) {
        Ok(disk) => vec![Chart {
            corners: sheet.triangles.iter().map(corners).collect(),
            positions: sheet.positions,
            disk,
        }],
        Err(reason) => {
            debug_assert!(false, "a part of a disk is no disk: {reason}");
            let single = |t: &u32| {
                let triangle = chart.disk.triangles[*t as usize];
                Chart::single(triangle.map(|v| chart.positions[v as usize]), corners(t))
            };
            sheet.triangles.iter().filter_map(single).collect()
        }
    }
}

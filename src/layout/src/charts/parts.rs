//! Parts of a chart.

use super::Chart;
use super::opened::connected_faces;
use super::symmetry::plane::MirrorPlane;
use unwrapd_maps::cut::Sheet;
use unwrapd_maps::mesh::{CUT, Disk};

/// The connected parts that are left of a chart when only the edges in `twin` are glued, each with the chart's triangles it is
/// made of. Any part of a disk is a disk, holes allowed. O(n log n).
pub fn parts(chart: &Chart, twin: &[u32]) -> Vec<(Chart, Vec<u32>)> {
    let (label, n_parts) = connected_faces(twin);
    let mesh = (&*chart.disk.triangles, &*chart.positions);
    Sheet::divide(mesh, twin, &label, n_parts)
        .into_iter()
        .flat_map(|sheet| part(sheet, &chart.corners, chart.mirror))
        .collect()
}

/// The gluing of some faces, numbered in their order, without the others.
pub fn twins_among(twin: &[u32], faces: &[u32]) -> Vec<u32> {
    let mut local = vec![CUT; twin.len() / 3];
    for (i, &f) in (0..).zip(faces) {
        local[f as usize] = i;
    }
    let halfedges = faces.iter().flat_map(|&f| 3 * f..3 * f + 3);
    halfedges
        .map(|h| match twin[h as usize] {
            CUT => CUT,
            t if local[t as usize / 3] == CUT => CUT,
            t => 3 * local[t as usize / 3] + t % 3,
        })
        .collect()
}

/// The gluing without the edges at which the part changes.
pub fn parted<T: PartialEq>(twin: &[u32], part: &[T]) -> Vec<u32> {
    (0..)
        .zip(twin)
        .map(|(h, &t): (usize, _)| {
            let apart = t == CUT || part[h / 3] != part[t as usize / 3];
            if apart { CUT } else { t }
        })
        .collect()
}

/// A sheet of a chart as a chart, given the corners of all triangles of the chart. Should it not be a disk, its triangles are charts of
/// their own.
pub fn part(
    sheet: Sheet,
    corners: &[[u32; 3]],
    mirror: Option<MirrorPlane>,
) -> Vec<(Chart, Vec<u32>)> {
    let triangles: Vec<[u32; 3]> = sheet.vertex.as_chunks().0.to_vec();
    let own = |&t: &u32| corners[t as usize];
    match Disk::new(sheet.positions.len(), triangles.clone()) {
        Ok(disk) => {
            let part = Chart {
                corners: sheet.triangles.iter().map(own).collect(),
                positions: sheet.positions,
                mirror,
                disk,
            };
            vec![(part, sheet.triangles)]
        }
        Err(reason) => {
            debug_assert!(false, "a part of a disk is no disk: {reason}");
            let single = |(t, triangle): (&u32, [u32; 3])| {
                let positions = triangle.map(|v| sheet.positions[v as usize]);
                Some((Chart::single(positions, own(t))?, vec![*t]))
            };
            (sheet.triangles.iter().zip(triangles))
                .filter_map(single)
                .collect()
        }
    }
}

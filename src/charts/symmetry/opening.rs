//! Closed sheets opened in their mirror plane.

use super::plane::MirrorPlane;
use super::sheet_mirror::SheetMirror;
use super::way::Way;
use crate::cut::{Branches, Neighbors, Sheet, distances, open_to_disk};
use crate::mesh::CUT;

/// The seams of a connected sheet, one halfedge of each: as [`open_to_disk`] finds them, or, where a closed sheet of genus 0 is its
/// own mirror image, along the plane.
pub fn opened_alike(sheet: &Sheet, branches: Branches, mirror: Option<&MirrorPlane>) -> Vec<u32> {
    (mirror.filter(|_| is_sphere(sheet)))
        .and_then(|plane| SheetMirror::of(sheet, plane))
        .and_then(|mirror| slit_in_plane(sheet, &mirror))
        .unwrap_or_else(|| open_to_disk(sheet, branches))
}

fn is_sphere(sheet: &Sheet) -> bool {
    let n_edges = sheet.twin.len() / 2;
    !sheet.twin.contains(&CUT) && sheet.positions.len() + sheet.triangles.len() == n_edges + 2
}

/// The edges of a slit along a plane that opens a closed sheet of genus 0 to a disk; none if the plane meets no two edges of it.
///
/// As [`open_to_disk`] does it, the slit leads from one of two vertices that are about farthest apart
/// to the other, but both lie in the plane, and so does the slit where the edges allow it.
fn slit_in_plane(sheet: &Sheet, mirror: &SheetMirror) -> Option<Vec<u32>> {
    let neighbors = Neighbors::new(sheet);
    let is_in_plane = |v: u32| mirror.has(sheet, v);
    let cost = mirror.within(sheet, |h| sheet.length(h));
    let farthest_from = |from: u32| {
        let lengths = distances(sheet, &neighbors, [from], &cost).distance;
        let in_plane = (0u32..)
            .zip(lengths)
            .filter(|&(v, d)| is_in_plane(v) && d.is_finite());
        in_plane.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))
    };
    let any = (0..sheet.positions.len() as u32).find(|&v| is_in_plane(v))?;
    let (a, _) = farthest_from(any)?;
    let (b, _) = farthest_from(a)?;
    let way = Way::cheapest(sheet, &neighbors, [a], &cost, |v| v == b)?;
    (way.edges.len() > 1).then_some(way.edges)
}

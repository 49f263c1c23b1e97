//! Closed sheets opened in their mirror plane.

use super::plane::MirrorPlane;
use super::sheet_mirror::SheetMirror;
use super::way::Way;
use unwrapd_maps::cut::{Branches, Neighbors, Sheet, far_pairs, ways_to_open};
use unwrapd_maps::mesh::CUT;

/// The seams of a connected sheet, one halfedge of each, in several ways, at most so many: as [`ways_to_open`] finds them, or, where a
/// closed sheet of genus 0 is its own mirror image, along the plane.
pub fn ways_to_open_alike(
    sheet: &Sheet,
    branches: Branches,
    mirror: Option<&MirrorPlane>,
    most: usize,
) -> Vec<Vec<u32>> {
    let mirror = mirror.filter(|_| is_sphere(sheet));
    let mirror = mirror.and_then(|plane| SheetMirror::of(sheet, plane));
    let in_plane = mirror.map_or(Vec::new(), |mirror| slits_in_plane(sheet, &mirror, most));
    if in_plane.is_empty() {
        ways_to_open(sheet, branches, most)
    } else {
        in_plane
    }
}

fn is_sphere(sheet: &Sheet) -> bool {
    let n_edges = sheet.twin.len() / 2;
    !sheet.twin.contains(&CUT) && sheet.positions.len() + sheet.triangles.len() == n_edges + 2
}

/// The edges of slits along a plane, each of which opens a closed sheet of genus 0 to a disk; none if the plane meets no two edges of
/// it.
///
/// A slit joins two vertices far apart, as those of [`ways_to_open`] do. Both vertices lie in the plane, and so does the slit where
/// the edges allow it.
fn slits_in_plane(sheet: &Sheet, mirror: &SheetMirror, most: usize) -> Vec<Vec<u32>> {
    let neighbors = Neighbors::new(sheet);
    let cost = mirror.within(sheet, |h| sheet.length(h));
    let ends = far_pairs(sheet, &neighbors, &cost, &|v| mirror.has(sheet, v), most).into_iter();
    ends.filter_map(|[a, b]| Way::cheapest(sheet, &neighbors, [a], &cost, |v| v == b))
        .map(|way| way.edges)
        .filter(|edges| edges.len() > 1)
        .collect()
}

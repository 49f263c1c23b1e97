//! What to undo so that a sheet becomes a disk.

use super::Sheet;
use super::cut_graph::cut_graph;
use super::distances::Neighbors;
use super::slit::{Branches, slit};
use crate::mesh::{CUT, UnionFind};

/// The seams of a connected sheet, one halfedge of each: without these edges it is a disk, possibly with holes.
pub fn open_to_disk(sheet: &Sheet, branches: Branches) -> Vec<u32> {
    let n_edges = sheet.edges().count();
    let n_loops = boundary_loops(sheet);
    // V − E + F = 2 − 2 g − (crosscaps) − (boundary loops)
    let euler = sheet.positions.len() as i64 - n_edges as i64 + sheet.triangles.len() as i64;
    let planar = euler + n_loops as i64 == 2;
    match (planar, n_loops) {
        (true, 0) => slit(sheet, &Neighbors::new(sheet), branches),
        (true, _) => Vec::new(),
        (false, _) => cut_graph(sheet, &Neighbors::new(sheet)),
    }
}

fn boundary_loops(sheet: &Sheet) -> usize {
    let mut sets = UnionFind::new(sheet.positions.len());
    let mut n_loops = 0;
    let on_boundary = sheet.on_boundary();
    n_loops += on_boundary.iter().filter(|&&on| on).count();
    for h in (0..sheet.twin.len() as u32).filter(|&h| sheet.twin[h as usize] == CUT) {
        let [a, b] = sheet.ends(h);
        n_loops -= usize::from(sets.unite(a, b));
    }
    n_loops
}

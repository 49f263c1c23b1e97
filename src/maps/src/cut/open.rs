//! Seams that open a sheet to a disk.

use super::Sheet;
use super::cut_graph::cut_graph;
use super::distances::Neighbors;
use super::slit::{Branches, slits};
use crate::mesh::{CUT, UnionFind};

/// Returns the seams of a connected sheet, one halfedge of each: without these edges it is a disk, possibly with holes.
pub fn open_to_disk(sheet: &Sheet, branches: Branches) -> Vec<u32> {
    let mut ways = ways_to_open(sheet, branches, 1);
    ways.pop().unwrap_or_default()
}

/// Like [`open_to_disk`], in at most `most` ways: a closed sheet of genus 0 is slit between different vertices.
pub fn ways_to_open(sheet: &Sheet, branches: Branches, most: usize) -> Vec<Vec<u32>> {
    let n_edges = sheet.edges().count();
    let n_loops = boundary_loops(sheet);
    // V − E + F = 2 − 2 g − (crosscaps) − (boundary loops)
    let euler = sheet.positions.len() as i64 - n_edges as i64 + sheet.triangles.len() as i64;
    let planar = euler + n_loops as i64 == 2;
    match (planar, n_loops) {
        (true, 0) => slits(sheet, &Neighbors::new(sheet), branches, most),
        (true, _) => vec![Vec::new()],
        (false, _) => vec![cut_graph(sheet, &Neighbors::new(sheet))],
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

//! Surfaces parted and opened to disks.

use super::chart::{Chart, Cut, open};
use super::regions::within_cones::regions;
use rayon::prelude::*;
use unwrapd_maps::cut::{Branches, Sheet, isolate_doubled_edges, join_disks, ways_to_open};
use unwrapd_maps::mesh::{CUT, Surface, UnionFind};

/// Returns the charts of a surface, ordered by their first triangles. Deterministic, for any number of threads.
pub fn charts(surface: &Surface, cut: Cut) -> Vec<Chart> {
    let adjacency = surface.adjacency();
    let (region, n_regions) = match cut {
        Cut::Fast => regions(surface),
        Cut::Auto | Cut::Disk | Cut::Keep | Cut::Seams => {
            (adjacency.piece.clone(), adjacency.n_pieces)
        }
    };
    let branches = match cut {
        Cut::Auto | Cut::Keep | Cut::Seams => Branches::None,
        Cut::Fast | Cut::Disk => Branches::ToLimbs,
    };
    let mut twin = opened(surface, &region, n_regions, branches);
    if cut == Cut::Disk && !surface.is_cut() {
        join_disks(surface, &mut twin);
    }
    charts_glued(surface, &twin)
}

/// Returns the gluing that is left when regions are parted and opened to disks.
fn opened(surface: &Surface, region: &[u32], n_regions: usize, branches: Branches) -> Vec<u32> {
    let adjacency = surface.adjacency();
    let mesh = (&*surface.triangles, &*surface.positions);
    let sheets = Sheet::divide(mesh, &adjacency.twin, region, n_regions);
    let mut twin = glued_within(&adjacency.twin, region);
    let slits: Vec<Vec<u32>> = sheets
        .par_iter()
        .map(|sheet| ways_to_open(sheet, branches, 1).swap_remove(0))
        .collect();
    for (sheet, slits) in sheets.iter().zip(slits) {
        for h in slits {
            for side in [h, sheet.twin[h as usize]] {
                let triangle = sheet.triangles[side as usize / 3];
                twin[(3 * triangle + side % 3) as usize] = CUT;
            }
        }
    }
    isolate_doubled_edges(surface, &mut twin);
    twin
}

/// Returns the charts that a gluing leaves.
fn charts_glued(surface: &Surface, twin: &[u32]) -> Vec<Chart> {
    let mesh = (&*surface.triangles, &*surface.positions);
    let (label, n_charts) = connected_faces(twin);
    Sheet::divide(mesh, twin, &label, n_charts)
        .into_par_iter()
        .flat_map_iter(|sheet| open(surface, sheet))
        .collect()
}

/// The gluing without what connects different regions.
fn glued_within(twin: &[u32], region: &[u32]) -> Vec<u32> {
    (0..)
        .zip(twin)
        .map(|(h, &t): (usize, _)| match t {
            CUT => CUT,
            t if region[h / 3] != region[t as usize / 3] => CUT,
            t => t,
        })
        .collect()
}

/// The faces that hang together, labeled.
pub(super) fn connected_faces(twin: &[u32]) -> (Vec<u32>, usize) {
    let mut faces = UnionFind::new(twin.len() / 3);
    for (h, &t) in (0u32..).zip(twin).filter(|(_, t)| **t != CUT) {
        faces.unite(h / 3, t / 3);
    }
    faces.labels()
}

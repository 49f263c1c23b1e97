//! Surfaces parted and opened to disks.

use super::chart::{Chart, Cut, open};
use super::regions::within_cones::regions;
use super::symmetry::opening::ways_to_open_alike;
use super::symmetry::plane::MirrorPlane;
use rayon::prelude::*;
use unwrapd_maps::cut::{Branches, Sheet, isolate_doubled_edges, join_disks};
use unwrapd_maps::mesh::{CUT, Surface, UnionFind};

/// The charts of a surface, ordered by their first triangles. Deterministic, for any number of threads.
pub fn charts(surface: &Surface, cut: Cut) -> Vec<Chart> {
    charts_alike(surface, cut, None)
}

/// The same, opened alike on both sides of a plane.
pub(super) fn charts_alike(surface: &Surface, cut: Cut, mirror: Option<MirrorPlane>) -> Vec<Chart> {
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
    let mut twin = opened(surface, &region, n_regions, branches, mirror);
    if cut == Cut::Disk && !surface.is_cut() {
        join_disks(surface, &mut twin);
    }
    charts_glued(surface, &twin, mirror)
}

/// The charts of a surface whose components are opened to disks, in several ways, at most so many: in each way closed components of
/// genus 0 are slit between other vertices.
pub(super) fn charts_in_ways(
    surface: &Surface,
    mirror: Option<MirrorPlane>,
    most: usize,
) -> Vec<Vec<Chart>> {
    let adjacency = surface.adjacency();
    let (region, n_regions) = (&*adjacency.piece, adjacency.n_pieces);
    let ways = opened_in_ways(surface, region, n_regions, Branches::None, mirror, most);
    (ways.into_iter())
        .map(|twin| charts_glued(surface, &twin, mirror))
        .collect()
}

/// The gluing that is left when regions are parted and opened to disks.
fn opened(
    surface: &Surface,
    region: &[u32],
    n_regions: usize,
    branches: Branches,
    mirror: Option<MirrorPlane>,
) -> Vec<u32> {
    opened_in_ways(surface, region, n_regions, branches, mirror, 1).swap_remove(0)
}

/// The same in several ways, at least one and at most so many.
fn opened_in_ways(
    surface: &Surface,
    region: &[u32],
    n_regions: usize,
    branches: Branches,
    mirror: Option<MirrorPlane>,
    most: usize,
) -> Vec<Vec<u32>> {
    let adjacency = surface.adjacency();
    let mesh = (&*surface.triangles, &*surface.positions);
    let sheets = Sheet::divide(mesh, &adjacency.twin, region, n_regions);
    let whole = glued_within(&adjacency.twin, region);
    let ways: Vec<Vec<Vec<u32>>> = sheets
        .par_iter()
        .map(|sheet| ways_to_open_alike(sheet, branches, mirror.as_ref(), most))
        .collect();
    let n_ways = ways.iter().map(Vec::len).max().unwrap_or(0).max(1);
    let opened = |way: usize| {
        let mut twin = whole.clone();
        for (sheet, ways) in sheets.iter().zip(&ways) {
            // A sheet with fewer ways is opened in its first.
            for &h in ways.get(way).or(ways.first()).into_iter().flatten() {
                for side in [h, sheet.twin[h as usize]] {
                    let triangle = sheet.triangles[side as usize / 3];
                    twin[(3 * triangle + side % 3) as usize] = CUT;
                }
            }
        }
        isolate_doubled_edges(surface, &mut twin);
        twin
    };
    (0..n_ways).map(opened).collect()
}

/// The charts that a gluing leaves.
fn charts_glued(surface: &Surface, twin: &[u32], mirror: Option<MirrorPlane>) -> Vec<Chart> {
    let mesh = (&*surface.triangles, &*surface.positions);
    let (label, n_charts) = connected_faces(twin);
    Sheet::divide(mesh, twin, &label, n_charts)
        .into_par_iter()
        .flat_map_iter(|sheet| open(surface, sheet))
        .map(|chart| Chart { mirror, ..chart })
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

//! Disks joined at single edges.

use super::Sheet;
use super::distances::{Distances, Neighbors, distances};
use crate::mesh::{CUT, Edges, Surface, UnionFind, next, origin, same_direction};
use crate::numerics::vec3::distance;

/// Joins the disks of each component of a surface to one, where an edge can be found that both have and neither has used.
///
/// Two disks glued along one edge, and only one, are again a disk, holes or not. They are glued only where they are wound alike. So the
/// parts into which non-manifold edges cut a component hang together again at one edge each, the longest that lies on both
/// boundaries. Where two disks share only edges that lie inside, slits are cut from their boundaries to the nearest such edge.
/// What cannot be joined are faces that share no edge but one that two others are glued along already.
pub fn join_disks(surface: &Surface, twin: &mut [u32]) {
    let mut disks = UnionFind::new(surface.triangles.len());
    for (h, &t) in (0u32..).zip(&*twin).filter(|(_, t)| **t != CUT) {
        disks.unite(h / 3, t / 3);
    }
    let n_components = surface.defects.components;
    if disks.labels().1 == n_components {
        return;
    }
    let edges = Edges::new(surface.positions.len(), &surface.triangles);
    join_at_boundaries(surface, &edges, twin, &mut disks);
    while disks.labels().1 > n_components && join_inside(surface, &edges, twin, &mut disks) {}
}

fn glue(twin: &mut [u32], a: u32, b: u32) {
    twin[a as usize] = b;
    twin[b as usize] = a;
}

fn join_at_boundaries(surface: &Surface, edges: &Edges, twin: &mut [u32], disks: &mut UnionFind) {
    let mut pairs = Vec::new();
    for edge in edges.iter() {
        let open: Vec<u32> = edge
            .iter()
            .copied()
            .filter(|&h| twin[h as usize] == CUT)
            .collect();
        for pair in open.windows(2) {
            let is_alike = !same_direction(&surface.triangles, pair[0], pair[1]);
            if is_alike && disks.find(pair[0] / 3) != disks.find(pair[1] / 3) {
                let [a, b] = [pair[0], next(pair[0])]
                    .map(|h| surface.positions[origin(&surface.triangles, h) as usize]);
                pairs.push((distance(a, b), pair[0], pair[1]));
            }
        }
    }
    pairs.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    for (_, a, b) in pairs {
        let free = twin[a as usize] == CUT && twin[b as usize] == CUT;
        if free && disks.unite(a / 3, b / 3) {
            glue(twin, a, b);
        }
    }
}

/// One round of joins at edges that lie inside a disk: the nearest to the boundaries first, each disk at most once, since a
/// slit changes the distances in it. False if there was none.
fn join_inside(surface: &Surface, edges: &Edges, twin: &mut [u32], disks: &mut UnionFind) -> bool {
    let n_faces = surface.triangles.len();
    let Some(whole) = Sheet::divide(
        (&surface.triangles, &surface.positions),
        twin,
        &vec![0; n_faces],
        1,
    )
    .pop() else {
        return false;
    };
    let on_boundary = whole.on_boundary();
    let boundary = (0u32..).zip(&on_boundary).filter(|(_, on)| **on);
    let from_boundary = distances(
        &whole,
        &Neighbors::new(&whole),
        boundary.map(|(v, _)| v),
        |h| whole.length(h),
    );
    let mut pairs = Vec::new();
    for edge in edges.iter().filter(|edge| edge.len() > 2) {
        let mut reach: Vec<(u32, f64, u32)> = edge
            .iter()
            .map(|&h| (disks.find(h / 3), slit_length(&whole, &from_boundary, h), h))
            .filter(|r| r.1.is_finite())
            .collect();
        reach.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        reach.dedup_by_key(|r| r.0);
        let is_alike =
            |pair: &&[(u32, f64, u32)]| !same_direction(&surface.triangles, pair[0].2, pair[1].2);
        for pair in reach.windows(2).filter(is_alike) {
            pairs.push((pair[0].1 + pair[1].1, pair[0].2, pair[1].2));
        }
    }
    pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut touched = vec![false; n_faces];
    let mut any = false;
    for (_, a, b) in pairs {
        let (disk_a, disk_b) = (disks.find(a / 3) as usize, disks.find(b / 3) as usize);
        if disk_a == disk_b || touched[disk_a] || touched[disk_b] {
            continue;
        }
        slit_to(&whole, &from_boundary, twin, a);
        slit_to(&whole, &from_boundary, twin, b);
        glue(twin, a, b);
        disks.unite(a / 3, b / 3);
        touched[disk_a] = true;
        touched[disk_b] = true;
        any = true;
    }
    any
}

/// How far the boundary is from an edge; infinite if the edge connects two of its vertices, so that cutting it would part
/// the disk.
fn slit_length(sheet: &Sheet, from_boundary: &Distances, h: u32) -> f64 {
    let [a, b] = sheet.ends(h).map(|v| from_boundary.distance[v as usize]);
    match (sheet.twin[h as usize], a.max(b) > 0.0) {
        (CUT, _) => 0.0,
        (_, true) => a.min(b),
        (_, false) => f64::INFINITY,
    }
}

/// Cuts the shortest way from the boundary to an edge, and the edge.
fn slit_to(sheet: &Sheet, from_boundary: &Distances, twin: &mut [u32], h: u32) {
    if twin[h as usize] == CUT {
        return;
    }
    let [a, b] = sheet.ends(h);
    let nearer = from_boundary.distance[a as usize] <= from_boundary.distance[b as usize];
    let start = if nearer { a } else { b };
    for step in from_boundary.path(sheet, start).chain([h]) {
        let t = std::mem::replace(&mut twin[step as usize], CUT);
        twin[t as usize] = CUT;
    }
}

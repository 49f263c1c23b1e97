//! Disks joined at single edges.

use super::Sheet;
use super::distances::{Distances, Neighbors, distances};
use crate::mesh::{CUT, Edges, Surface, UnionFind, next, origin, same_direction};
use unwrapd_method::numerics::vec3::distance;

/// Most pairs of faces at one edge that are compared: 64 faces in each direction.
const MOST_PAIRS: usize = 4096;

/// Joins the disks of each component of a surface to one, at edges that both disks have and neither has used.
///
/// Two disks glued along one edge, and only one, are again a disk, with or without holes. They are glued only if they
/// are wound alike. So the parts into which non-manifold edges cut a component become connected again at one edge each,
/// the longest that lies on both boundaries. If two disks share only interior edges, slits are cut from their
/// boundaries to the nearest such edge. Faces cannot be joined if the only edges that they share are those along which
/// two others are glued already.
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

/// Splits the halfedges of an edge by direction: two that run in opposite directions are wound alike.
fn by_direction(surface: &Surface, edge: &[u32]) -> [Vec<u32>; 2] {
    let (forth, back) = edge
        .iter()
        .copied()
        .partition(|h: &u32| !edge.is_empty() && same_direction(&surface.triangles, edge[0], *h));
    [forth, back]
}

/// Returns pairs of one item from each list; if there are too many pairs, each item is in one or two of them.
fn pairs_of<'a, T>(forth: &'a [T], back: &'a [T]) -> Vec<(&'a T, &'a T)> {
    if forth.len() * back.len() <= MOST_PAIRS {
        return forth
            .iter()
            .flat_map(|a| back.iter().map(move |b| (a, b)))
            .collect();
    }
    let shifted = forth.iter().zip(back.iter().skip(1));
    forth.iter().zip(back).chain(shifted).collect()
}

fn join_at_boundaries(surface: &Surface, edges: &Edges, twin: &mut [u32], disks: &mut UnionFind) {
    let mut pairs = Vec::new();
    for edge in edges.iter() {
        let open: Vec<u32> = edge
            .iter()
            .copied()
            .filter(|&h| twin[h as usize] == CUT)
            .collect();
        let [forth, back] = by_direction(surface, &open);
        for (&a, &b) in pairs_of(&forth, &back) {
            if disks.find(a / 3) != disks.find(b / 3) {
                let [p, q] =
                    [a, next(a)].map(|h| surface.positions[origin(&surface.triangles, h) as usize]);
                pairs.push((distance(p, q), a.min(b), a.max(b)));
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

/// Makes one round of joins at interior edges of disks: the nearest to the boundaries first, each disk at most once,
/// since a slit changes the distances in it. Returns `false` if there was none.
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
    // Distances from the boundaries.
    let on_boundary = whole.on_boundary();
    let boundary = (0u32..).zip(&on_boundary).filter(|(_, on)| **on);
    let from_boundary = distances(
        &whole,
        &Neighbors::new(&whole),
        boundary.map(|(v, _)| v),
        |h| whole.length(h),
    );
    // Pairs of faces of different disks at an edge, by the total length of slits to it.
    let mut pairs = Vec::new();
    for edge in edges.iter().filter(|edge| edge.len() > 2) {
        let mut nearest_of_each_disk = |halfedges: Vec<u32>| {
            let mut reach: Vec<(u32, f64, u32)> = (halfedges.into_iter())
                .map(|h| (disks.find(h / 3), slit_length(&whole, &from_boundary, h), h))
                .filter(|r| r.1.is_finite())
                .collect();
            reach.sort_unstable_by(|a, b| {
                a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2))
            });
            reach.dedup_by_key(|r| r.0);
            reach
        };
        let [forth, back] = by_direction(surface, edge).map(&mut nearest_of_each_disk);
        for (a, b) in pairs_of(&forth, &back) {
            if a.0 != b.0 {
                pairs.push((a.1 + b.1, a.2.min(b.2), a.2.max(b.2)));
            }
        }
    }
    pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    // Slit and join, the nearest pairs first.
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

/// Returns the distance of an edge from the boundary; infinite if the edge connects two boundary vertices, so that
/// cutting it would divide the disk.
fn slit_length(sheet: &Sheet, from_boundary: &Distances, h: u32) -> f64 {
    let [a, b] = sheet.ends(h).map(|v| from_boundary.distance[v as usize]);
    match (sheet.twin[h as usize], a.max(b) > 0.0) {
        (CUT, _) => 0.0,
        (_, true) => a.min(b),
        (_, false) => f64::INFINITY,
    }
}

/// Cuts the shortest path from the boundary to an edge, and the edge.
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

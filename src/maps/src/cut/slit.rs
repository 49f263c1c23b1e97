//! Slits in closed sheets of genus 0.

use super::Sheet;
use super::distances::{Neighbors, distances, opposite_end};
use unwrapd_method::numerics::vec3::{area_vector, norm};

/// Share of √area beyond which a vertex far from the slit gets a branch. On a round sphere the slit from pole to pole
/// leaves 0.44 √area; beyond about that, a limb would be squeezed through its own root.
const FAR: f64 = 0.5;

/// Most branches: each costs one pass over the sheet.
const MOST_BRANCHES: usize = 12;

/// Branches of a slit to vertices far from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branches {
    /// No branches: the caller slits further.
    None,
    /// Enough branches that no limb has to be squeezed through its root.
    ToLimbs,
}

/// Returns the edges of at most `most` slits. Each slit opens a closed sheet of genus 0 to a disk.
///
/// A slit is a shortest path between two vertices far apart, with shortest branches, if asked for, to vertices far from
/// it. It is a tree of at least two edges.
pub fn slits(
    sheet: &Sheet,
    neighbors: &Neighbors,
    branches: Branches,
    most: usize,
) -> Vec<Vec<u32>> {
    let ends = far_pairs(sheet, neighbors, &|h| sheet.length(h), &|_| true, most).into_iter();
    ends.map(|ends| slit(sheet, neighbors, branches, ends))
        .collect()
}

fn slit(sheet: &Sheet, neighbors: &Neighbors, branches: Branches, [a, b]: [u32; 2]) -> Vec<u32> {
    // Cut the shortest path between the two ends; a slit has at least two edges.
    let from_a = distances(sheet, neighbors, [a], |h| sheet.length(h));
    let mut edges: Vec<u32> = from_a.path(sheet, b).collect();
    let mut on_slit = vec![false; sheet.positions.len()];
    on_slit[a as usize] = true;
    mark_ends(sheet, &edges, &mut on_slit);
    if edges.len() < 2 {
        edges.extend(continuation(sheet, neighbors, b, &on_slit));
        mark_ends(sheet, &edges, &mut on_slit);
    }
    // Add branches to the farthest vertices, as long as one is too far from the slit.
    let reach = FAR * area(sheet).sqrt();
    let most = match branches {
        Branches::ToLimbs => MOST_BRANCHES,
        Branches::None => 0,
    };
    for _ in 0..most {
        let sources = (0u32..).zip(&on_slit).filter(|(_, on)| **on);
        let from_slit = distances(sheet, neighbors, sources.map(|(v, _)| v), |h| {
            sheet.length(h)
        });
        let (tip, far) = from_slit.farthest();
        if far <= reach {
            break;
        }
        edges.extend(from_slit.path(sheet, tip));
        mark_ends(sheet, &edges, &mut on_slit);
    }
    edges
}

fn mark_ends(sheet: &Sheet, edges: &[u32], on_slit: &mut [bool]) {
    for &h in edges {
        for v in sheet.ends(h) {
            on_slit[v as usize] = true;
        }
    }
}

/// Returns an edge by which a slit of one edge continues from its end: every closed sheet has a third vertex next to
/// it.
fn continuation(sheet: &Sheet, neighbors: &Neighbors, end: u32, on_slit: &[bool]) -> Option<u32> {
    let leaves = |h: &&u32| !on_slit[opposite_end(sheet, **h, end) as usize];
    neighbors.of(end).iter().find(leaves).copied()
}

fn area(sheet: &Sheet) -> f64 {
    let position = |corner: u32| sheet.positions[sheet.vertex[corner as usize] as usize];
    (0..sheet.triangles.len() as u32)
        .map(|f| {
            norm(area_vector(
                position(3 * f),
                position(3 * f + 1),
                position(3 * f + 2),
            )) / 2.0
        })
        .sum()
}

// Pairs of vertices that are far apart.

/// Most vertices whose farthest vertices are searched: each costs one pass over the sheet.
const MOST_ENDS: usize = 5;

/// Returns at most `most` different pairs of vertices, the second the farthest from the first; `is_end` holds for both.
///
/// The first vertices lie as far from each other as possible, and the first pair is approximately the farthest of all.
/// The result does not depend on the numbers of the vertices, except for ties. From: Gonzalez 1985, Clustering to
/// Minimize the Maximum Intercluster Distance.
pub fn far_pairs(
    sheet: &Sheet,
    neighbors: &Neighbors,
    length: &impl Fn(u32) -> f64,
    is_end: &impl Fn(u32) -> bool,
    most: usize,
) -> Vec<[u32; 2]> {
    let from = |v: u32| distances(sheet, neighbors, [v], length).distance;
    let farthest = |distances: &[f64]| {
        let ends = (0u32..).zip(distances);
        let ends = ends.filter(|&(v, d)| d.is_finite() && is_end(v));
        let farthest = ends.max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(&a.0)));
        farthest.map(|(v, _)| v)
    };
    let mut nearest = vec![f64::INFINITY; sheet.positions.len()];
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    // Begin at the vertex that is farthest from an outermost one.
    let mut next = (sheet.outermost(is_end)).and_then(|start| farthest(&from(start)));
    for _ in 0..MOST_ENDS {
        let Some(a) = next.filter(|_| pairs.len() < most) else {
            break;
        };
        // Pair the vertex with the one farthest from it.
        let from_a = from(a);
        if let Some(b) = farthest(&from_a)
            && !pairs.contains(&[a, b])
            && !pairs.contains(&[b, a])
        {
            pairs.push([a, b]);
        }
        // Continue with the vertex farthest from all first ones so far.
        for (nearest, from_a) in nearest.iter_mut().zip(from_a) {
            *nearest = nearest.min(from_a);
        }
        next = farthest(&nearest);
    }
    pairs
}

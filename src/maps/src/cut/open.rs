//! Seams that open a sheet to a disk.

use super::Sheet;
use super::distances::{Distances, Neighbors, distances, opposite_end};
use crate::mesh::{CUT, UnionFind};
use unwrapd_method::numerics::vec3::{area_vector, norm};

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

// Cut graphs of sheets with handles or twists.

/// Most roots tried for the first loop of a closed sheet; large sheets get fewer.
const MOST_ROOTS: usize = 12;

/// Budget for trying roots: halfedges times roots. Up to 166,000 halfedges all roots are tried, from a million on two.
const ROOT_BUDGET: usize = 2_000_000;

/// Returns the edges of a cut graph: cutting them makes a sheet a disk that has the holes of the sheet (merged where
/// the graph passes through one).
///
/// Each hole is closed by a virtual face; its edges are cut already, so paths along them cost nothing. Each round grows
/// a shortest-path tree T from the edges cut so far, then a spanning tree of the faces that crosses no edge of T and
/// prefers the edges whose paths back to the root are longest. The edges in neither tree number 2 g (or the crosscaps);
/// each closes, with its two paths back, a loop that does not separate, and these are the shortest such loops. Half of
/// them are cut and the others are found again from there, since a longer cut is a nearer root. O(n log n) per round.
pub fn cut_graph(sheet: &Sheet, neighbors: &Neighbors) -> Vec<u32> {
    let holes = Holes::new(sheet);
    let mut cut = vec![false; sheet.twin.len()];
    // Root the graph in a hole; in a closed sheet, in a vertex with a short loop.
    let mut on_cut = vec![false; sheet.positions.len()];
    let root = holes
        .root
        .unwrap_or_else(|| best_root(sheet, neighbors, &holes));
    on_cut[root as usize] = true;
    let mut first = true;
    loop {
        let (from_cut, loops) = shortest_loops(sheet, neighbors, &holes, &on_cut, &cut);
        if loops.is_empty() {
            break;
        }
        // Cut half of the loops, together with their paths back to the cut; in the first round only one loop.
        let taken = if first { 1 } else { loops.len().div_ceil(2) };
        for &h in &loops[..taken] {
            cut[h as usize] = true;
            for v in sheet.ends(h) {
                for step in from_cut.path(sheet, v) {
                    cut[step as usize] = true;
                }
            }
        }
        // The first loop becomes the root: drop the path that led to it.
        if first && holes.root.is_none() {
            prune(sheet, neighbors, &mut cut);
            on_cut[root as usize] = false;
        }
        first = false;
        for h in sheet.edges().filter(|&h| cut[h as usize]) {
            for v in sheet.ends(h) {
                on_cut[v as usize] = true;
            }
        }
    }
    // Drop dead ends and return the edges that were not open already.
    prune(sheet, neighbors, &mut cut);
    sheet
        .edges()
        .filter(|&h| cut[h as usize] && sheet.twin[h as usize] != CUT)
        .collect()
}

/// Boundary loops of a sheet, as virtual faces.
struct Holes {
    /// For each halfedge on the boundary its loop.
    loop_of: Vec<u32>,
    count: usize,
    /// A vertex of the longest loop.
    root: Option<u32>,
}

impl Holes {
    fn new(sheet: &Sheet) -> Self {
        let boundary = || (0..sheet.twin.len() as u32).filter(|&h| sheet.twin[h as usize] == CUT);
        let mut sets = UnionFind::new(sheet.positions.len());
        for h in boundary() {
            let [a, b] = sheet.ends(h);
            sets.unite(a, b);
        }
        let (labels, _) = sets.labels();
        let mut loop_of = vec![CUT; sheet.twin.len()];
        let mut number = vec![CUT; labels.len()];
        let mut lengths: Vec<(f64, u32)> = Vec::new();
        for h in boundary() {
            let vertex = sheet.vertex[h as usize];
            let n = &mut number[labels[vertex as usize] as usize];
            if *n == CUT {
                *n = lengths.len() as u32;
                lengths.push((0.0, vertex));
            }
            lengths[*n as usize].0 += sheet.length(h);
            loop_of[h as usize] = *n;
        }
        let longest = lengths.iter().max_by(|a, b| a.0.total_cmp(&b.0));
        Self {
            loop_of,
            count: lengths.len(),
            root: longest.map(|l| l.1),
        }
    }

    /// Returns the node across an edge in the graph of faces and holes.
    fn across(&self, sheet: &Sheet, h: u32) -> u32 {
        match sheet.twin[h as usize] {
            CUT => sheet.triangles.len() as u32 + self.loop_of[h as usize],
            t => t / 3,
        }
    }
}

/// Returns the edges that close the shortest loops through the edges cut so far, shortest first, and the distances from
/// these.
fn shortest_loops(
    sheet: &Sheet,
    neighbors: &Neighbors,
    holes: &Holes,
    on_cut: &[bool],
    cut: &[bool],
) -> (Distances, Vec<u32>) {
    // Find the distances from the cut, where edges that are open already cost nothing.
    let free = |h: u32| cut[h as usize] || sheet.twin[h as usize] == CUT;
    let sources = (0u32..).zip(on_cut).filter(|(_, on)| **on).map(|(v, _)| v);
    let length = |h: u32| if free(h) { 0.0 } else { sheet.length(h) };
    let from_cut = distances(sheet, neighbors, sources, length);
    // Leave out the edges of the shortest paths.
    let mut in_tree = cut.to_vec();
    for &h in from_cut.arrival.iter().filter(|&&h| h != CUT) {
        in_tree[h as usize] = true;
    }
    let mut candidates: Vec<(f64, u32)> = sheet
        .edges()
        .filter(|&h| !in_tree[h as usize])
        .map(|h| {
            let [a, b] = sheet.ends(h).map(|v| from_cut.distance[v as usize]);
            (a + b + length(h), h)
        })
        .collect();
    // Span the faces by a tree that prefers the edges with the longest paths back.
    candidates.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut faces = UnionFind::new(sheet.triangles.len() + holes.count);
    // The edges in neither tree close loops.
    let mut loops: Vec<u32> = candidates
        .into_iter()
        .filter(|&(_, h)| !faces.unite(h / 3, holes.across(sheet, h)))
        .map(|(_, h)| h)
        .collect();
    loops.reverse();
    (from_cut, loops)
}

/// Returns the vertex with the shortest loop among a few vertices spread over a closed sheet.
fn best_root(sheet: &Sheet, neighbors: &Neighbors, holes: &Holes) -> u32 {
    let n_roots = (ROOT_BUDGET / sheet.twin.len()).clamp(2, MOST_ROOTS);
    let mut on_cut = vec![false; sheet.positions.len()];
    let mut candidates: Vec<u32> = Vec::new();
    let mut best = (f64::INFINITY, 0);
    let uncut = vec![false; sheet.twin.len()];
    let mut root = sheet.outermost(|_| true).unwrap_or(0);
    // Try roots spread over the sheet, and keep the one with the shortest loop.
    for _ in 0..n_roots {
        on_cut[root as usize] = true;
        let (from_root, loops) = shortest_loops(sheet, neighbors, holes, &on_cut, &uncut);
        on_cut[root as usize] = false;
        if let Some(&h) = loops.first() {
            let [a, b] = sheet.ends(h).map(|v| from_root.distance[v as usize]);
            let length = a + b + sheet.length(h);
            if length < best.0 {
                best = (length, root);
            }
        }
        // Continue with the vertex farthest from all roots so far.
        candidates.push(root);
        let spread = distances(sheet, neighbors, candidates.iter().copied(), |h| {
            sheet.length(h)
        });
        root = spread.farthest().0;
    }
    best.1
}

/// Uncuts dead ends: edges that end neither at the boundary nor at another cut edge.
fn prune(sheet: &Sheet, neighbors: &Neighbors, cut: &mut [bool]) {
    let on_boundary = sheet.on_boundary();
    let mut degree = vec![0u32; sheet.positions.len()];
    for h in sheet.edges().filter(|&h| cut[h as usize]) {
        for v in sheet.ends(h) {
            degree[v as usize] += 1;
        }
    }
    for start in 0..degree.len() as u32 {
        let mut v = start;
        while degree[v as usize] == 1 && !on_boundary[v as usize] {
            let Some(&h) = neighbors.of(v).iter().find(|&&h| cut[h as usize]) else {
                break;
            };
            cut[h as usize] = false;
            for end in sheet.ends(h) {
                degree[end as usize] -= 1;
            }
            v = opposite_end(sheet, h, v);
        }
    }
}

// Slits in closed sheets of genus 0.

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
    neighbors
        .of(end)
        .iter()
        .find(|h: &&u32| !on_slit[opposite_end(sheet, **h, end) as usize])
        .copied()
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

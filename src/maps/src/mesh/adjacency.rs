//! Gluing of faces along edges.

use super::edges::{Edges, spread};
use super::{CUT, UnionFind, next, origin, same_direction};
use unwrapd_method::numerics::vec3::{add_scaled, dot, sub, unit};

/// Most faces on one edge that are paired by angle, which compares all 2,016 pairs; more are paired in file order.
const MOST_FACES_COMPARED: usize = 64;

/// Halfedges of a triangle list, glued in pairs.
///
/// Halfedge `3 f + c` runs from corner `c` of face `f` to the next one. An edge with two faces is glued, however they
/// are wound. Where more meet, they are paired greedily: those wound consistently first, then the flattest pair, then
/// copies of equal rank (so that a wall modeled twice falls into two sheets); the faces left over are cut open there.
#[derive(Clone, Debug)]
pub struct Adjacency {
    /// For each halfedge the one glued to it, or [`CUT`].
    pub twin: Vec<u32>,
    /// For each face whether it must be turned over for its piece to be consistently wound. The majority of a piece's
    /// faces keeps its winding.
    pub turned: Vec<bool>,
    /// For each face its piece: faces connected through glued edges, numbered by their first face.
    pub piece: Vec<u32>,
    /// Number of pieces.
    pub n_pieces: usize,
    /// For each face its component: connected through shared edges, glued or not, numbered by their first face.
    pub component: Vec<u32>,
    /// Number of components.
    pub n_components: usize,
    /// Number of edges with three or more faces.
    pub n_nonmanifold_edges: usize,
}

impl Adjacency {
    /// Glues triangles that have three different vertices each.
    pub(super) fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]], edges: &Edges) -> Self {
        let n_faces = triangles.len();
        let mut twin = vec![CUT; 3 * n_faces];
        let mut components = UnionFind::new(n_faces);
        let mut n_nonmanifold_edges = 0;
        let ranks = copy_ranks(triangles, edges);
        // Glue edges with two faces; pair the faces of edges with more.
        for edge in edges.iter() {
            for h in &edge[1..] {
                components.unite(edge[0] / 3, h / 3);
            }
            if edge.len() == 2 {
                glue(&mut twin, edge[0], edge[1]);
            } else if edge.len() > 2 {
                n_nonmanifold_edges += 1;
                pair_fan(positions, triangles, &ranks, edge, &mut twin);
            }
        }
        // Label pieces and components, and wind each piece consistently.
        let (piece, n_pieces) = pieces(&twin);
        let (component, n_components) = components.labels();
        let turned = consistent_winding(triangles, &twin);
        Self {
            twin,
            turned,
            piece,
            n_pieces,
            component,
            n_components,
            n_nonmanifold_edges,
        }
    }

    /// Cuts glued halfedges for which `is_seam` holds.
    pub(super) fn cut(&mut self, triangles: &[[u32; 3]], is_seam: impl Fn(u32, u32) -> bool) {
        for h in 0..self.twin.len() as u32 {
            let t = self.twin[h as usize];
            if t != CUT && h < t && is_seam(h, t) {
                self.twin[h as usize] = CUT;
                self.twin[t as usize] = CUT;
            }
        }
        (self.piece, self.n_pieces) = pieces(&self.twin);
        self.turned = consistent_winding(triangles, &self.twin);
    }

    /// Returns the adjacency for faces and corners in another order: face `k` begins with halfedge `order[k]`.
    pub(super) fn reordered(&self, order: &[u32]) -> Self {
        let halfedges = || order.iter().flat_map(|&h| [h, next(h), next(next(h))]);
        let mut place = vec![0; self.twin.len()];
        for (new, old) in (0u32..).zip(halfedges()) {
            place[old as usize] = new;
        }
        let anew = |t: u32| match t {
            CUT => CUT,
            t => place[t as usize],
        };
        let faces: Vec<u32> = order.iter().map(|h| h / 3).collect();
        Self {
            twin: halfedges().map(|h| anew(self.twin[h as usize])).collect(),
            turned: faces.iter().map(|&f| self.turned[f as usize]).collect(),
            piece: relabeled(&self.piece, self.n_pieces, &faces),
            component: relabeled(&self.component, self.n_components, &faces),
            ..*self
        }
    }

    /// Returns whether a glued halfedge and its twin disagree even after the faces in [`turned`](Self::turned) are
    /// turned over: only on pieces that are not orientable, such as a Möbius strip.
    pub fn is_twisted(&self, triangles: &[[u32; 3]], h: u32) -> bool {
        let t = self.twin[h as usize];
        let turned = self.turned[h as usize / 3] != self.turned[t as usize / 3];
        same_direction(triangles, h, t) != turned
    }
}

/// Labels faces by the pieces that glued edges connect.
fn pieces(twin: &[u32]) -> (Vec<u32>, usize) {
    let mut pieces = UnionFind::new(twin.len() / 3);
    for (h, &t) in (0u32..).zip(twin).filter(|(_, t)| **t != CUT) {
        pieces.unite(h / 3, t / 3);
    }
    pieces.labels()
}

/// Returns the labels of faces in another order, renumbered by their first face.
fn relabeled(labels: &[u32], n_labels: usize, order: &[u32]) -> Vec<u32> {
    let mut number = vec![u32::MAX; n_labels];
    let mut n = 0;
    let mut anew = |&face: &u32| {
        let number = &mut number[labels[face as usize] as usize];
        if *number == u32::MAX {
            *number = n;
            n += 1;
        }
        *number
    };
    order.iter().map(&mut anew).collect()
}

fn glue(twin: &mut [u32], a: u32, b: u32) {
    twin[a as usize] = b;
    twin[b as usize] = a;
}

/// Returns for each face the number of earlier faces with the same three vertices.
pub(super) fn copy_ranks(triangles: &[[u32; 3]], edges: &Edges) -> Vec<u32> {
    let mut ranks = vec![0; triangles.len()];
    let mut copies = Vec::new();
    for edge in edges.iter().filter(|edge| edge.len() > 1) {
        // Each face is looked at once: at the edge between its two lowest vertices.
        let top = origin(triangles, edge[0]).max(origin(triangles, next(edge[0])));
        copies.clear();
        copies.extend(
            edge.iter()
                .map(|&h| (origin(triangles, next(next(h))), h / 3)),
        );
        copies.retain(|copy| copy.0 > top);
        copies.sort_unstable();
        for same in copies.chunk_by(|a, b| a.0 == b.0) {
            for (rank, &(_, face)) in (0..).zip(same) {
                ranks[face as usize] = rank;
            }
        }
    }
    ranks
}

/// Pairs the three or more faces of one edge.
fn pair_fan(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    ranks: &[u32],
    edge: &[u32],
    twin: &mut [u32],
) {
    // Too many to compare: pair the faces that run in opposite directions in file order.
    if edge.len() > MOST_FACES_COMPARED {
        let (forth, back): (Vec<u32>, Vec<u32>) = edge
            .iter()
            .partition(|&&h| same_direction(triangles, h, edge[0]));
        for (&a, &b) in forth.iter().zip(&back) {
            glue(twin, a, b);
        }
        return;
    }
    let directions: Vec<[f64; 3]> = edge
        .iter()
        .map(|&h| away_from_edge(positions, triangles, h))
        .collect();
    // Rank the pairs: consistent winding first, then the flatter bend, then copies of equal rank.
    let mut pairs = Vec::new();
    for j in 1..edge.len() {
        for i in 0..j {
            // 0 where the two faces continue each other, 2·10⁶ where one is folded back onto the other. Rounded, so
            // that copies of a face score the same.
            let bend = ((1.0 + dot(directions[i], directions[j])) * 1e6).round() as i64;
            let inconsistent = same_direction(triangles, edge[i], edge[j]);
            let mixed = ranks[edge[i] as usize / 3] != ranks[edge[j] as usize / 3];
            pairs.push((inconsistent, bend, mixed, i, j));
        }
    }
    pairs.sort_unstable();
    // Glue greedily; a face left over stays cut open.
    for (_, _, _, i, j) in pairs {
        let (a, b) = (edge[i], edge[j]);
        if twin[a as usize] == CUT && twin[b as usize] == CUT {
            glue(twin, a, b);
        }
    }
}

/// Returns the direction in which a face leaves its edge, at a right angle; zero for a face without area.
fn away_from_edge(positions: &[[f64; 3]], triangles: &[[u32; 3]], h: u32) -> [f64; 3] {
    let at = |h| positions[origin(triangles, h) as usize];
    let along = unit(sub(at(next(h)), at(h)));
    let across = sub(at(next(next(h))), at(h));
    unit(add_scaled(across, -dot(across, along), along))
}

/// Returns for each face whether to turn it over, propagated from the first face of each piece; the majority of a piece
/// stays as it is.
fn consistent_winding(triangles: &[[u32; 3]], twin: &[u32]) -> Vec<bool> {
    let mut turned: Vec<Option<bool>> = vec![None; triangles.len()];
    let mut piece = Vec::new();
    for first in 0..triangles.len() {
        if turned[first].is_some() {
            continue;
        }
        turned[first] = Some(false);
        piece.clear();
        piece.push(first as u32);
        spread(twin, &mut piece, |h, t| {
            let is_new = turned[t as usize / 3].is_none();
            if is_new {
                let this = turned[h as usize / 3] == Some(true);
                turned[t as usize / 3] = Some(this != same_direction(triangles, h, t));
            }
            is_new
        });
        if 2 * piece
            .iter()
            .filter(|f: &&u32| turned[**f as usize] == Some(true))
            .count()
            > piece.len()
        {
            for &f in &piece {
                turned[f as usize] = turned[f as usize].map(|t| !t);
            }
        }
    }
    turned.into_iter().map(|t| t == Some(true)).collect()
}

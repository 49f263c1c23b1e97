//! A simplified disk, and the transfer of seams back to the original.

use super::closed::ClosedDisk;
use super::decimate::{Care, Collapse, Collapses, Decimation};
use crate::mesh::{Disk, UsedVertices};
use std::collections::HashSet;

/// A disk with fewer vertices than the one it was made from.
pub struct Simplification {
    /// The simplified disk, with the same number of holes.
    pub disk: Disk,
    /// For each of its vertices the one of the finer disk.
    pub vertices: Vec<u32>,
    collapses: Collapses,
    /// For each vertex of the finer disk whether it is on the boundary.
    is_on_boundary: Vec<bool>,
}

impl Simplification {
    /// Simplifies a disk to about `n_vertices` vertices, or more where its shape would suffer. Returns `None` if the
    /// result is not a disk.
    pub fn new(disk: &Disk, positions: &[[f64; 3]], n_vertices: usize) -> Option<Self> {
        let closed = ClosedDisk::new(disk, positions);
        let mut decimation = Decimation::new(&closed.positions, &closed.triangles, closed.n_real);
        let collapses = decimation.coarsen(n_vertices, Care::Shape);
        let is_real = |&(t, _): &(usize, [u32; 3])| t < closed.n_real;
        let triangles = decimation.triangulation.triangles().filter(is_real);
        let mut triangles: Vec<[u32; 3]> = triangles.map(|(_, triangle)| triangle).collect();
        let vertices = UsedVertices::new(triangles.iter().flatten().copied());
        vertices.renumber(triangles.as_flattened_mut());
        let mut is_on_boundary = vec![false; closed.positions.len()];
        for &v in disk.loops.iter().flatten() {
            is_on_boundary[v as usize] = true;
        }
        Some(Self {
            disk: Disk::new(vertices.count(), triangles).ok()?,
            vertices: vertices.into_vec(),
            collapses,
            is_on_boundary,
        })
    }

    /// Transfers seams to the finer disk: returns the interior edges that divide it as these interior edges divide the
    /// simplified disk, each as its two vertices in increasing order.
    ///
    /// The collapsed vertices are put back one by one: edges of the neighbor that lie across such a vertex then end at
    /// the vertex.
    pub fn carried_back(&self, seams: &[[u32; 2]]) -> HashSet<[u32; 2]> {
        let mut carried = Carried {
            edges: HashSet::new(),
            n_at: vec![0; self.is_on_boundary.len()],
            is_on_boundary: &self.is_on_boundary,
        };
        for seam in seams {
            let [a, b] = seam.map(|v| self.vertices[v as usize]);
            carried.insert(a, b);
        }
        for collapse in self.collapses.list.iter().rev() {
            carried.put_back(collapse, self.collapses.ring(collapse));
        }
        carried.edges
    }
}

/// Seams while vertices are put back.
struct Carried<'a> {
    edges: HashSet<[u32; 2]>,
    /// For each vertex the number of seam edges at it.
    n_at: Vec<u32>,
    is_on_boundary: &'a [bool],
}

impl Carried<'_> {
    fn insert(&mut self, a: u32, b: u32) {
        if self.edges.insert([a.min(b), a.max(b)]) {
            self.n_at[a as usize] += 1;
            self.n_at[b as usize] += 1;
        }
    }

    fn remove(&mut self, a: u32, b: u32) -> bool {
        let is_there = self.edges.remove(&[a.min(b), a.max(b)]);
        if is_there {
            self.n_at[a as usize] -= 1;
            self.n_at[b as usize] -= 1;
        }
        is_there
    }

    /// Puts a vertex back between the neighbor onto which it was collapsed and the others of its ring.
    fn put_back(&mut self, collapse: &Collapse, ring: &[u32]) {
        let (vertex, at) = (collapse.vertex, collapse.at as usize);
        let onto = ring[at];
        if self.n_at[onto as usize] == 0 {
            return;
        }
        let is_beside = |i: usize| {
            let apart = i.abs_diff(at);
            apart <= 1 || collapse.closed && apart == ring.len() - 1
        };
        let across = (0..ring.len()).filter(|&i| !is_beside(i));
        let moved: Vec<u32> = across
            .map(|i| ring[i])
            .filter(|&other| self.remove(onto, other))
            .collect();
        for &other in &moved {
            self.insert(vertex, other);
        }
        // A seam that ended at the neighbor still does, and seams that met there still do; where all of these lay across the vertex,
        // they meet at the vertex now. What is on the boundary went along it.
        let goes_on = self.n_at[onto as usize] > 0 || self.is_on_boundary[onto as usize];
        let is_inside = !self.is_on_boundary[vertex as usize];
        if is_inside && !moved.is_empty() && (goes_on || moved.len() == 1) {
            self.insert(vertex, onto);
        }
    }
}

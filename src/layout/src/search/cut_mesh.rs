//! Faces of a surface, cut open along slits.

use super::metric::Metric;
use std::sync::Arc;
use unwrapd_maps::cut::{Neighbors, Sheet, distances_until};
use unwrapd_maps::mesh::{CUT, next};

/// Some faces of a surface, glued along the edges between them that are no slits.
pub struct CutMesh<'a> {
    pub metric: &'a Metric<'a>,
    /// Faces in ascending order.
    pub faces: Arc<[u32]>,
    /// The faces with their gluing, numbered in that order.
    pub sheet: Sheet,
    /// For each vertex its vertex of the surface.
    pub welded: Vec<u32>,
    /// For each vertex the sum of the angles of the faces around it.
    pub angle: Vec<f64>,
    /// For each vertex whether it is not on the boundary.
    pub is_inner: Vec<bool>,
    /// Vertices of each boundary loop.
    pub loops: Vec<Vec<u32>>,
}

impl<'a> CutMesh<'a> {
    /// Glues faces, given in ascending order, except along `slits`, edges in ascending order.
    pub fn new(metric: &'a Metric, faces: impl Into<Arc<[u32]>>, slits: &[u32]) -> Self {
        let faces = faces.into();
        let local = |h: u32| {
            let t = metric.twin[h as usize];
            if t == CUT || slits.binary_search(&metric.edge[h as usize]).is_ok() {
                return CUT;
            }
            match faces.binary_search(&(t / 3)) {
                Ok(place) => 3 * place as u32 + t % 3,
                Err(_) => CUT,
            }
        };
        let twin: Vec<u32> = (faces.iter())
            .flat_map(|&f| [0, 1, 2].map(|k| local(3 * f + k)))
            .collect();
        let corners: Vec<[u32; 3]> = faces.iter().map(|&f| metric.corners[f as usize]).collect();
        let labels = vec![0; faces.len()];
        let positions = &*metric.surface.positions;
        let sheet = Sheet::divide((&corners, positions), &twin, &labels, 1).swap_remove(0);
        let n = sheet.positions.len();
        let (mut welded, mut angle) = (vec![0; n], vec![0.0; n]);
        for (corner, &vertex) in sheet.vertex.iter().enumerate() {
            let face = faces[corner / 3] as usize;
            welded[vertex as usize] = corners[corner / 3][corner % 3];
            angle[vertex as usize] += metric.angle[3 * face + corner % 3];
        }
        let (loops, is_inner) = boundary_loops(&sheet);
        Self {
            metric,
            faces,
            sheet,
            welded,
            angle,
            is_inner,
            loops,
        }
    }

    /// Returns the edge of the surface that a halfedge of the sheet lies on.
    pub fn edge(&self, h: u32) -> u32 {
        let face = self.faces[h as usize / 3];
        self.metric.edge[(3 * face + h % 3) as usize]
    }

    /// Returns whether the faces form one disk, possibly with holes.
    pub fn is_disk(&self) -> bool {
        let n_boundary: usize = self.loops.iter().map(Vec::len).sum();
        let n_edges = usize::midpoint(self.sheet.twin.len(), n_boundary);
        // Euler: V − E + F = 2 − L for a connected surface without handles.
        let euler = (self.welded.len() + self.faces.len()) as isize - n_edges as isize;
        !self.loops.is_empty() && euler == 2 - self.loops.len() as isize && self.is_connected()
    }

    /// Returns whether the faces form a closed surface of genus 0.
    pub fn is_sphere(&self) -> bool {
        let n_edges = self.sheet.twin.len() / 2;
        self.loops.is_empty() && self.welded.len() + self.faces.len() == n_edges + 2
    }

    fn is_connected(&self) -> bool {
        let mut seen = vec![false; self.faces.len()];
        let mut pending = vec![0u32];
        seen[0] = true;
        let mut n_seen = 1;
        while let Some(face) = pending.pop() {
            for h in 3 * face..3 * face + 3 {
                let t = self.sheet.twin[h as usize];
                if t != CUT && !std::mem::replace(&mut seen[t as usize / 3], true) {
                    n_seen += 1;
                    pending.push(t / 3);
                }
            }
        }
        n_seen == self.faces.len()
    }

    /// Returns by how much a walk along a boundary loop, seen from the faces, fails to close in the plane: 0 around a hole
    /// of a plane.
    pub fn turn(&self, boundary: &[u32]) -> f64 {
        let pi = std::f64::consts::PI;
        let bend = |&v: &u32| pi - self.angle[v as usize];
        2.0 * pi + boundary.iter().map(bend).sum::<f64>()
    }

    /// Returns the edges of some halfedges, in ascending order.
    pub fn edges(&self, halfedges: &[u32]) -> Vec<u32> {
        let mut edges: Vec<u32> = halfedges.iter().map(|&h| self.edge(h)).collect();
        edges.sort_unstable();
        edges
    }

    /// Returns the shortest path inside the faces from any of some vertices to the nearest of others, as halfedges; `None`
    /// without one.
    pub fn path(
        &self,
        neighbors: &Neighbors,
        from: impl IntoIterator<Item = u32>,
        is_goal: impl Fn(u32) -> bool,
    ) -> Option<Vec<u32>> {
        let length = |h: u32| match self.sheet.twin[h as usize] {
            CUT => f64::INFINITY,
            _ => self.metric.length[self.edge(h) as usize],
        };
        let (distances, end) = distances_until(&self.sheet, neighbors, from, length, is_goal);
        let end = end.filter(|&v| distances.distance[v as usize].is_finite())?;
        Some(distances.path(&self.sheet, end).collect())
    }
}

/// Returns the boundary loops of a sheet of consistently wound faces, and for each vertex whether it is on none.
fn boundary_loops(sheet: &Sheet) -> (Vec<Vec<u32>>, Vec<bool>) {
    let n = sheet.positions.len();
    let mut after = vec![CUT; n];
    for h in (0..sheet.twin.len() as u32).filter(|&h| sheet.twin[h as usize] == CUT) {
        after[sheet.vertex[h as usize] as usize] = sheet.vertex[next(h) as usize];
    }
    let mut is_inner = vec![true; n];
    let mut loops = Vec::new();
    for start in 0..n {
        let mut boundary = Vec::new();
        let mut v = start;
        while is_inner[v] && after[v] != CUT {
            is_inner[v] = false;
            boundary.push(v as u32);
            v = after[v] as usize;
        }
        if !boundary.is_empty() {
            loops.push(boundary);
        }
    }
    (loops, is_inner)
}

//! A surface proven to be one disk, possibly with holes.

use super::edges::{CUT, Edges, same_direction, spread};
use thiserror::Error;

/// Triangles that form one connected, oriented, manifold surface of genus 0 with at least one boundary loop.
///
/// The fields are public to be read; a `Disk` made by [`Disk::new`] is proven, and everything that maps disks relies on
/// the proof.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Disk {
    /// Number of vertices; each of `0..n_vertices` is used by a triangle.
    pub n_vertices: usize,
    /// Vertex indices of each triangle, consistently oriented.
    pub triangles: Vec<[u32; 3]>,
    /// Boundary loops in the direction of their triangles' halfedges; the one with most edges first, at least three
    /// edges each.
    pub loops: Vec<Vec<u32>>,
}

/// Reason why triangles are not a [`Disk`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum NotADisk {
    /// There is no triangle.
    #[error("the mesh has no triangles")]
    Empty,
    /// A triangle names a vertex that does not exist.
    #[error("triangle {0} names a vertex that does not exist")]
    OutOfRange(usize),
    /// A triangle names a vertex twice.
    #[error("triangle {0} names a vertex twice")]
    RepeatedVertex(usize),
    /// No triangle uses the vertex.
    #[error("vertex {0} is not used")]
    UnusedVertex(u32),
    /// More than two triangles share the edge.
    #[error("edge {0} {1} is shared by more than two triangles")]
    NonManifoldEdge(u32, u32),
    /// The two triangles at the edge run along it in the same direction.
    #[error("the triangles at edge {0} {1} are oriented inconsistently")]
    Inconsistent(u32, u32),
    /// The triangles around the vertex form more than one fan.
    #[error("vertex {0} joins several fans of triangles")]
    NonManifoldVertex(u32),
    /// The triangles are not connected over edges.
    #[error("the triangles are not connected")]
    Disconnected,
    /// The surface has no boundary.
    #[error("the surface is closed: it has no boundary loop")]
    Closed,
    /// The surface has handles; the value is its genus.
    #[error("the surface has genus {0}, not 0")]
    Genus(usize),
}

impl Disk {
    /// Proves that the triangles form a disk, possibly with holes, and finds its boundary loops. O(n log n).
    pub fn new(n_vertices: usize, triangles: Vec<[u32; 3]>) -> Result<Self, NotADisk> {
        check_indices(n_vertices, &triangles)?;
        let opposite = opposite_halfedges(n_vertices, &triangles)?;
        check_connected(&opposite)?;
        let next = boundary_successors(n_vertices, &triangles, &opposite);
        check_umbrellas(n_vertices, &triangles, &opposite)?;
        let loops = boundary_loops(&next);
        if loops.is_empty() {
            return Err(NotADisk::Closed);
        }
        let n_boundary: usize = loops.iter().map(Vec::len).sum();
        let n_edges = usize::midpoint(3 * triangles.len(), n_boundary);
        // Euler: V − E + F = 2 − 2g − L.
        let genus = (2 + n_edges - n_vertices - triangles.len() - loops.len()) / 2;
        if genus > 0 {
            return Err(NotADisk::Genus(genus));
        }
        Ok(Self {
            n_vertices,
            triangles,
            loops,
        })
    }

    /// Returns for each halfedge the one across, or [`CUT`]. O(n log n).
    pub fn twins(&self) -> Vec<u32> {
        let mut twin = vec![CUT; 3 * self.triangles.len()];
        for edge in Edges::new(self.n_vertices, &self.triangles).iter() {
            if let [a, b] = *edge {
                twin[a as usize] = b;
                twin[b as usize] = a;
            }
        }
        twin
    }

    /// Returns the images of the boundary loops in a map with the vertices at `uv`.
    pub fn boundary_in(&self, uv: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
        self.loops
            .iter()
            .map(|boundary: &Vec<u32>| boundary.iter().map(|&v| uv[v as usize]).collect())
            .collect()
    }
}

fn check_indices(n_vertices: usize, triangles: &[[u32; 3]]) -> Result<(), NotADisk> {
    if triangles.is_empty() {
        return Err(NotADisk::Empty);
    }
    let mut used = vec![false; n_vertices];
    for (t, &[a, b, c]) in triangles.iter().enumerate() {
        for v in [a, b, c] {
            *used.get_mut(v as usize).ok_or(NotADisk::OutOfRange(t))? = true;
        }
        if a == b || b == c || c == a {
            return Err(NotADisk::RepeatedVertex(t));
        }
    }
    match used.iter().position(|used| !used) {
        Some(v) => Err(NotADisk::UnusedVertex(v as u32)),
        None => Ok(()),
    }
}

/// Returns the vertices of a halfedge; `3t + k` runs from corner k to corner k+1 of triangle t.
fn ends(triangles: &[[u32; 3]], halfedge: usize) -> (u32, u32) {
    let triangle = &triangles[halfedge / 3];
    (triangle[halfedge % 3], triangle[(halfedge + 1) % 3])
}

fn next_in_triangle(halfedge: usize) -> usize {
    halfedge - halfedge % 3 + (halfedge + 1) % 3
}

fn opposite_halfedges(n_vertices: usize, triangles: &[[u32; 3]]) -> Result<Vec<u32>, NotADisk> {
    let mut opposite = vec![CUT; 3 * triangles.len()];
    for edge in Edges::new(n_vertices, triangles).iter() {
        let (a, b) = ends(triangles, edge[0] as usize);
        match *edge {
            [_] => {}
            [g, h] if same_direction(triangles, g, h) => {
                return Err(NotADisk::Inconsistent(a.min(b), a.max(b)));
            }
            [g, h] => {
                opposite[g as usize] = h;
                opposite[h as usize] = g;
            }
            _ => return Err(NotADisk::NonManifoldEdge(a.min(b), a.max(b))),
        }
    }
    Ok(opposite)
}

fn check_connected(opposite: &[u32]) -> Result<(), NotADisk> {
    let mut seen = vec![false; opposite.len() / 3];
    let mut faces = vec![0];
    seen[0] = true;
    spread(opposite, &mut faces, |_, h| {
        !std::mem::replace(&mut seen[h as usize / 3], true)
    });
    if faces.len() == seen.len() {
        Ok(())
    } else {
        Err(NotADisk::Disconnected)
    }
}

/// Returns the end of the boundary halfedge that starts at each vertex; of several the last (the umbrella check refuses
/// such vertices).
fn boundary_successors(
    n_vertices: usize,
    triangles: &[[u32; 3]],
    opposite: &[u32],
) -> Vec<Option<u32>> {
    let mut next = vec![None; n_vertices];
    for (h, _) in opposite.iter().enumerate().filter(|(_, o)| **o == CUT) {
        let (a, b) = ends(triangles, h);
        next[a as usize] = Some(b);
    }
    next
}

/// Checks that turning around each vertex reaches all its corners.
fn check_umbrellas(
    n_vertices: usize,
    triangles: &[[u32; 3]],
    opposite: &[u32],
) -> Result<(), NotADisk> {
    let mut n_corners = vec![0_u32; n_vertices];
    // Turning starts at the boundary halfedge that leaves the vertex, else anywhere.
    let mut first = vec![CUT; n_vertices];
    for (h, &across) in opposite.iter().enumerate() {
        let v = ends(triangles, h).0 as usize;
        n_corners[v] += 1;
        if first[v] == CUT || across == CUT {
            first[v] = h as u32;
        }
    }
    // Turn around each vertex and count the corners reached.
    for (v, &start) in first.iter().enumerate() {
        let mut h = start as usize;
        let mut n_reached = 1;
        loop {
            // The incoming halfedge of the same triangle, then across it.
            let across = opposite[next_in_triangle(next_in_triangle(h))];
            if across == CUT || across == start {
                break;
            }
            h = across as usize;
            n_reached += 1;
        }
        if n_reached < n_corners[v] {
            return Err(NotADisk::NonManifoldVertex(v as u32));
        }
    }
    Ok(())
}

fn boundary_loops(next: &[Option<u32>]) -> Vec<Vec<u32>> {
    let mut seen = vec![false; next.len()];
    let mut loops = Vec::new();
    for start in 0..next.len() {
        let mut boundary = Vec::new();
        let mut v = start;
        while let (false, Some(successor)) = (seen[v], next[v]) {
            seen[v] = true;
            boundary.push(v as u32);
            v = successor as usize;
        }
        if !boundary.is_empty() {
            loops.push(boundary);
        }
    }
    loops.sort_by_key(|boundary| std::cmp::Reverse(boundary.len()));
    loops
}

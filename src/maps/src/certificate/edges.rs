//! Faces that meet at an edge, grouped by equal UVs.

use crate::mesh::CornerUvs;
use std::cmp::Ordering;

/// Relation of a halfedge to the one before it in [`UvEdges::order`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Start {
    /// The first halfedge of another edge.
    Edge,
    /// Another group of the same edge, with other UVs: a seam lies between the two.
    Group,
    /// Another halfedge with the same edge and UVs.
    Same,
}

/// All halfedges, sorted so that those of one edge, and among them those with equal UVs, follow each other.
///
/// A halfedge is named by its corner: `3 * face + c` goes from corner `c` to the next. Halfedges between equal vertices
/// are left out.
pub(crate) struct UvEdges {
    pub order: Vec<u32>,
    pub start: Vec<Start>,
}

/// An edge of the surface as one face sees it.
#[derive(Clone, Copy)]
pub(crate) struct Halfedge {
    pub face: u32,
    /// Vertices, the smaller number first.
    pub vertices: [u32; 2],
    /// UVs at these vertices.
    pub uvs: [[f64; 2]; 2],
    /// `true` if the face runs from the smaller number to the greater.
    pub forward: bool,
}

/// Returns the halfedge at `corner` of faces given by their vertices.
pub(crate) fn halfedge(corner: u32, faces: &[[u32; 3]], uvs: &[CornerUvs]) -> Halfedge {
    let (face, c) = ((corner / 3) as usize, (corner % 3) as usize);
    let next = (c + 1) % 3;
    let (a, b) = (faces[face][c], faces[face][next]);
    let (uv_a, uv_b) = (uvs[face][c], uvs[face][next]);
    if a < b {
        Halfedge {
            face: corner / 3,
            vertices: [a, b],
            uvs: [uv_a, uv_b],
            forward: true,
        }
    } else {
        Halfedge {
            face: corner / 3,
            vertices: [b, a],
            uvs: [uv_b, uv_a],
            forward: false,
        }
    }
}

impl UvEdges {
    /// Sorts the edges of `faces` over `n_vertices` welded vertices; UVs within `tolerance` of each other are equal.
    pub fn new(
        faces: &[[u32; 3]],
        uvs: &[CornerUvs],
        n_vertices: usize,
        tolerance: f64,
    ) -> UvEdges {
        let (mut order, first) = by_lower_vertex(faces, n_vertices);
        for vertex in 0..n_vertices {
            let corners = &mut order[first[vertex]..first[vertex + 1]];
            corners.sort_by(|&a, &b| compare(&halfedge(a, faces, uvs), &halfedge(b, faces, uvs)));
        }
        let mut start = Vec::with_capacity(order.len());
        let mut previous: Option<Halfedge> = None;
        for &corner in &order {
            let current = halfedge(corner, faces, uvs);
            start.push(match previous {
                Some(p) if p.vertices == current.vertices => {
                    if agree(p.uvs, current.uvs, tolerance) {
                        Start::Same
                    } else {
                        Start::Group
                    }
                }
                _ => Start::Edge,
            });
            previous = Some(current);
        }
        UvEdges { order, start }
    }
}

/// Buckets corners by the smaller vertex of their halfedge, in increasing order; returns them and the start of each
/// bucket.
fn by_lower_vertex(faces: &[[u32; 3]], n_vertices: usize) -> (Vec<u32>, Vec<usize>) {
    let lower = |face: &[u32; 3], c: usize| {
        let (a, b) = (face[c], face[(c + 1) % 3]);
        (a != b).then(|| a.min(b) as usize)
    };
    let mut first = vec![0; n_vertices + 1];
    for face in faces {
        for vertex in (0..3).filter_map(|c| lower(face, c)) {
            first[vertex + 1] += 1;
        }
    }
    for vertex in 0..n_vertices {
        first[vertex + 1] += first[vertex];
    }
    let mut next = first.clone();
    let mut order = vec![0; first[n_vertices]];
    for (f, face) in faces.iter().enumerate() {
        for c in 0..3 {
            if let Some(vertex) = lower(face, c) {
                order[next[vertex]] = (3 * f + c) as u32;
                next[vertex] += 1;
            }
        }
    }
    (order, first)
}

/// Compares by the greater vertex, then by the UVs.
fn compare(a: &Halfedge, b: &Halfedge) -> Ordering {
    a.vertices[1]
        .cmp(&b.vertices[1])
        .then_with(|| a.uvs.partial_cmp(&b.uvs).unwrap_or(Ordering::Equal))
}

fn agree(a: [[f64; 2]; 2], b: [[f64; 2]; 2], tolerance: f64) -> bool {
    let close = |k: usize, axis: usize| (a[k][axis] - b[k][axis]).abs() <= tolerance;
    close(0, 0) && close(0, 1) && close(1, 0) && close(1, 1)
}

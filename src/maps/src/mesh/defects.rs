//! Defects of a triangle list, one check each.

use super::adjacency::copy_ranks;
use super::edges::Edges;
use super::{Adjacency, CUT, UnionFind, next, origin, same_direction};
use serde::Serialize;
use unwrapd_method::numerics::vec3::{area_vector, distance, norm};

/// Counts of what is wrong, or at least worth knowing, about a list of triangles. All faces but those that repeat a
/// position are unwrapped nevertheless.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Defects {
    /// Vertices at the position of an earlier vertex; files split vertices for normals and texture coordinates.
    pub welded_vertices: usize,
    /// Vertices that no face names.
    pub unreferenced_vertices: usize,
    /// Faces that name one vertex or one position twice: they have no UV area and are left out.
    pub repeated_vertex_faces: usize,
    /// Faces with three different positions on one line (doubled area at most 10⁻⁹ of the longest edge's square).
    pub zero_area_faces: usize,
    /// Faces with the same three positions as an earlier face, in any order.
    pub duplicate_faces: usize,
    /// Edges with three or more faces.
    pub nonmanifold_edges: usize,
    /// Positions where fans of faces touch that share no edge there.
    pub bowtie_vertices: usize,
    /// Edges whose two faces both run along them the same way: one of them is wound the other way.
    pub inconsistent_edges: usize,
    /// Pieces that no turning over of faces makes consistent, such as Möbius strips.
    pub nonorientable_components: usize,
    /// Parts of the surface that share no edge.
    pub components: usize,
    /// Closed runs of edges with nothing glued to them.
    pub boundary_loops: usize,
}

impl Defects {
    /// Counts the defects of triangles that have three different vertices.
    pub(super) fn of_triangles(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        edges: &Edges,
        adjacency: &Adjacency,
    ) -> Self {
        Self {
            zero_area_faces: zero_area_faces(positions, triangles),
            duplicate_faces: duplicate_faces(triangles, edges),
            nonmanifold_edges: adjacency.n_nonmanifold_edges,
            bowtie_vertices: bowtie_vertices(positions.len(), triangles, edges),
            inconsistent_edges: inconsistent_edges(triangles, adjacency),
            nonorientable_components: nonorientable_components(triangles, adjacency),
            components: adjacency.n_components,
            boundary_loops: boundary_loops(triangles, adjacency),
            ..Self::default()
        }
    }

    /// Adds the counts that only the unwelded input shows.
    pub(super) fn count_input(
        &mut self,
        n_vertices: usize,
        triangles: &[[u32; 3]],
        n_distinct: usize,
        n_kept: usize,
    ) {
        let mut used = vec![false; n_vertices];
        for &v in triangles.iter().flatten() {
            used[v as usize] = true;
        }
        self.unreferenced_vertices = used.iter().filter(|&&u| !u).count();
        self.welded_vertices = n_vertices - n_distinct;
        self.repeated_vertex_faces = triangles.len() - n_kept;
    }
}

/// Returns whether a triangle's corners lie on one line as far as single precision can tell.
pub fn has_zero_area([a, b, c]: [[f64; 3]; 3]) -> bool {
    let longest = distance(a, b).max(distance(b, c)).max(distance(c, a));
    norm(area_vector(a, b, c)) <= 1e-9 * longest * longest
}

fn zero_area_faces(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> usize {
    triangles
        .iter()
        .filter(|t| has_zero_area(t.map(|v| positions[v as usize])))
        .count()
}

fn duplicate_faces(triangles: &[[u32; 3]], edges: &Edges) -> usize {
    let ranks = copy_ranks(triangles, edges);
    ranks.iter().filter(|&&rank| rank > 0).count()
}

/// Counts vertices with several fans: corners at one vertex are united through every edge they share there; a second
/// set left over is a second fan.
fn bowtie_vertices(n_vertices: usize, triangles: &[[u32; 3]], edges: &Edges) -> usize {
    let mut fans = UnionFind::new(3 * triangles.len());
    for edge in edges.iter() {
        for &h in &edge[1..] {
            let (near, far) = if same_direction(triangles, edge[0], h) {
                (h, next(h))
            } else {
                (next(h), h)
            };
            fans.unite(edge[0], near);
            fans.unite(next(edge[0]), far);
        }
    }
    let mut fans_at = vec![0u8; n_vertices];
    for corner in 0..3 * triangles.len() as u32 {
        if fans.find(corner) == corner {
            let count = &mut fans_at[origin(triangles, corner) as usize];
            *count = count.saturating_add(1);
        }
    }
    fans_at.iter().filter(|&&n| n > 1).count()
}

fn inconsistent_edges(triangles: &[[u32; 3]], adjacency: &Adjacency) -> usize {
    glued_once(adjacency)
        .filter(|&h| same_direction(triangles, h, adjacency.twin[h as usize]))
        .count()
}

fn nonorientable_components(triangles: &[[u32; 3]], adjacency: &Adjacency) -> usize {
    let mut twisted = vec![false; adjacency.n_pieces];
    for h in glued_once(adjacency) {
        if adjacency.is_twisted(triangles, h) {
            twisted[adjacency.piece[h as usize / 3] as usize] = true;
        }
    }
    twisted.iter().filter(|&&t| t).count()
}

/// Iterates over one halfedge of each glued pair.
fn glued_once(adjacency: &Adjacency) -> impl Iterator<Item = u32> {
    (0u32..)
        .zip(&adjacency.twin)
        .filter(|&(h, &t)| t != CUT && h < t)
        .map(|(h, _)| h)
}

/// Counts boundary loops: cut halfedges are united where they meet at a vertex of the glued surface.
fn boundary_loops(triangles: &[[u32; 3]], adjacency: &Adjacency) -> usize {
    let twin = &adjacency.twin;
    let mut loops = UnionFind::new(twin.len());
    let mut n_cut = 0;
    let mut n_joined = 0;
    for h in (0..twin.len() as u32).filter(|&h| twin[h as usize] == CUT) {
        n_cut += 1;
        for vertex in [origin(triangles, h), origin(triangles, next(h))] {
            n_joined += usize::from(loops.unite(h, across_fan(triangles, twin, h, vertex)));
        }
    }
    n_cut - n_joined
}

/// Returns the cut halfedge at the other end of the fan around `vertex` that begins with the cut halfedge `h`.
fn across_fan(triangles: &[[u32; 3]], twin: &[u32], h: u32, vertex: u32) -> u32 {
    let mut side = h;
    loop {
        side = if origin(triangles, side) == vertex {
            next(next(side))
        } else {
            next(side)
        };
        match twin[side as usize] {
            CUT => return side,
            glued => side = glued,
        }
    }
}

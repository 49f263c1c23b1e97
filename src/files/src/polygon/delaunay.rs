//! The constrained Delaunay triangulation of a polygon of the plane.

use spade::handles::{DirectedEdgeHandle, FixedDirectedEdgeHandle, FixedVertexHandle};
use spade::{CdtEdge, ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

/// A position of the polygon, shared by one or more corners.
struct Site {
    position: Point2<f64>,
    first_corner: usize,
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

type Cdt = ConstrainedDelaunayTriangulation<Site>;
type PolygonEdge<'a> = DirectedEdgeHandle<'a, Site, (), CdtEdge<()>, ()>;

/// No corner, or no side.
const NONE: u32 = u32::MAX;

/// Appends the n − 2 triangles of a counter-clockwise polygon, as indices of its corners. Returns `None`, after
/// arbitrary additions, if it is not simple: if sides cross, lie on each other in one direction, or pass through
/// corners.
///
/// Each corner gets the triangles of the wedge between its two sides. These are inside, no other side begins in the
/// wedge, and every corner of every triangle is in just one wedge: therefore the boundary of the union of the triangles
/// consists of exactly the polygon's sides.
pub(super) fn fill(points: &[[f64; 2]], triangles: &mut Vec<[u32; 3]>) -> Option<()> {
    let n = points.len();
    let (sites, site_of) = sites(points);
    let mut cdt = Cdt::bulk_load(sites).ok()?;
    let sides = add_sides(&mut cdt, &site_of)?;
    // Find the corner of each side. Two sides on one directed edge are not simple.
    let mut side_of = vec![NONE; cdt.num_directed_edges()];
    for (k, side) in sides.iter().enumerate() {
        if std::mem::replace(&mut side_of[side.index()], k as u32) != NONE {
            return None;
        }
    }
    // For each directed edge the corner at its origin in the triangle on its left.
    let mut corner_of = vec![NONE; side_of.len()];
    for (k, &side) in sides.iter().enumerate() {
        let before = ((k + n - 1) % n) as u32;
        let last = walk_wedge(cdt.directed_edge(side), k as u32, &mut corner_of)?;
        if side_of[last.rev().fix().index()] != before {
            return None;
        }
    }
    // Keep the triangles inside, which have a corner at each of their edges; those outside have none.
    let mut n_triangles = 0;
    for face in cdt.inner_faces() {
        let corners = face
            .adjacent_edges()
            .map(|edge| corner_of[edge.fix().index()]);
        if corners == [NONE; 3] {
            continue;
        }
        if corners.contains(&NONE) {
            return None;
        }
        triangles.push(corners);
        n_triangles += 1;
    }
    (n_triangles == n - 2).then_some(())
}

/// Returns the positions, each once, and for each corner the first one at its position.
fn sites(points: &[[f64; 2]]) -> (Vec<Site>, Vec<usize>) {
    let mut order: Vec<usize> = (0..points.len()).collect();
    let position = |k: usize| {
        // Numbers too small to compute with become 0; adding 0 removes the sign of a zero.
        let [x, y] = points[k].map(|x| x + 0.0);
        spade::mitigate_underflow(Point2::new(x, y))
    };
    let key = |k: usize| (position(k).x, position(k).y);
    order.sort_by(|&a, &b| {
        let ((ax, ay), (bx, by)) = (key(a), key(b));
        ax.total_cmp(&bx).then(ay.total_cmp(&by))
    });
    let mut site_of = vec![0; points.len()];
    let mut sites: Vec<Site> = Vec::with_capacity(points.len());
    for corner in order {
        let position = position(corner);
        match sites.last() {
            Some(last) if last.position == position => site_of[corner] = last.first_corner,
            _ => {
                site_of[corner] = corner;
                sites.push(Site {
                    position,
                    first_corner: corner,
                });
            }
        }
    }
    (sites, site_of)
}

/// Adds the sides of the polygon, each from a corner to the next; returns `None` if one is not a single edge.
fn add_sides(cdt: &mut Cdt, site_of: &[usize]) -> Option<Vec<FixedDirectedEdgeHandle>> {
    let n = site_of.len();
    let mut vertex_of = vec![FixedVertexHandle::from_index(0); n];
    for vertex in cdt.vertices() {
        vertex_of[vertex.data().first_corner] = vertex.fix();
    }
    let mut sides = Vec::with_capacity(n);
    for k in 0..n {
        let [from, to] = [k, (k + 1) % n].map(|corner| vertex_of[site_of[corner]]);
        let [edge] = cdt.try_add_constraint(from, to)[..] else {
            return None;
        };
        let is_reversed = cdt.directed_edge(edge).from().fix() != from;
        sides.push(if is_reversed { edge.rev() } else { edge });
    }
    Some(sides)
}

/// Turns counter-clockwise from a side to the next side that begins at its origin, assigns the corner to all triangles
/// between them, and returns that side. Returns `None` if that leads outside or to a triangle that already has a
/// corner.
fn walk_wedge<'a>(
    side: PolygonEdge<'a>,
    corner: u32,
    corner_of: &mut [u32],
) -> Option<PolygonEdge<'a>> {
    let mut edge = side;
    loop {
        let slot = &mut corner_of[edge.fix().index()];
        if edge.is_outer_edge() || *slot != NONE {
            return None;
        }
        *slot = corner;
        edge = edge.ccw();
        if edge.is_constraint_edge() {
            return Some(edge);
        }
    }
}

//! Triangles inside polygons.
//!
//! A polygon of n corners becomes n − 2 triangles between its corners, with its winding. A quad is split by the
//! diagonal that lies inside and folds less; larger polygons get the constrained Delaunay triangulation (`spade`) of
//! their projection onto the plane of their Newell normal, the mean plane of a polygon that is not flat. No vertex is
//! added, and corners in the middle of a straight side are corners of triangles of positive area like all others. A
//! polygon may touch itself, for example if it leads to a hole and back along a bridge: triangles belong to corners,
//! not to positions.
//!
//! A polygon that crosses itself in that projection or has no area has no inside: it becomes the fan of its first
//! corner, which is reported ([`Filling::Fan`]). Nothing here looks beyond one polygon.

use spade::handles::{DirectedEdgeHandle, FixedDirectedEdgeHandle, FixedVertexHandle};
use spade::{CdtEdge, ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};
use unwrapd_method::numerics::vec3::{cross, dot, norm, perpendicular, sub, unit};

/// Method by which a polygon became triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Filling {
    /// Triangles that cover its inside once.
    Inside,
    /// The fan of its first corner: it crosses itself or has no area.
    Fan,
}

/// Appends the triangles of a polygon, as indices of its corners; fewer than three corners have no triangles.
///
/// The smallest index of a triangle comes first, and triangles are sorted: a fan keeps its order, and equal corners
/// give equal triangles. A corner at the position of the one before it gets a triangle without area.
pub fn triangulate(corners: &[[f64; 3]], triangles: &mut Vec<[u32; 3]>) -> Filling {
    let n = corners.len();
    if n < 4 {
        triangles.extend((n == 3).then_some([0, 1, 2]));
        return Filling::Inside;
    }
    let start = triangles.len();
    if fill(corners, triangles).is_some() {
        let filled = &mut triangles[start..];
        for triangle in filled.iter_mut() {
            *triangle = smallest_first(*triangle);
        }
        filled.sort_unstable();
        return Filling::Inside;
    }
    triangles.truncate(start);
    triangles.extend((2..n as u32).map(|k| [0, k - 1, k]));
    Filling::Fan
}

/// Rotates a triangle so that it begins at its smallest corner.
pub fn smallest_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    match a.min(b).min(c) {
        first if first == a => [a, b, c],
        first if first == b => [b, c, a],
        _ => [c, a, b],
    }
}

/// Appends the triangles of the inside, in any order; `None` if there is no inside.
fn fill(corners: &[[f64; 3]], triangles: &mut Vec<[u32; 3]>) -> Option<()> {
    let n = corners.len();
    let repeats = |k: usize| corners[k] == corners[(k + n - 1) % n];
    if !(0..n).any(repeats) {
        return fill_distinct(corners, triangles);
    }
    let kept: Vec<u32> = (0..n).filter(|&k| !repeats(k)).map(|k| k as u32).collect();
    let distinct: Vec<[f64; 3]> = kept.iter().map(|&k| corners[k as usize]).collect();
    let start = triangles.len();
    fill_distinct(&distinct, triangles)?;
    for triangle in &mut triangles[start..] {
        *triangle = triangle.map(|k| kept[k as usize]);
    }
    // Ears without area: after each kept corner those that repeat it, up to the next kept one.
    for (&corner, &next) in kept.iter().zip(kept.iter().cycle().skip(1)) {
        let mut repeated = (corner + 1) % n as u32;
        while repeated != next {
            let following = (repeated + 1) % n as u32;
            triangles.push([corner, repeated, following]);
            repeated = following;
        }
    }
    Some(())
}

/// Like [`fill`], for a polygon without sides of length zero.
fn fill_distinct(corners: &[[f64; 3]], triangles: &mut Vec<[u32; 3]>) -> Option<()> {
    match corners {
        [a, b, c, d] => triangles.extend(fill_quad([*a, *b, *c, *d])?),
        [_, _, _, ..] => fill_delaunay(&flattened(corners)?, triangles)?,
        _ => return None,
    }
    Some(())
}

// The constrained Delaunay triangulation of a polygon of the plane.

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
fn fill_delaunay(points: &[[f64; 2]], triangles: &mut Vec<[u32; 3]>) -> Option<()> {
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

// Quads split by the better of their two diagonals.

/// Least area of each of two triangles, as a share of the quad's area, for the fold alone to decide: thinner ones arise
/// if three corners are nearly collinear.
const THIN: f64 = 1e-6;
/// Least improvement in the cosine of the fold over the first diagonal: a tenth of a degree, above the rounding errors
/// of a flat quad.
const FLATTER: f64 = 1e-6;

/// The triangles on both sides of a diagonal.
struct Halves {
    /// The smaller triangle's share of the quad's area, seen along the quad's normal; negative if the diagonal is
    /// outside.
    least_share: f64,
    /// Cosine of the angle between the triangles' normals.
    flatness: f64,
}

/// Returns two triangles: split by the diagonal of the first corner, unless only the other lies inside, or it folds
/// less. `None` if neither lies inside.
fn fill_quad(corners: [[f64; 3]; 4]) -> Option<[[u32; 3]; 2]> {
    let [a, b, c, d] = scaled(&corners)?;
    let first = Halves::new(area(a, b, c), area(a, c, d));
    let second = Halves::new(area(a, b, d), area(b, c, d));
    let is_second = if first.least_share.min(second.least_share) > THIN {
        second.flatness > first.flatness + FLATTER
    } else {
        second.least_share > first.least_share
    };
    let chosen = if is_second { &second } else { &first };
    let triangles = if is_second {
        [[0, 1, 3], [1, 2, 3]]
    } else {
        [[0, 1, 2], [0, 2, 3]]
    };
    (chosen.least_share > 0.0).then_some(triangles)
}

impl Halves {
    fn new(one: [f64; 3], other: [f64; 3]) -> Self {
        let normal = [0, 1, 2].map(|axis| one[axis] + other[axis]);
        Self {
            least_share: dot(one, normal).min(dot(other, normal)) / dot(normal, normal),
            flatness: dot(one, other) / (norm(one) * norm(other)),
        }
    }
}

/// Returns twice the area of a triangle, as a vector along its normal.
fn area(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> [f64; 3] {
    cross(sub(b, a), sub(c, a))
}

// The plane of a polygon.

/// Least area of a polygon, as a share of its squared extent: smaller areas are rounding errors of zero.
const LEAST_AREA: f64 = 1e-12;

/// Returns the corners relative to the first, in units of a power of two no smaller than the largest coordinate; `None`
/// if there is no such power.
fn scaled<const N: usize>(corners: &[[f64; 3]; N]) -> Option<[[f64; 3]; N]> {
    let frame = PlaneFrame::of(corners)?;
    Some(corners.map(|p| frame.enter(p)))
}

/// Returns the corners in their mean plane, seen from the side from which they turn counter-clockwise; `None` if they
/// have no area. Exact if the plane is that of two axes.
fn flattened(corners: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    let frame = PlaneFrame::of(corners)?;
    let corners: Vec<[f64; 3]> = corners.iter().map(|&p| frame.enter(p)).collect();
    let normal = newell_normal(&corners);
    if norm(normal) <= LEAST_AREA {
        return None;
    }
    let normal = unit(normal);
    let right = perpendicular(normal);
    let up = cross(normal, right);
    Some(
        corners
            .iter()
            .map(|&p| [dot(p, right), dot(p, up)])
            .collect(),
    )
}

/// Returns twice the sum of the areas under all edges, as a vector: normal to the plane in which the polygon has the
/// most area (Newell).
fn newell_normal(corners: &[[f64; 3]]) -> [f64; 3] {
    let mut normal = [0.0; 3];
    let following = corners.iter().cycle().skip(1);
    for (&p, &q) in corners.iter().zip(following) {
        let area = cross(p, q);
        for axis in 0..3 {
            normal[axis] += area[axis];
        }
    }
    normal
}

/// Position and scale of a polygon.
struct PlaneFrame {
    origin: [f64; 3],
    scale: f64,
}

impl PlaneFrame {
    fn of(corners: &[[f64; 3]]) -> Option<Self> {
        let &origin = corners.first()?;
        let extent = corners.iter().flat_map(|&p| sub(p, origin));
        let extent = extent.fold(0.0, |most: f64, x| most.max(x.abs()));
        let scale = (-extent.log2().ceil()).exp2();
        (scale > 0.0 && scale.is_finite()).then_some(Self { origin, scale })
    }

    fn enter(&self, p: [f64; 3]) -> [f64; 3] {
        sub(p, self.origin).map(|x| x * self.scale)
    }
}

//! A triangle surface with one vertex per position.

use super::adjacency::copy_ranks;
use super::edges::Edges;
use super::{Adjacency, CUT, UnionFind, next, origin, same_direction};
use serde::Serialize;
use std::cmp::Ordering;
use std::collections::{HashMap, VecDeque};
use unwrapd_method::numerics::principal_axes::PrincipalAxes;
use unwrapd_method::numerics::ties::tied;
use unwrapd_method::numerics::vec3::{add_scaled, area_vector, cross, distance, dot, norm, sub};

/// Triangles over distinct positions, with their defects counted.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Distinct positions, in the order of their first occurrence in the input. Vertices that no triangle uses are kept
    /// until the surface is [reordered](Self::reordered).
    pub positions: Vec<[f64; 3]>,
    /// Three different vertices each, wound as in the input.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle its face in the input; increasing until the surface is reordered.
    pub faces: Vec<u32>,
    /// For each triangle the corner of that face that it begins with; 0 until the surface is reordered.
    begins_with: Vec<u8>,
    /// Defects of the input's faces.
    pub defects: Defects,
    pub(super) adjacency: Adjacency,
    is_cut: bool,
}

/// Reason why a list of triangles is not a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are only {n_vertices} vertices")]
    IndexOutOfRange {
        /// First such face.
        face: usize,
        /// Vertex that it names.
        vertex: u32,
        /// Number of vertices.
        n_vertices: usize,
    },
    /// A face's vertex has a coordinate that is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NonFinitePosition {
        /// First such vertex.
        vertex: u32,
    },
    /// More faces or vertices than 32-bit corner indices can count.
    #[error("too many faces or vertices for 32-bit indices")]
    TooLarge,
}

impl Surface {
    /// Creates the surface of an indexed triangle list: vertices at equal positions (bit-equal, −0 = 0) become one, and
    /// faces that name a position twice are left out.
    ///
    /// Everything else is kept, however broken; [`defects`](Self::defects) counts it. Vertices that no face names may
    /// hold anything, also NaN. Coordinates are `f32` or `f64`. Nearly linear in the size of the input.
    pub fn new<T: Copy + Into<f64>>(
        positions: &[[T; 3]],
        triangles: &[[u32; 3]],
    ) -> Result<Self, MeshError> {
        if positions.len() >= u32::MAX as usize || triangles.len() >= u32::MAX as usize / 3 {
            return Err(MeshError::TooLarge);
        }
        validate(positions, triangles)?;
        // Weld the vertices; keep the faces with three different ones.
        let (distinct, vertex_of) = weld(positions.iter().map(|p| p.map(Into::into)));
        let mut kept = Vec::with_capacity(triangles.len());
        let mut faces = Vec::with_capacity(triangles.len());
        for (face, triangle) in triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(|v| vertex_of[v as usize]);
            if a != b && b != c && c != a {
                kept.push([a, b, c]);
                faces.push(face as u32);
            }
        }
        // Glue the faces and count the defects.
        let edges = Edges::new(distinct.len(), &kept);
        let adjacency = Adjacency::new(&distinct, &kept, &edges);
        let mut defects = Defects::of_triangles(&distinct, &kept, &edges, &adjacency);
        defects.count_input(positions.len(), triangles, distinct.len(), kept.len());
        Ok(Self {
            positions: distinct,
            triangles: kept,
            begins_with: vec![0; faces.len()],
            faces,
            defects,
            adjacency,
            is_cut: false,
        })
    }

    /// Cuts the surface along the edges for which `is_seam` returns `true`, called with the two halfedges that are
    /// glued there: no chart extends across them.
    pub fn cut_along(&mut self, is_seam: impl Fn(u32, u32) -> bool) {
        self.adjacency.cut(&self.triangles, is_seam);
        self.is_cut = true;
    }

    /// Returns whether it was cut along given edges.
    pub fn is_cut(&self) -> bool {
        self.is_cut
    }

    /// Permutes the triangles and their corners: triangle `k` begins with halfedge `order[k]`, and each triangle has one halfedge in
    /// `order`. Vertices are renumbered by their first use.
    #[must_use]
    pub fn reordered(&self, order: &[u32]) -> Self {
        let mut number = vec![u32::MAX; self.positions.len()];
        let mut positions = Vec::with_capacity(self.positions.len());
        let mut numbered = |v: u32| {
            if number[v as usize] == u32::MAX {
                number[v as usize] = positions.len() as u32;
                positions.push(self.positions[v as usize]);
            }
            number[v as usize]
        };
        let triangles = order.iter().map(|&h| {
            // Number the vertices alike whatever the winding.
            for h in self.wound_alike(h) {
                numbered(self.begin(h));
            }
            sides(h).map(|h| numbered(origin(&self.triangles, h)))
        });
        Self {
            triangles: triangles.collect(),
            faces: order.iter().map(|&h| self.faces[h as usize / 3]).collect(),
            begins_with: (order.iter())
                .map(|&h| (self.begins_with[h as usize / 3] + (h % 3) as u8) % 3)
                .collect(),
            positions,
            defects: self.defects,
            adjacency: self.adjacency.reordered(order),
            is_cut: self.is_cut,
        }
    }

    /// Returns face and corner in the input of corner `3 t + k`, corner k of triangle t.
    pub fn input_corner(&self, corner: u32) -> [u32; 2] {
        let triangle = corner as usize / 3;
        let k = (u32::from(self.begins_with[triangle]) + corner % 3) % 3;
        [self.faces[triangle], k]
    }

    /// Returns the gluing of triangles.
    pub fn adjacency(&self) -> &Adjacency {
        &self.adjacency
    }

    /// Returns the positions of a triangle's corners.
    pub fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.triangles[triangle].map(|v| self.positions[v as usize])
    }
}

fn validate<T: Copy + Into<f64>>(
    positions: &[[T; 3]],
    triangles: &[[u32; 3]],
) -> Result<(), MeshError> {
    for (face, triangle) in triangles.iter().enumerate() {
        for &vertex in triangle {
            let Some(position) = positions.get(vertex as usize) else {
                return Err(MeshError::IndexOutOfRange {
                    face,
                    vertex,
                    n_vertices: positions.len(),
                });
            };
            if !position.iter().all(|&x| x.into().is_finite()) {
                return Err(MeshError::NonFinitePosition { vertex });
            }
        }
    }
    Ok(())
}

// Welding of equal positions.

/// Returns distinct positions in the order of their first occurrence, and for each input vertex the index of its
/// position.
///
/// Two positions are one if all three coordinates are bit-equal, with −0 counting as 0. There is no tolerance:
/// positions are welded exactly if they are one point in the written file.
pub fn weld(positions: impl ExactSizeIterator<Item = [f64; 3]>) -> (Vec<[f64; 3]>, Vec<u32>) {
    let mut index = HashMap::with_capacity(positions.len());
    let mut distinct = Vec::new();
    let vertex_of = positions
        .map(|p| {
            // Adding zero turns −0 into 0.
            let p = p.map(|x| x + 0.0);
            *index.entry(p.map(f64::to_bits)).or_insert_with(|| {
                distinct.push(p);
                distinct.len() as u32 - 1
            })
        })
        .collect();
    (distinct, vertex_of)
}

// Defects of a triangle list, one check each.

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
    fn of_triangles(
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
    fn count_input(
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

// Canonical order of a surface's triangles, derived from its shape.

/// Direction that decides where an order begins among places that the shape does not tell apart, in coordinates along the
/// principal axes.
const BEGINNING: [f64; 3] = [1.0, 0.37, 0.61];

/// Most triangles that are compared to tell places apart, over the number of triangles. On a surface that is its own image under many
/// motions places stay alike to the end, and any of them will do. Not tuned.
const COMPARED: usize = 8;

/// Returns the triangles of a surface in canonical order, each as the halfedge that it begins with: independent of the order of
/// triangles, their corners and vertices in the input, and of translation, rotation and scale, up to symmetry. Lengths count
/// [rounded](tied), so that rounding decides nothing where shapes are alike.
///
/// The piece with the most triangles comes first, the largest among equals. In each piece the triangles are traversed breadth first, from a
/// halfedge that its shape singles out.
pub fn canonical_order(surface: &Surface) -> Vec<u32> {
    let mut walk = Walk::new(surface);
    let mut order = Vec::with_capacity(surface.triangles.len());
    for first in beginnings(surface) {
        walk.begin(first);
        order.extend(walk.by_ref());
    }
    order
}

/// Breadth-first walk over the triangles of a piece.
struct Walk<'a> {
    surface: &'a Surface,
    /// For each triangle the last walk that reached it.
    reached: Vec<u32>,
    number: u32,
    open: VecDeque<u32>,
}

impl<'a> Walk<'a> {
    fn new(surface: &'a Surface) -> Self {
        Self {
            surface,
            reached: vec![0; surface.triangles.len()],
            number: 0,
            open: VecDeque::new(),
        }
    }

    /// Begins a new walk at a halfedge.
    fn begin(&mut self, first: u32) {
        self.number += 1;
        self.open.clear();
        self.reached[first as usize / 3] = self.number;
        self.open.push_back(first);
    }
}

impl Iterator for Walk<'_> {
    type Item = u32;

    /// Returns the next triangle as the halfedge across which it was reached.
    fn next(&mut self) -> Option<u32> {
        let h = self.open.pop_front()?;
        for t in (self.surface.wound_alike(h)).map(|h| self.surface.adjacency.twin[h as usize]) {
            if t != CUT && self.reached[t as usize / 3] != self.number {
                self.reached[t as usize / 3] = self.number;
                self.open.push_back(t);
            }
        }
        Some(h)
    }
}

/// Returns the halfedges of a triangle, from one of them on.
fn sides(h: u32) -> [u32; 3] {
    [h, next(h), next(next(h))]
}

impl Surface {
    /// Returns the halfedges of a triangle from one of them on, in the winding that its piece has in common.
    fn wound_alike(&self, h: u32) -> [u32; 3] {
        let [h, next, last] = sides(h);
        if self.adjacency.turned[h as usize / 3] {
            [h, last, next]
        } else {
            [h, next, last]
        }
    }

    fn area(&self, triangle: usize) -> f64 {
        let [a, b, c] = self.corners(triangle);
        norm(area_vector(a, b, c)) / 2.0
    }

    /// Returns the vertex at which a halfedge begins in the winding that its piece has in common.
    fn begin(&self, h: u32) -> u32 {
        let is_turned = self.adjacency.turned[h as usize / 3];
        origin(&self.triangles, if is_turned { next(h) } else { h })
    }
}

/// Returns for each piece the halfedge to begin at. It starts as far from the center of the surface as any, and among those of
/// this kind it ends farthest; among these the walk with the longest edges at first begins there.
fn beginnings(surface: &Surface) -> Vec<u32> {
    let unit = total_area(surface).sqrt().max(f64::MIN_POSITIVE);
    let reach = reaches(surface, unit);
    let height = heights(surface);
    let key = |h: u32| (surface.wound_alike(h)).map(|h| reach[surface.begin(h) as usize]);
    let heights = |h: u32| (surface.wound_alike(h)).map(|h| height[surface.begin(h) as usize]);
    let by_key = |a: u32, b: u32| in_order(key(a), key(b));
    let by_height = |a: u32, b: u32| in_order(heights(a), heights(b));
    // Collect the halfedges of each piece whose ends are farthest out.
    let adjacency = surface.adjacency();
    let mut farthest: Vec<Vec<u32>> = vec![Vec::new(); adjacency.n_pieces];
    let mut sizes = vec![(0_u32, 0.0); adjacency.n_pieces];
    for (triangle, &piece) in (0u32..).zip(&adjacency.piece) {
        let (n, area) = &mut sizes[piece as usize];
        *n += 1;
        *area += surface.area(triangle as usize) / (unit * unit);
        let all = &mut farthest[piece as usize];
        for h in sides(3 * triangle) {
            let order = all
                .first()
                .map_or(Ordering::Greater, |&known| by_key(h, known));
            if order.is_gt() {
                all.clear();
            }
            if order.is_ge() {
                all.push(h);
            }
        }
    }
    // Tell them apart by the edges that a walk meets.
    let mut walks = [0, 1].map(|_| Walk::new(surface));
    let mut most = COMPARED * surface.triangles.len();
    let mut pieces: Vec<((u32, f64), u32)> = Vec::with_capacity(farthest.len());
    for (mut all, (n, area)) in farthest.into_iter().zip(sizes) {
        all.sort_by(|&a, &b| by_height(b, a));
        let mut all = all.into_iter();
        let Some(mut first) = all.next() else {
            continue;
        };
        for other in all {
            if is_longer(&mut walks, [other, first], unit, &mut most) {
                first = other;
            }
        }
        pieces.push(((n, tied(area)), first));
    }
    pieces.sort_by(|&((n, area), a), &((m, other), b)| {
        let by_size = m.cmp(&n).then(other.total_cmp(&area));
        by_size.then_with(|| by_key(b, a).then_with(|| by_height(b, a)))
    });
    pieces.into_iter().map(|(_, first)| first).collect()
}

/// Compares numbers, the first ones first.
fn in_order(a: [f64; 3], b: [f64; 3]) -> Ordering {
    let each = a.iter().zip(&b).map(|(a, b)| a.total_cmp(b));
    each.fold(Ordering::Equal, Ordering::then)
}

/// Returns whether the first triangle that differs is larger on a walk from one halfedge than on one from another; compares at most
/// `most` triangles, from which it takes those that it compared.
fn is_longer(walks: &mut [Walk; 2], begins: [u32; 2], unit: f64, most: &mut usize) -> bool {
    let surface = walks[0].surface;
    let lengths = |h: u32| {
        surface.wound_alike(h).map(|h| {
            let [a, b] = surface.ends(h).map(|v| surface.positions[v as usize]);
            tied(distance(a, b) / unit)
        })
    };
    let [one, other] = walks;
    one.begin(begins[0]);
    other.begin(begins[1]);
    for (a, b) in one.zip(other) {
        if *most == 0 {
            return false;
        }
        *most -= 1;
        let (a, b) = (lengths(a), lengths(b));
        if a != b {
            return a > b;
        }
    }
    false
}

/// Returns the distance of each vertex from the center of the surface's area over a unit, [rounded](tied).
fn reaches(surface: &Surface, unit: f64) -> Vec<f64> {
    let mut center = [0.0; 3];
    for triangle in 0..surface.triangles.len() {
        let share = surface.area(triangle) / (unit * unit);
        for p in surface.corners(triangle) {
            center = add_scaled(center, share / 3.0, p);
        }
    }
    let positions = surface.positions.iter();
    positions
        .map(|&p| tied(distance(p, center) / unit))
        .collect()
}

fn total_area(surface: &Surface) -> f64 {
    let triangles = 0..surface.triangles.len();
    triangles.map(|triangle| surface.area(triangle)).sum()
}

/// Returns the coordinate of each vertex along [`BEGINNING`].
fn heights(surface: &Surface) -> Vec<f64> {
    let corners = surface.triangles.as_flattened();
    let PrincipalAxes {
        center,
        mut axes,
        skew,
    } = PrincipalAxes::of(corners.iter().map(|&v: &u32| surface.positions[v as usize]));
    // Where a surface is its own mirror image, one axis is known but for its sign.
    if dot(cross(axes[0], axes[1]), axes[2]) < 0.0
        && let Some(unsure) = (0..3).min_by(|&a, &b| skew[a].total_cmp(&skew[b]))
    {
        axes[unsure] = axes[unsure].map(|x| -x);
    }
    let beginning = (0..3).fold([0.0; 3], |sum, k| add_scaled(sum, BEGINNING[k], axes[k]));
    let positions = surface.positions.iter();
    positions.map(|&p| dot(sub(p, center), beginning)).collect()
}

// Smoothing of noisy vertex positions.

/// Number of smoothing passes. Together they remove noise a few edges wide and preserve the shape.
const PASSES: usize = 10;
/// Steps toward the mean of the neighbors and back, per pass: Taubin's λ and μ, which keep frequencies below the pass
/// band 1/0.5 − 1/0.53 = 0.11.
const STEPS: [f64; 2] = [0.5, -0.53];

impl Surface {
    /// Returns the positions after ten passes of Taubin's λ|μ filter with uniform weights (*A Signal Processing
    /// Approach to Fair Surface Design*, 1995). Vertices of `is_on_border` follow their neighbors along the border.
    /// O(n).
    pub fn smoothed(&self, is_on_border: &[bool]) -> Vec<[f64; 3]> {
        let pulls = self.pulls(is_on_border);
        let mut count = vec![0.0_f64; self.positions.len()];
        for [v, _] in &pulls {
            count[*v as usize] += 1.0;
        }
        let mut positions = self.positions.clone();
        for step in [STEPS; PASSES].into_iter().flatten() {
            let mut sums = vec![[0.0; 3]; positions.len()];
            for [v, neighbor] in pulls.iter().map(|pull| pull.map(|v| v as usize)) {
                for (k, sum) in sums[v].iter_mut().enumerate() {
                    *sum += positions[neighbor][k] - positions[v][k];
                }
            }
            for ((p, sum), count) in positions.iter_mut().zip(sums).zip(&count) {
                for (x, s) in p.iter_mut().zip(sum) {
                    *x += step * s / count.max(1.0);
                }
            }
        }
        positions
    }

    /// Returns for each vertex whether it lies on a border: an edge of one face.
    pub fn is_on_border(&self) -> Vec<bool> {
        let mut is_on_border = vec![false; self.positions.len()];
        for edge in Edges::new(self.positions.len(), &self.triangles).iter() {
            if let [h] = edge {
                for v in self.ends(*h) {
                    is_on_border[v as usize] = true;
                }
            }
        }
        is_on_border
    }

    /// Returns each vertex with each neighbor that it follows.
    fn pulls(&self, is_on_border: &[bool]) -> Vec<[u32; 2]> {
        let mut pulls = Vec::with_capacity(3 * self.triangles.len());
        for edge in Edges::new(self.positions.len(), &self.triangles).iter() {
            let [a, b] = self.ends(edge[0]);
            for [v, neighbor] in [[a, b], [b, a]] {
                if edge.len() == 1 || !is_on_border[v as usize] {
                    pulls.push([v, neighbor]);
                }
            }
        }
        pulls
    }

    fn ends(&self, h: u32) -> [u32; 2] {
        [h, next(h)].map(|h| origin(&self.triangles, h))
    }
}

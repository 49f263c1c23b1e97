//! A mesh with UVs as the judge uses it: welded, with charts and exact orientations.

use crate::mesh::{CornerUvs, VAxis};
use std::cmp::Ordering;
use unwrapd_method::numerics::predicates::orient2d_sign;

/// Tolerance for equal UVs at an edge's ends, as a share of the UV extent: just less than a step of the grid that is
/// written here, 2⁻²³ = 1.2e-7 of a page.
const UV_TOLERANCE: f64 = 1e-7;

/// The topology of a mesh in UV space.
///
/// Faces that cannot be judged (a UV or position that is not finite, an index out of range, no UVs) are marked
/// `unusable`; their UVs are taken as zero, as in `uvmetrics`, so that all arrays are complete.
pub(crate) struct UvTopology {
    /// Positions of the welded vertices.
    pub points: Vec<[f64; 3]>,
    /// Faces over the welded vertices.
    pub faces: Vec<[u32; 3]>,
    pub uvs: Vec<CornerUvs>,
    pub unusable: Vec<bool>,
    /// Smallest and greatest UV.
    pub bounds: [[f64; 2]; 2],
    pub edges: UvEdges,
    pub charts: ChartSets,
    /// Exact sign of every face's UV orientation, as the file winds it.
    pub orientation: Vec<i8>,
}

impl UvTopology {
    pub fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]], uvs: &[CornerUvs]) -> UvTopology {
        // Replace what cannot be judged, so that all arrays are complete.
        let usable: Vec<bool> = (0..triangles.len())
            .map(|f| is_usable(positions, &triangles[f], uvs.get(f)))
            .collect();
        let origin = [0.0; 3];
        let mut finite: Vec<[f64; 3]> = positions
            .iter()
            .map(|p| {
                if p.iter().all(|x| x.is_finite()) {
                    *p
                } else {
                    origin
                }
            })
            .collect();
        if finite.is_empty() {
            finite.push(origin); // what faces without any position refer to
        }
        let weld = weld(&finite);
        let faces: Vec<[u32; 3]> = triangles
            .iter()
            .map(|t| t.map(|i: u32| weld.vertex.get(i as usize).copied().unwrap_or(0)))
            .collect();
        let uvs: Vec<CornerUvs> = (0..triangles.len())
            .map(|f| if usable[f] { uvs[f] } else { [[0.0; 2]; 3] })
            .collect();
        // Charts from edges with equal UVs, and exact orientations.
        let bounds = bounds(&uvs);
        let tolerance = UV_TOLERANCE * extent(bounds);
        let edges = UvEdges::new(&faces, &uvs, weld.points.len(), tolerance);
        let charts = ChartSets::new(faces.len(), links(&edges, &faces, &uvs));
        let orientation = uvs
            .iter()
            .map(|&[a, b, c]| orient2d_sign(a, b, c))
            .collect();
        UvTopology {
            points: weld.points,
            faces,
            uvs,
            unusable: usable.iter().map(|u| !u).collect(),
            bounds,
            edges,
            charts,
            orientation,
        }
    }

    /// Returns the longer side of the UV bounding box, never zero.
    pub fn extent(&self) -> f64 {
        extent(self.bounds)
    }

    /// Returns the halfedge at a corner.
    pub fn halfedge(&self, corner: u32) -> Halfedge {
        halfedge(corner, &self.faces, &self.uvs)
    }

    /// Returns whether a face names one position twice: it can have no area, whatever its UVs.
    pub fn repeats_position(&self, face: usize) -> bool {
        let [a, b, c] = self.faces[face];
        a == b || b == c || c == a
    }

    /// Returns whether a face must have positive area: it can be judged, and has three distinct positions.
    pub fn is_judged(&self, face: usize) -> bool {
        !self.unusable[face] && !self.repeats_position(face)
    }

    /// Returns the orientation of a face after winding has been made consistent in its chart.
    pub fn orientation_in_chart(&self, face: usize) -> i8 {
        self.orientation[face] * self.charts.winding[face]
    }

    /// Returns the unsigned UV area of a face, rounded.
    pub fn area(&self, face: usize) -> f64 {
        let [a, b, c] = self.uvs[face];
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
    }

    /// Returns the charts with most of their UV area seen from behind, in the winding of the file.
    pub fn mirrored_charts(&self, v_axis: VAxis) -> Vec<u32> {
        let mut signed_area = vec![0.0; self.charts.nonorientable.len()];
        for (face, &chart) in self.charts.of_face.iter().enumerate() {
            signed_area[chart as usize] += f64::from(self.orientation[face]) * self.area(face);
        }
        let is_mirrored = |area: &&f64| match v_axis {
            VAxis::Up => **area < 0.0,
            VAxis::Down => **area > 0.0,
        };
        let numbered = (0..).zip(&signed_area);
        let mirrored = numbered.filter(|(_, area)| is_mirrored(area));
        mirrored.map(|(chart, _)| chart).collect()
    }

    /// Returns for each chart the orientation that carries most UV area among the faces for which `counts` holds (on a
    /// tie, that of more faces; 0 if that is a tie too).
    pub fn chart_orientations(&self, counts: impl Fn(usize) -> bool) -> Vec<i8> {
        let mut balance = vec![(0.0_f64, 0_i64); self.charts.nonorientable.len()];
        for face in (0..self.faces.len()).filter(|&f| counts(f)) {
            let sign = self.orientation_in_chart(face);
            let (area, count) = &mut balance[self.charts.of_face[face] as usize];
            *area += f64::from(sign) * self.area(face);
            *count += i64::from(sign);
        }
        let sign = |(area, count): (f64, i64)| {
            if area == 0.0 {
                count.signum() as i8
            } else {
                area.signum() as i8
            }
        };
        balance.into_iter().map(sign).collect()
    }
}

fn is_usable(positions: &[[f64; 3]], triangle: &[u32; 3], uvs: Option<&CornerUvs>) -> bool {
    let finite_position = |&i: &u32| {
        positions
            .get(i as usize)
            .is_some_and(|p| p.iter().all(|x| x.is_finite()))
    };
    uvs.is_some_and(|uvs| uvs.as_flattened().iter().all(|x| x.is_finite()))
        && triangle.iter().all(finite_position)
}

fn bounds(uvs: &[CornerUvs]) -> [[f64; 2]; 2] {
    let first = uvs.first().map_or([0.0; 2], |face| face[0]);
    let mut bounds = [first, first];
    for uv in uvs.as_flattened() {
        for axis in 0..2 {
            bounds[0][axis] = bounds[0][axis].min(uv[axis]);
            bounds[1][axis] = bounds[1][axis].max(uv[axis]);
        }
    }
    bounds
}

fn extent([low, high]: [[f64; 2]; 2]) -> f64 {
    (high[0] - low[0]).max(high[1] - low[1]).max(1e-100)
}

/// Iterates over the pairs of faces that follow each other on one edge with the same UVs.
fn links<'a>(
    edges: &'a UvEdges,
    faces: &'a [[u32; 3]],
    uvs: &'a [CornerUvs],
) -> impl Iterator<Item = EdgeLink> + 'a {
    let pairs = edges
        .order
        .windows(2)
        .zip(&edges.start[edges.start.len().min(1)..]);
    pairs
        .filter(|(_, start)| **start == Start::Same)
        .map(|(pair, _)| {
            let (a, b) = (halfedge(pair[0], faces, uvs), halfedge(pair[1], faces, uvs));
            EdgeLink {
                faces: [a.face, b.face],
                same_direction: a.forward == b.forward,
            }
        })
}

// Charts of UV-connected faces and the winding within them.

/// Two faces that share an edge in UV space.
pub(crate) struct EdgeLink {
    pub faces: [u32; 2],
    /// `true` if both faces run along the edge in the same direction, that is, are wound against each other.
    pub same_direction: bool,
}

/// Components of linked faces.
pub(crate) struct ChartSets {
    /// Chart of every face, numbered in the order of their first faces.
    pub of_face: Vec<u32>,
    /// For each chart, whether its winding contradicts itself (a Möbius strip in one piece).
    pub nonorientable: Vec<bool>,
    /// +1 for faces wound as the first face of their chart, −1 for the others; +1 throughout a nonorientable chart.
    pub winding: Vec<i8>,
}

impl ChartSets {
    pub fn new(n_faces: usize, links: impl Iterator<Item = EdgeLink>) -> ChartSets {
        let mut forest = Forest {
            parent: (0..n_faces as u32).collect(),
            reversed: vec![false; n_faces],
            contradiction: vec![false; n_faces],
        };
        // Join linked faces; a link that contradicts the winding marks its tree.
        for link in links {
            forest.join(&link);
        }
        let mut charts = ChartSets {
            of_face: Vec::with_capacity(n_faces),
            nonorientable: Vec::new(),
            winding: Vec::with_capacity(n_faces),
        };
        // A root is the smallest face of its tree, so it has been numbered before any other face asks.
        for face in 0..n_faces as u32 {
            let (root, reversed) = forest.root(face);
            if root == face {
                charts.of_face.push(charts.nonorientable.len() as u32);
                charts
                    .nonorientable
                    .push(forest.contradiction[face as usize]);
            } else {
                charts.of_face.push(charts.of_face[root as usize]);
            }
            let contradiction = forest.contradiction[root as usize];
            charts
                .winding
                .push(if reversed && !contradiction { -1 } else { 1 });
        }
        charts
    }
}

/// Union–find whose links carry a sign: `true` for a face that is wound against its parent.
struct Forest {
    parent: Vec<u32>,
    reversed: Vec<bool>,
    contradiction: Vec<bool>,
}

impl Forest {
    /// Returns the root of `face` and whether `face` is wound against it; halves the path on the way.
    fn root(&mut self, mut face: u32) -> (u32, bool) {
        let mut against = false;
        loop {
            let f = face as usize;
            let parent = self.parent[f];
            if parent == face {
                return (face, against);
            }
            let p = parent as usize;
            self.reversed[f] ^= self.reversed[p]; // a root is not reversed
            self.parent[f] = self.parent[p];
            against ^= self.reversed[f];
            face = self.parent[f];
        }
    }

    /// Joins the trees of two faces under the smaller root.
    fn join(&mut self, link: &EdgeLink) {
        let (a, against_a) = self.root(link.faces[0]);
        let (b, against_b) = self.root(link.faces[1]);
        let against = against_a ^ against_b ^ link.same_direction;
        let (root, child) = (a.min(b), a.max(b));
        if root == child {
            self.contradiction[root as usize] |= against;
        } else {
            self.parent[child as usize] = root;
            self.reversed[child as usize] = against;
            self.contradiction[root as usize] |= self.contradiction[child as usize];
        }
    }
}

// Welding of equal positions.

/// Welded vertices: equal positions (−0 = 0) share one, numbered in lexicographic order of the coordinates.
pub(super) struct Weld {
    /// Welded vertex of every position.
    pub vertex: Vec<u32>,
    /// Position of every welded vertex.
    pub points: Vec<[f64; 3]>,
}

pub(crate) fn weld(positions: &[[f64; 3]]) -> Weld {
    let mut sorted: Vec<([f64; 3], u32)> = positions
        .iter()
        .map(|p| p.map(|x| x + 0.0))
        .zip(0..)
        .collect(); // −0 + 0 = 0
    sorted.sort_unstable_by(|(a, _), (b, _)| {
        a[0].total_cmp(&b[0])
            .then_with(|| a[1].total_cmp(&b[1]))
            .then_with(|| a[2].total_cmp(&b[2]))
    });
    let mut vertex = vec![0; positions.len()];
    let mut points: Vec<[f64; 3]> = Vec::new();
    for (point, index) in sorted {
        if points.last() != Some(&point) {
            points.push(point);
        }
        vertex[index as usize] = points.len() as u32 - 1;
    }
    Weld { vertex, points }
}

// Faces that meet at an edge, grouped by equal UVs.

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

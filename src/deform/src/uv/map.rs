//! Structure of a UV map: connected corners and the winding of charts.

use crate::problem_error::ProblemError;
use unwrapd_maps::mesh::{
    CornerUvs, Edges, ElementError, UnionFind, next, origin, same_direction, weld,
};
use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::numerics::vec2::doubled_area;

/// A mesh with UVs, one per face corner.
#[derive(Clone, Copy, Debug)]
pub struct UvMesh<'a> {
    /// Positions in space.
    pub positions: &'a [[f64; 3]],
    /// Three vertices per triangle.
    pub triangles: &'a [[u32; 3]],
    /// UVs of each face's corners.
    pub uvs: &'a [CornerUvs],
}

/// Tolerance for equal UVs at an edge's ends, as a share of the map's extent; that of the certificate.
const TOLERANCE: f64 = 1e-7;

/// The faces of a map over welded positions, and its charts: faces connected by edges at which UVs agree.
///
/// Faces with a UV or a position that is missing or not finite are marked and treated as points.
pub(super) struct UvMap {
    /// Distinct positions.
    pub points: Vec<[f64; 3]>,
    /// Indices into `points`.
    pub faces: Vec<[u32; 3]>,
    pub uvs: Vec<CornerUvs>,
    pub unusable: Vec<bool>,
    /// Exact sign of every face's area, as the file winds it.
    pub orientation: Vec<i8>,
    /// Pairs of halfedges `3 * face + c` on one edge whose UVs agree.
    pub joints: Vec<[u32; 2]>,
    /// Chart of every face, numbered in the order of their first faces.
    pub chart: Vec<u32>,
    /// For each chart whether its winding contradicts itself.
    pub nonorientable: Vec<bool>,
    /// +1 for faces that are wound as the first of their chart, −1 for the others; +1 where that contradicts itself.
    pub winding: Vec<i8>,
}

impl UvMap {
    pub fn new(mesh: &UvMesh) -> Self {
        // Replace what is missing or not finite by zeros, so that all arrays are complete.
        let is_finite = |p: &[f64; 3]| p.iter().all(|x| x.is_finite());
        let finite = (mesh.positions.iter()).map(|p| if is_finite(p) { *p } else { [0.0; 3] });
        let (mut points, vertex_of) = weld(finite);
        if points.is_empty() {
            points.push([0.0; 3]); // what faces without any position refer to
        }
        let is_usable = |face: usize| {
            let at = |&v: &u32| mesh.positions.get(v as usize);
            (mesh.uvs.get(face)).is_some_and(|uvs| uvs.as_flattened().iter().all(|x| x.is_finite()))
                && (mesh.triangles[face].iter()).all(|v| at(v).is_some_and(is_finite))
        };
        let unusable: Vec<bool> = (0..mesh.triangles.len()).map(|f| !is_usable(f)).collect();
        let faces: Vec<[u32; 3]> = mesh
            .triangles
            .iter()
            .map(|t| t.map(|v: u32| vertex_of.get(v as usize).copied().unwrap_or(0)))
            .collect();
        let uvs: Vec<CornerUvs> = (unusable.iter().enumerate())
            .map(|(f, &bad)| if bad { [[0.0; 2]; 3] } else { mesh.uvs[f] })
            .collect();
        // Join faces whose UVs agree, and find the charts and their winding.
        let joints = joints(points.len(), &faces, &uvs);
        let charts = Charts::new(&faces, &joints);
        Self {
            orientation: uvs
                .iter()
                .map(|&[a, b, c]| orient2d_sign(a, b, c))
                .collect(),
            points,
            faces,
            uvs,
            unusable,
            joints,
            chart: charts.of_face,
            nonorientable: charts.nonorientable,
            winding: charts.winding,
        }
    }

    /// Returns whether a face names one position twice.
    pub fn repeats_position(&self, face: usize) -> bool {
        let [a, b, c] = self.faces[face];
        a == b || b == c || c == a
    }

    /// Returns the orientation of a face when wound as the first of its chart.
    pub fn orientation_in_chart(&self, face: usize) -> i8 {
        self.orientation[face] * self.winding[face]
    }

    /// Returns for each chart the orientation of most of its area when so wound; that of most faces in case of a tie, 0
    /// if that is a tie, too. Faces that cannot have an area do not count.
    pub fn chart_orientations(&self) -> Vec<i8> {
        let mut sums = vec![(0.0, 0); self.nonorientable.len()];
        for face in 0..self.faces.len() {
            if self.unusable[face] || self.repeats_position(face) {
                continue;
            }
            let (sign, [a, b, c]) = (self.orientation_in_chart(face), self.uvs[face]);
            let (area, count) = &mut sums[self.chart[face] as usize];
            *area += f64::from(sign) * doubled_area(a, b, c).abs();
            *count += i64::from(sign);
        }
        sums.into_iter()
            .map(|(area, count): (f64, i64)| match area {
                0.0 => count.signum() as i8,
                _ => area.signum() as i8,
            })
            .collect()
    }
}

/// Returns the pairs of halfedges that follow each other when those of an edge are sorted by their UVs, and agree.
fn joints(n_points: usize, faces: &[[u32; 3]], uvs: &[CornerUvs]) -> Vec<[u32; 2]> {
    let [low, high] = bounds_of(uvs.as_flattened());
    let tolerance = TOLERANCE * (high[0] - low[0]).max(high[1] - low[1]).max(1e-100);
    let uv = |h: u32| uvs[h as usize / 3][h as usize % 3];
    let ends = |h: u32| {
        let [from, to] = [h, next(h)];
        if origin(faces, from) < origin(faces, to) {
            [uv(from), uv(to)]
        } else {
            [uv(to), uv(from)]
        }
    };
    let mut joints = Vec::new();
    for halfedges in Edges::new(n_points, faces).iter() {
        if origin(faces, halfedges[0]) == origin(faces, next(halfedges[0])) {
            continue;
        }
        let mut sorted: Vec<_> = halfedges.iter().map(|&h| (h, ends(h))).collect();
        // UVs are finite.
        sorted.sort_by(|p, q| p.1.partial_cmp(&q.1).unwrap_or(std::cmp::Ordering::Equal));
        let joined = sorted.windows(2).filter(|pair: &&[(u32, [[f64; 2]; 2])]| {
            let (p, q) = (pair[0].1.as_flattened(), pair[1].1.as_flattened());
            p.iter().zip(q).all(|(x, y)| (x - y).abs() <= tolerance)
        });
        joints.extend(joined.map(|pair| [pair[0].0, pair[1].0]));
    }
    joints
}

struct Charts {
    of_face: Vec<u32>,
    nonorientable: Vec<bool>,
    winding: Vec<i8>,
}

impl Charts {
    /// Computes charts and windings from the two sides of every face: a joint glues the front of a face to the front of
    /// the other, or to its back if they are wound against each other. A chart whose fronts and backs become one has no
    /// winding.
    fn new(faces: &[[u32; 3]], joints: &[[u32; 2]]) -> Self {
        let n_faces = faces.len() as u32;
        let (mut charts, mut sides) =
            (UnionFind::new(faces.len()), UnionFind::new(2 * faces.len()));
        for &[a, b] in joints {
            let is_against = u32::from(same_direction(faces, a, b));
            let [a, b] = [a / 3, b / 3];
            charts.unite(a, b);
            sides.unite(2 * a, 2 * b + is_against);
            sides.unite(2 * a + 1, 2 * b + 1 - is_against);
        }
        let (of_face, n_charts) = charts.labels();
        let mut nonorientable = vec![false; n_charts];
        for face in 0..n_faces {
            if sides.find(2 * face) == sides.find(2 * face + 1) {
                nonorientable[of_face[face as usize] as usize] = true;
            }
        }
        // The smallest side is the front, or the back, of the chart's first face.
        let winding = (0..n_faces)
            .map(|face: u32| sides.find(2 * face).is_multiple_of(2))
            .map(|front| if front { 1 } else { -1 });
        Self {
            winding: winding.collect(),
            of_face,
            nonorientable,
        }
    }
}

// Errors of UV edits.

/// Most anchors: each is compared with every face.
pub(super) const MOST_ANCHORS: usize = 1000;

/// Reason why UVs cannot be edited.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// The file is not a list of anchors.
    #[error("the anchors cannot be parsed: {0}")]
    Malformed(String),
    /// There are no anchors, or too many.
    #[error("there are {0} anchors; 1 to {MOST_ANCHORS} are allowed")]
    HandleCount(usize),
    /// A number of an anchor is not finite or beyond 1e6, or a region has no size or turns too far.
    #[error(
        "anchor {0} must have finite numbers up to 1e6, low below high, a positive weight and enough corners, not both `to` and `by`, and turn by at most 180 degrees"
    )]
    BadTarget(usize),
    /// No vertex lies in a region.
    #[error("anchor {0} holds nothing in its chart")]
    EmptyRegion(usize),
    /// An anchor's vertex has no UV.
    #[error("anchor {0} names a vertex without UVs")]
    UnknownHandle(usize),
    /// An anchor's UV lies outside every chart.
    #[error("anchor {0} lies outside every chart")]
    Outside(usize),
    /// An anchor's vertex has several UVs.
    #[error("anchor {0} names a vertex on a seam; name it by its UV")]
    AmbiguousVertex(usize),
    /// Two anchors pull one vertex or point to different places.
    #[error("anchors {0} and {1} pull the same point to different targets")]
    Contradictory(usize, usize),
    /// An anchor pulls a fixed boundary.
    #[error("anchor {0} moves a vertex of a fixed boundary")]
    OnBoundary(usize),
    /// The present map has a flip in a chart with anchors, and cannot be untangled.
    #[error("face {face} is flipped or degenerate in its chart, and untangling failed")]
    Flipped {
        /// Index of the face.
        face: usize,
    },
    /// The winding of a chart contradicts itself, so no map of it is free of flips.
    #[error("the chart of face {face} is not orientable")]
    Nonorientable {
        /// A face of the chart.
        face: usize,
    },
    /// A chart folds over an edge.
    #[error(transparent)]
    Element(#[from] ElementError),
    /// A number is out of range.
    #[error(transparent)]
    Problem(#[from] ProblemError),
}

impl EditError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Malformed(_) => "malformed_handles",
            Self::HandleCount(_) => "handle_count",
            Self::BadTarget(_) => "bad_target",
            Self::UnknownHandle(_) => "unknown_handle",
            Self::Outside(_) => "handle_outside",
            Self::AmbiguousVertex(_) => "ambiguous_vertex",
            Self::Contradictory(..) => "contradictory_handles",
            Self::EmptyRegion(_) => "empty_region",
            Self::OnBoundary(_) => "anchor_on_boundary",
            Self::Flipped { .. } => "flipped_uvs",
            Self::Nonorientable { .. } => "nonorientable_chart",
            Self::Element(error) => error.code(),
            Self::Problem(error) => error.code(),
        }
    }
}

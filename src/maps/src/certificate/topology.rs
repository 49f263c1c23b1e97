//! A mesh with UVs as the judge uses it: welded, with charts and exact orientations.

use super::charts::{Charts, Link};
use super::edges::{Halfedge, Start, UvEdges, halfedge};
use super::weld::weld;
use crate::mesh::{CornerUvs, VAxis};
use unwrapd_method::numerics::predicates::orient2d_sign;

/// Tolerance for equal UVs at an edge's ends, as a share of the UV extent.
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
    pub charts: Charts,
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
        let vertex = |i: u32| weld.vertex.get(i as usize).copied().unwrap_or(0);
        let faces: Vec<[u32; 3]> = triangles.iter().map(|t| t.map(vertex)).collect();
        let uvs: Vec<CornerUvs> = (0..triangles.len())
            .map(|f| if usable[f] { uvs[f] } else { [[0.0; 2]; 3] })
            .collect();
        // Charts from edges with equal UVs, and exact orientations.
        let bounds = bounds(&uvs);
        let tolerance = UV_TOLERANCE * extent(bounds);
        let edges = UvEdges::new(&faces, &uvs, weld.points.len(), tolerance);
        let charts = Charts::new(faces.len(), links(&edges, &faces, &uvs));
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
) -> impl Iterator<Item = Link> + 'a {
    let pairs = edges
        .order
        .windows(2)
        .zip(&edges.start[edges.start.len().min(1)..]);
    pairs
        .filter(|(_, start)| **start == Start::Same)
        .map(|(pair, _)| {
            let (a, b) = (halfedge(pair[0], faces, uvs), halfedge(pair[1], faces, uvs));
            Link {
                faces: [a.face, b.face],
                same_direction: a.forward == b.forward,
            }
        })
}

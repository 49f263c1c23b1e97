//! Charts of a UV map as maps of the plane.

use super::map::{EditError, UvMap};
use crate::body::{Body, BodyElements, Boundary};
use crate::untangle::{untangled, unwatched};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use unwrapd_maps::embed::rest_shapes;
use unwrapd_maps::mesh::{CornerUvs, UnionFind, UsedVertices, next, origin};
use unwrapd_method::numerics::predicates::orient2d_sign;

/// Shape of a triangle without distortion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum UvRest {
    /// The present UV shape: where nothing pulls, nothing moves.
    #[default]
    Present,
    /// The shape on the surface, scaled so that the chart keeps its area.
    Surface,
}

/// The vertices of a UV map: classes of corners that coincide in space, in UV space and in their chart.
pub(super) struct UvVertices {
    /// Vertex of each corner, `3 * face + c`.
    pub of_corner: Vec<u32>,
    /// First corner of each vertex.
    pub first_corner: Vec<u32>,
}

impl UvVertices {
    /// Unites corners whose UVs agree over an edge, within the tolerance of charts, and corners that agree exactly.
    pub fn new(map: &UvMap) -> Self {
        let mut sets = UnionFind::new(3 * map.faces.len());
        for &[a, b] in &map.joints {
            let (a, b) = (ends(map, a), ends(map, b));
            sets.unite(a[0], b[0]);
            sets.unite(a[1], b[1]);
        }
        let key = |&corner: &u32| {
            let (face, c) = (corner as usize / 3, corner as usize % 3);
            let uv = map.uvs[face][c].map(|x| (x + 0.0).to_bits());
            (map.chart[face], map.faces[face][c], uv)
        };
        let mut corners: Vec<u32> = (0..3 * map.faces.len() as u32).collect();
        corners.sort_by_cached_key(key);
        for pair in corners.windows(2) {
            if key(&pair[0]) == key(&pair[1]) {
                sets.unite(pair[0], pair[1]);
            }
        }
        let (of_corner, n_vertices) = sets.labels();
        let mut first_corner = vec![0; n_vertices];
        for (corner, &vertex) in of_corner.iter().enumerate().rev() {
            first_corner[vertex as usize] = corner as u32;
        }
        Self {
            of_corner,
            first_corner,
        }
    }

    /// Returns the UV of a vertex.
    pub fn uv(&self, map: &UvMap, vertex: u32) -> [f64; 2] {
        let corner = self.first_corner[vertex as usize] as usize;
        map.uvs[corner / 3][corner % 3]
    }

    /// Returns the UVs of these vertices in `uvs`, which are given per corner.
    pub fn places(&self, uvs: &[CornerUvs], vertices: &[u32]) -> Vec<[f64; 2]> {
        let corners = vertices
            .iter()
            .map(|&v: &u32| self.first_corner[v as usize] as usize);
        corners.map(|c| uvs[c / 3][c % 3]).collect()
    }

    /// Returns the UVs of corners with some vertices moved.
    pub fn moved(&self, uvs: &[CornerUvs], to: &BTreeMap<u32, [f64; 2]>) -> Vec<CornerUvs> {
        let mut uvs = uvs.to_vec();
        let corners = uvs.as_flattened_mut().iter_mut();
        for (corner, vertex) in corners.zip(&self.of_corner) {
            if let Some(uv) = to.get(vertex) {
                *corner = *uv;
            }
        }
        uvs
    }

    /// Returns the chart of a vertex.
    pub fn chart(&self, map: &UvMap, vertex: u32) -> u32 {
        map.chart[self.first_corner[vertex as usize] as usize / 3]
    }
}

/// Returns the corners of a halfedge, that at the smaller vertex first.
fn ends(map: &UvMap, h: u32) -> [u32; 2] {
    let mut ends = [h, next(h)];
    ends.sort_by_key(|&corner| origin(&map.faces, corner));
    ends
}

/// A chart, wound so that most of its area is counter-clockwise.
pub(super) struct UvChart {
    /// Faces of the mesh that correspond to the triangles.
    pub faces: ChartFaces,
    /// Vertices of the UV map, in increasing order.
    pub vertices: Vec<u32>,
    /// UVs of the vertices.
    pub uvs: Vec<[f64; 2]>,
    /// Positions of the vertices in space.
    pub positions: Vec<[f64; 3]>,
    /// Triangles, as indices into `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// Triangles that are not counter-clockwise, as given in the file or after joining vertices.
    pub flipped: Vec<u32>,
}

impl UvChart {
    /// Extracts the chart with this number, in which `positive` is the orientation of most of its area. Leaves out
    /// faces that name a position twice and have no area in UV space.
    pub fn new(
        map: &UvMap,
        uv_vertices: &UvVertices,
        chart: u32,
        positive: i8,
    ) -> Result<Self, EditError> {
        // Faces of the chart, turned so that most of the area is counter-clockwise.
        let faces = (0..map.faces.len()).filter(|&f| {
            let is_point = map.repeats_position(f) && map.orientation[f] == 0;
            map.chart[f] == chart && !map.unusable[f] && !is_point
        });
        let faces = ChartFaces {
            faces: faces
                .map(|f| (f as u32, positive * map.winding[f] < 0))
                .collect(),
        };
        if map.nonorientable[chart as usize] {
            let face = faces.faces.first().map_or(0, |face| face.0 as usize);
            return Err(EditError::Nonorientable { face });
        }
        // Triangles over the vertices that they use.
        let mut triangles: Vec<[u32; 3]> = faces
            .corners()
            .map(|c| c.map(|corner: u32| uv_vertices.of_corner[corner as usize]))
            .collect();
        let vertices = UsedVertices::new(triangles.iter().flatten().copied());
        vertices.renumber(triangles.as_flattened_mut());
        let vertices = vertices.into_vec();
        // Positions, UVs and flips.
        let mut chart = Self {
            triangles,
            uvs: vertices
                .iter()
                .map(|&v: &u32| uv_vertices.uv(map, v))
                .collect(),
            positions: vertices
                .iter()
                .map(|&v: &u32| {
                    let corner = uv_vertices.first_corner[v as usize] as usize;
                    map.points[map.faces[corner / 3][corner % 3] as usize]
                })
                .collect(),
            vertices,
            faces,
            flipped: Vec::new(),
        };
        chart.flipped = (0..chart.triangles.len() as u32)
            .filter(|t: &u32| chart.is_flipped(*t as usize, map, positive))
            .collect();
        Ok(chart)
    }

    /// Returns the vertices of the UV map that have moved if the chart's are at `uvs`: all of them if the chart had
    /// flips.
    pub fn moved(
        &self,
        map: &UvMap,
        vertices: &UvVertices,
        uvs: &[[f64; 2]],
    ) -> impl Iterator<Item = (u32, [f64; 2])> {
        let elsewhere = self
            .vertices
            .iter()
            .zip(uvs)
            .filter(|&(&v, uv): &(&u32, &[f64; 2])| {
                !self.flipped.is_empty() || *uv != vertices.uv(map, v)
            });
        elsewhere.map(|(&v, &uv)| (v, uv))
    }

    fn is_flipped(&self, triangle: usize, map: &UvMap, positive: i8) -> bool {
        let [a, b, c] = self.triangles[triangle].map(|v| self.uvs[v as usize]);
        let face = self.faces.faces[triangle].0 as usize;
        map.orientation_in_chart(face) != positive || orient2d_sign(a, b, c) <= 0
    }

    /// Moves vertices around flipped triangles, except those that the boundary holds, until no triangle is flipped.
    /// Fails if no such positions are found.
    pub fn untangle(&mut self, boundary: Boundary) -> Result<(), EditError> {
        let Some(&first) = self.flipped.first() else {
            return Ok(());
        };
        let held = boundary.held(self.uvs.len(), &self.triangles);
        let (body, start, unit) = body(self, UvRest::Surface);
        let moved = (!self
            .triangles
            .iter()
            .any(|[a, b, c]: &[u32; 3]| a == b || b == c || c == a))
        .then(|| untangled(&body, start.as_flattened(), &held, 0.0, &unwatched).ok());
        let Some(moved) = moved.flatten() else {
            let face = self.faces.faces[first as usize].0 as usize;
            return Err(EditError::Flipped { face });
        };
        for ((uv, before), now) in self.uvs.iter_mut().zip(start).zip(moved.as_chunks().0) {
            if before != *now {
                *uv = now.map(|x| x * unit);
            }
        }
        Ok(())
    }
}

/// Faces of a mesh that form a chart, with those marked that must be turned over to be counter-clockwise in UV space.
#[derive(Clone, Debug, Default)]
pub struct ChartFaces {
    faces: Vec<(u32, bool)>,
}

impl ChartFaces {
    /// Returns the number of faces.
    pub fn len(&self) -> usize {
        self.faces.len()
    }

    /// Returns whether there are no faces.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// Returns the first face.
    pub fn first(&self) -> Option<u32> {
        self.faces.first().map(|(face, _)| *face)
    }

    /// Iterates over the corners `3 * face + c` of each face, counter-clockwise.
    pub fn corners(&self) -> impl Iterator<Item = [u32; 3]> {
        self.faces.iter().map(|&(face, is_turned)| {
            let [a, b, c] = [0, 1, 2].map(|c| 3 * face + c);
            if is_turned { [a, c, b] } else { [a, b, c] }
        })
    }
}

/// Returns the chart as a body of mean rest area 1, its present UVs in that unit, and the unit.
pub(super) fn body(chart: &UvChart, rest: UvRest) -> (Body, Vec<[f64; 2]>, f64) {
    let present = || {
        let flat: Vec<[f64; 3]> = chart.uvs.iter().map(|&[u, v]| [u, v, 0.0]).collect();
        rest_shapes(&flat, &chart.triangles)
    };
    let (shapes, unit) = match rest {
        UvRest::Present => {
            let shapes = present();
            let unit = shapes.scale;
            (shapes, unit)
        }
        UvRest::Surface => (
            rest_shapes(&chart.positions, &chart.triangles),
            present().scale,
        ),
    };
    let start: Vec<[f64; 2]> = chart.uvs.iter().map(|p| p.map(|x| x / unit)).collect();
    let body = Body {
        rest: start.as_flattened().to_vec(),
        elements: BodyElements::Triangles {
            corners: chart.triangles.clone(),
            rest: shapes.shapes,
        },
    };
    (body, start, unit)
}

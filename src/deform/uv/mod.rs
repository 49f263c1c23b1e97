//! UV maps edited by anchors.
//!
//! Two uses, one function: [`UvEditOptions::edit`] keeps a map as it is but for what anchors pull (the paper's figure 16),
//! [`UvEditOptions::texture`] aligns points of a surface with points of a texture at the least distortion of the surface (figure
//! 17). They differ in the shapes that are kept and in whether boundaries stay. Either starts from the present UVs and never
//! passes through a flip. Charts with flips are untangled first, with as few vertices moved as it takes.

mod anchors;
mod chart;
mod error;
mod map;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use self::anchors::{Held, Spot, hold};
use self::chart::{UvChart, UvVertices};
use self::map::UvMap;
use crate::deform::body::{Body, BodyElements};
use crate::deform::boundary::Boundary;
use crate::deform::locate::locate;
use crate::deform::problem::Model;
use crate::deform::pull::{Grip, Holds, PullSummary, pull};
use crate::embed::rest_shapes;
use crate::mesh::{CornerUvs, PlanarMesh};
use crate::solver::Watch;

pub use anchors::Anchor;
#[cfg(feature = "files")]
pub use anchors::parse_anchors;
pub use chart::ChartFaces;
pub use error::EditError;

/// Which shape of a triangle is without distortion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum UvRest {
    /// The present UV shape: where nothing pulls, nothing moves.
    #[default]
    Present,
    /// The shape on the surface, scaled so that the chart keeps its area.
    Surface,
}

/// How UVs are edited.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UvEditOptions {
    /// The boundaries.
    pub boundary: Boundary,
    /// The shapes to keep.
    pub rest: UvRest,
    /// What is minimized, for a mean triangle of area 1.
    pub model: Model,
}

impl UvEditOptions {
    /// Keeps the present shapes, boundaries free.
    pub fn edit() -> Self {
        Self::default()
    }

    /// Keeps the shapes of the surface, boundaries fixed.
    pub fn texture() -> Self {
        Self {
            boundary: Boundary::Fixed,
            rest: UvRest::Surface,
            ..Self::default()
        }
    }
}

/// A mesh with UVs, one per face corner.
#[derive(Clone, Copy, Debug)]
pub struct UvMesh<'a> {
    /// Positions in space.
    pub positions: &'a [[f64; 3]],
    /// Three vertices each.
    pub triangles: &'a [[u32; 3]],
    /// The UVs of each face's corners.
    pub uvs: &'a [CornerUvs],
}

/// Edited UVs.
#[derive(Clone, Debug)]
pub struct EditedUvs {
    /// The UVs of each face's corners.
    pub uvs: Vec<CornerUvs>,
    /// The charts that have anchors.
    pub charts: Vec<EditedChart>,
}

/// What happened to a chart.
#[derive(Clone, Debug)]
pub struct EditedChart {
    /// Its number among the charts of the mesh, in the order of their first faces.
    pub chart: u32,
    /// Its faces.
    pub faces: ChartFaces,
    /// How many of them were flipped or empty and had to be untangled first.
    pub untangled: usize,
    /// How it was pulled.
    pub summary: PullSummary,
    /// Its vertices after the pull.
    pub vertices: Vec<[f64; 2]>,
    /// Its triangles over them, counter-clockwise, one for each face.
    pub triangles: Vec<[u32; 3]>,
}

/// Pulls anchors to their targets, every triangle of their charts positive at every iterate. Other charts keep their UVs, bit
/// by bit, and so does every vertex that does not move. A chart with flips is untangled first, and the places that anchors name
/// are those of the map without flips.
///
/// Two faces on a common edge belong to one chart where the UVs of both ends agree to 1e-7 of the
/// map's extent; charts are numbered in the order of their first faces. These are the charts and
/// the numbers of the certificate.
pub fn edit_uvs(
    mesh: &UvMesh,
    anchors: &[Anchor],
    options: &UvEditOptions,
    watch: &dyn Watch,
) -> Result<EditedUvs, EditError> {
    let map = UvMap::new(mesh);
    let vertices = UvVertices::new(&map);
    let mut held: BTreeMap<u32, Vec<Held>> = BTreeMap::new();
    for anchor in hold(mesh, &map, &vertices, anchors)? {
        let chart = match anchor.spot {
            Spot::Vertex(vertex) => vertices.chart(&map, vertex),
            Spot::Place { chart, .. } => chart,
        };
        held.entry(chart).or_default().push(anchor);
    }
    let positive = map.chart_orientations();
    let mut edited = EditedUvs {
        uvs: mesh.uvs.to_vec(),
        charts: Vec::new(),
    };
    let mut moved: BTreeMap<u32, [f64; 2]> = BTreeMap::new();
    for (number, held) in held {
        let mut chart = UvChart::new(&map, &vertices, number, positive[number as usize])?;
        chart.untangle(options.boundary)?;
        let (uvs, summary) = edit_chart(&chart, &held, options, watch)?;
        let before = |v: usize| vertices.uv(&map, chart.vertices[v]);
        let changed = (0..uvs.len()).filter(|&v| !chart.flipped.is_empty() || uvs[v] != before(v));
        moved.extend(changed.map(|v| (chart.vertices[v], uvs[v])));
        edited.charts.push(EditedChart {
            chart: number,
            untangled: chart.flipped.len(),
            faces: chart.faces,
            summary,
            vertices: uvs,
            triangles: chart.triangles,
        });
    }
    let corners = edited.uvs.as_flattened_mut().iter_mut();
    for (corner, vertex) in corners.zip(&vertices.of_corner) {
        if let Some(uv) = moved.get(vertex) {
            *corner = *uv;
        }
    }
    Ok(edited)
}

/// The UVs of a chart's vertices after its anchors were pulled.
fn edit_chart(
    chart: &UvChart,
    held: &[Held],
    options: &UvEditOptions,
    watch: &dyn Watch,
) -> Result<(Vec<[f64; 2]>, PullSummary), EditError> {
    PlanarMesh::new(chart.uvs.clone(), chart.triangles.clone())?;
    let (body, start, unit) = body(chart, options.rest);
    let mut holds = Holds::new(options.boundary.held(chart.uvs.len(), &chart.triangles));
    // The targets of vertices as the caller has them.
    let mut targets = Vec::with_capacity(held.len());
    for anchor in held {
        targets.extend(take_hold(&mut holds, chart, (&body, unit), anchor)?);
    }
    let result = pull(body, &start, &holds, (&options.model, unit), watch)?;
    // What did not move, and what arrived, is not rounded.
    let uv = |v: usize| {
        if result.vertices[v] == start[v] {
            chart.uvs[v]
        } else {
            result.vertices[v].map(|x| x * unit)
        }
    };
    let mut uvs: Vec<[f64; 2]> = (0..start.len()).map(uv).collect();
    for (to, &(v, target)) in targets.iter().zip(&holds.pulled) {
        if result.vertices[v as usize] == target {
            uvs[v as usize] = *to;
        }
    }
    Ok((uvs, result.summary))
}

/// Adds an anchor; the target of the vertex that it pulls, if it pulls one.
fn take_hold(
    holds: &mut Holds,
    chart: &UvChart,
    (body, unit): (&Body, f64),
    &Held { anchor, spot, to }: &Held,
) -> Result<Option<[f64; 2]>, EditError> {
    let unknown = EditError::UnknownHandle(anchor);
    let (at, grip) = match spot {
        Spot::Vertex(vertex) => {
            // The vertex of a face left out of its chart is not there.
            let local = chart.vertices.binary_search(&vertex);
            let local = local.map_err(|_| unknown)?;
            (chart.uvs[local], holds.grip(vec![(local as u32, 1.0)]))
        }
        Spot::Place { at, .. } => {
            let row = locate(body, at.map(|x| x / unit)).ok_or(unknown)?;
            (at, holds.grip(row))
        }
    };
    match grip {
        Grip::Fixed if at == to => Ok(None),
        Grip::Fixed => Err(EditError::OnBoundary(anchor)),
        Grip::Vertex(vertex) => {
            let place = chart.uvs[vertex as usize];
            let to = [0, 1].map(|k| to[k] + (place[k] - at[k]));
            holds.pulled.push((vertex, to.map(|x| x / unit)));
            Ok(Some(to))
        }
        Grip::Point(row) => {
            holds.points.push((row, to.map(|x| x / unit)));
            Ok(None)
        }
    }
}

/// The chart as a body of mean rest area 1, its present UVs in that unit, and the unit.
fn body(chart: &UvChart, rest: UvRest) -> (Body, Vec<[f64; 2]>, f64) {
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

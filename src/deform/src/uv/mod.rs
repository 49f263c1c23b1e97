//! UV maps edited by anchors.
//!
//! Two uses, one function: [`UvEditOptions::edit`] keeps a map as it is but for what anchors pull (the paper's figure 16),
//! [`UvEditOptions::texture`] aligns points of a surface with points of a texture at the least distortion of the surface (figure
//! 17). They differ in the shapes that are kept and in whether boundaries stay. Either starts from the present UVs and never
//! passes through a flip. Charts with flips are untangled first, with as few vertices moved as it takes.

mod anchors;
mod chart;
mod error;
mod flat_chart;
mod map;
mod remembered;
mod seen;
mod session;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use self::anchors::{Held, Spot, hold};
use self::chart::{UvChart, UvVertices};
use self::flat_chart::FlatChart;
use self::map::UvMap;
use crate::body::{Body, BodyElements};
use crate::boundary::Boundary;
use crate::problem::Model;
use crate::pull::{How, PullSummary, pull};
use unwrapd_maps::embed::rest_shapes;
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_method::solver::Watch;

pub use anchors::Anchor;
pub use anchors::parse_anchors;
pub use chart::ChartFaces;
pub use error::EditError;
pub use session::{AnchorId, UvSession};

/// Which shape of a triangle is without distortion.
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

/// How UVs are edited.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UvEditOptions {
    /// The boundaries.
    pub boundary: Boundary,
    /// The shapes to keep.
    pub rest: UvRest,
    /// What is minimized, for a mean triangle of area 1.
    pub model: Model,
    /// See [`Problem::search`](crate::Problem::search); sessions do not search.
    pub search: bool,
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
    edit_uvs_from(mesh, None, anchors, options, watch)
}

/// As [`edit_uvs`], but the pull starts where a session left the map: at the UVs `start` of each face's corners. Rest shapes and
/// the places that anchors name are those of the mesh all the same.
pub fn edit_uvs_from(
    mesh: &UvMesh,
    start: Option<&[CornerUvs]>,
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
    let mut charts = Vec::new();
    let mut moved: BTreeMap<u32, [f64; 2]> = BTreeMap::new();
    for (number, held) in held {
        let mut chart = UvChart::new(&map, &vertices, number, positive[number as usize])?;
        chart.untangle(options.boundary)?;
        let start = start.map(|uvs| vertices.places(uvs, &chart.vertices));
        let (uvs, summary) = edit_chart(&chart, start, &held, options, watch)?;
        moved.extend(chart.moved(&map, &vertices, &uvs));
        charts.push(EditedChart {
            chart: number,
            untangled: chart.flipped.len(),
            faces: chart.faces,
            summary,
            vertices: uvs,
            triangles: chart.triangles,
        });
    }
    Ok(EditedUvs {
        uvs: vertices.moved(mesh.uvs, &moved),
        charts,
    })
}

/// The UVs of a chart's vertices after its anchors were pulled.
fn edit_chart(
    chart: &UvChart,
    start: Option<Vec<[f64; 2]>>,
    held: &[Held],
    options: &UvEditOptions,
    watch: &dyn Watch,
) -> Result<(Vec<[f64; 2]>, PullSummary), EditError> {
    let flat = FlatChart::new(chart, options.rest)?;
    let grips = flat.grips(chart, held, options.boundary)?;
    let (body, unit) = (flat.body.clone(), flat.unit);
    let start = start.map(|uvs| uvs.iter().map(|uv| uv.map(|x| x / unit)).collect());
    let start: &Vec<[f64; 2]> = start.as_ref().unwrap_or(&flat.start);
    let how = How {
        model: &options.model,
        search: options.search,
        unit,
    };
    let result = pull(body, start, &grips.holds, &how, watch)?;
    Ok((flat.uvs(chart, &grips, &result.vertices), result.summary))
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

//! Edits of UVs: charts with anchors are untangled and pulled.

use super::anchors::{Anchor, FlatChart, Held, hold};
use super::chart::{ChartFaces, UvChart, UvRest, UvVertices};
use super::map::{EditError, UvMap, UvMesh};
use crate::body::Boundary;
use crate::problem::Model;
use crate::pull::{How, PullSummary, pull};
use std::collections::BTreeMap;
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_method::solver::Watch;

/// Settings of a UV edit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UvEditOptions {
    /// Treatment of boundaries.
    pub boundary: Boundary,
    /// Rest shapes.
    pub rest: UvRest,
    /// Energy and barrier, for a mean triangle of area 1.
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

/// Edited UVs.
#[derive(Clone, Debug)]
pub struct EditedUvs {
    /// UVs of each face's corners.
    pub uvs: Vec<CornerUvs>,
    /// Charts that have anchors.
    pub charts: Vec<EditedChart>,
}

/// Result for one chart.
#[derive(Clone, Debug)]
pub struct EditedChart {
    /// Number among the charts of the mesh, in the order of their first faces.
    pub chart: u32,
    /// Faces of the chart.
    pub faces: ChartFaces,
    /// Number of faces that were flipped or empty and had to be untangled first.
    pub untangled: usize,
    /// Summary of the pull.
    pub summary: PullSummary,
    /// Vertices after the pull.
    pub vertices: Vec<[f64; 2]>,
    /// Triangles over the vertices, counter-clockwise, one for each face.
    pub triangles: Vec<[u32; 3]>,
}

/// Pulls anchors to their targets; every triangle of their charts is positive at every iterate. Other charts and all
/// vertices that do not move keep their UVs bit for bit. A chart with flips is untangled first, and the places that
/// anchors name are then those of the untangled map.
///
/// Two faces with a common edge belong to one chart if the UVs of both ends agree to 1e-7 of the map's extent; charts
/// are numbered in the order of their first faces. These are the charts and the numbers of the certificate.
pub fn edit_uvs(
    mesh: &UvMesh,
    anchors: &[Anchor],
    options: &UvEditOptions,
    watch: &dyn Watch,
) -> Result<EditedUvs, EditError> {
    edit_uvs_from(mesh, None, anchors, options, watch)
}

/// Like [`edit_uvs`], but the pull starts where a session left the map: at the UVs `start` of each face's corners. Rest
/// shapes and the places that anchors name are still those of the mesh.
pub fn edit_uvs_from(
    mesh: &UvMesh,
    start: Option<&[CornerUvs]>,
    anchors: &[Anchor],
    options: &UvEditOptions,
    watch: &dyn Watch,
) -> Result<EditedUvs, EditError> {
    let map = UvMap::new(mesh);
    let vertices = UvVertices::new(&map);
    // Group the anchors by chart.
    let mut held: BTreeMap<u32, Vec<Held>> = BTreeMap::new();
    for anchor in hold(mesh, &map, &vertices, anchors)? {
        let chart = anchor.spot.chart(&map, &vertices);
        held.entry(chart).or_default().push(anchor);
    }
    // Untangle and pull each of these charts.
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

/// Returns the UVs of a chart's vertices after its anchors were pulled, and a summary.
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

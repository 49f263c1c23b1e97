//! Pictures of a result, drawn on request from the written bytes: immediately, or later from the stored files.

use super::input::{Mapped, Merged, Prepared};
use crate::PipelineError;
use crate::arrays::plan::Plan;
use crate::arrays::unwrap::in_pool;
use crate::judge::group_uvs::GroupUvs;
use crate::judge::groups::WrittenUvs;
use crate::judge::rules::intended_weights;
use crate::options::{CommandOptions, Options, Workers};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use unwrapd_files::document::{Document, GroupBy, Upload};
use unwrapd_files::picture::{HeatmapMeasure, Panel, heatmap_png, layout_png};
use unwrapd_maps::certificate::chart_ids;
use unwrapd_maps::measure::{FaceDistortion, face_distortion};
use unwrapd_maps::mesh::{CornerUvs, Resolution};

/// Side of a picture in pixels.
const SIDE: u32 = 1024;

/// Source of the pictures of a result.
#[derive(Clone, Debug)]
pub struct Pictures {
    pub(crate) uvs: WrittenUvs,
    pub(crate) texture: Resolution,
    pub(crate) shown: HeatmapMeasure,
    pub(crate) workers: Workers,
}

/// A picture of an atlas, oriented like the texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum AtlasPicture {
    /// The charts.
    Layout,
    /// The distortion.
    Heatmap,
}

/// Part of a report that determines how its result is drawn.
#[derive(Deserialize)]
pub struct ReportOfAtlas {
    options: Options,
    written: DrawnNotes,
}

#[derive(Deserialize)]
struct DrawnNotes {
    primitives: Vec<DrawnNote>,
}

#[derive(Deserialize)]
struct DrawnNote {
    mesh: usize,
    primitive: usize,
    texcoord: u32,
}

impl Pictures {
    /// Rebuilds the source of a stored result's pictures, equal to that of the computation that made it. `report` is
    /// part of its report. `input` is its input, which only a heat map with material weights needs.
    ///
    /// # Errors
    /// Fails if a file cannot be read, or does not match the report.
    pub fn of_result(
        result: &Upload,
        report: ReportOfAtlas,
        input: Option<&Upload>,
        threads: usize,
    ) -> Result<Self, PipelineError> {
        let mut options = report.options;
        options.caller_mut().limits.threads = Some(threads);
        let group_by = options.group_by.unwrap_or(GroupBy::Scene);
        let sets = report.written.primitives.iter();
        let sets = sets.map(|note| ([note.mesh, note.primitive], note.texcoord));
        let document = Document::read(result)?;
        let mut uvs = WrittenUvs::of_sets(&document, group_by, options.nodes(), &sets.collect())?;
        if options.layout.stack_offset {
            uvs.fold();
        }
        let has_densities = !options.texel_weight.is_empty() || !options.control.control.is_empty();
        if let Some(input) = input.filter(|_| has_densities) {
            add_weights(&mut uvs, input, &options)?;
        }
        Ok(Self {
            uvs,
            texture: options.layout.resolution,
            shown: options.heatmap_measure,
            workers: options.settings().workers,
        })
    }

    /// Draws one picture as PNG. For a mesh of a few thousand faces this takes longer than unwrapping it.
    ///
    /// # Errors
    /// Fails if no thread can be started.
    pub fn draw(&self, picture: AtlasPicture) -> Result<Vec<u8>, PipelineError> {
        in_pool(self.workers, || {
            let texture = self.texture;
            let [width, _] = texture.sides();
            let groups = self.uvs.groups.iter();
            let pages: Vec<PictureFaces> = groups
                .flat_map(|group| PictureFaces::new(group, texture).pages(width))
                .collect();
            let panels: Vec<Panel> = pages.iter().map(PictureFaces::panel).collect();
            match picture {
                AtlasPicture::Layout => layout_png(&panels, SIDE, self.uvs.v_axis),
                AtlasPicture::Heatmap => heatmap_png(&panels, self.shown, SIDE, self.uvs.v_axis),
            }
        })
    }
}

/// Returns the label of an atlas, or its name if the font of pictures cannot spell the label.
fn title(group: &GroupUvs) -> String {
    let is_spelt = group.label.is_ascii();
    if is_spelt { &group.label } else { &group.name }.clone()
}

/// Adds the intended texel density of each face of each group of a document.
fn add_weights(
    uvs: &mut WrittenUvs,
    input: &Upload,
    options: &Options,
) -> Result<(), PipelineError> {
    let plan = Plan::new(&options.settings())?;
    let prepared = Prepared::read(input, options, &plan)?;
    let document = &prepared.document;
    let primitives = options.nodes().primitives(document)?;
    let Mapped { groups, .. } = Mapped::of(document, &prepared.seams, &plan, prepared.group_by)?;
    for (group, uvs) in groups.iter().zip(&mut uvs.groups) {
        let merged = Merged::with_seams(document, &primitives, group, &prepared.seams, &plan)?;
        uvs.weights = intended_weights(&merged.seams, uvs, &plan);
    }
    Ok(())
}

/// Data of a panel: faces that share a page.
struct PictureFaces {
    name: String,
    uvs: Vec<CornerUvs>,
    charts: Vec<u32>,
    distortion: Vec<FaceDistortion>,
}

impl PictureFaces {
    /// Scales the UVs of a group to the shape of the texture, whose longer side is the unit.
    fn new(group: &GroupUvs, texture: Resolution) -> Self {
        let [u, v] = texture.sides();
        let uvs: Vec<CornerUvs> = group
            .uvs
            .iter()
            .map(|face: &CornerUvs| face.map(|uv| [uv[0] * u, uv[1] * v]))
            .collect();
        Self {
            name: title(group),
            charts: chart_ids(&group.positions, &group.triangles, &uvs),
            distortion: face_distortion(
                &group.positions,
                &group.triangles,
                &uvs,
                group.weights.as_deref(),
            ),
            uvs,
        }
    }

    /// Splits the faces by page, and shifts each page to the first one. A single first page keeps its name.
    fn pages(self, width: f64) -> Vec<Self> {
        let mut lowest = vec![f64::INFINITY; self.uvs.len()];
        for (face, &chart) in self.uvs.iter().zip(&self.charts) {
            let low = &mut lowest[chart as usize];
            *low = face.iter().fold(*low, |low, uv| low.min(uv[0]));
        }
        let page = |chart: u32| (lowest[chart as usize] / width).floor();
        let mut pages: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (face, &chart) in self.charts.iter().enumerate() {
            pages.entry(page(chart) as u32).or_default().push(face);
        }
        if pages.keys().all(|&page| page == 0) {
            return vec![self];
        }
        let on_page = |(page, faces): (u32, Vec<usize>)| Self {
            name: format!("{} {}", self.name, 1001 + page),
            uvs: faces
                .iter()
                .map(|&f| self.uvs[f].map(|[u, v]: [f64; 2]| [u - f64::from(page) * width, v]))
                .collect(),
            charts: faces.iter().map(|&f| self.charts[f]).collect(),
            distortion: faces.iter().map(|&f| self.distortion[f]).collect(),
        };
        pages.into_iter().map(on_page).collect()
    }

    fn panel(&self) -> Panel<'_> {
        Panel {
            name: &self.name,
            uvs: &self.uvs,
            charts: &self.charts,
            distortion: &self.distortion,
        }
    }
}

//! The pictures of a result, drawn from the written bytes when they are asked for: at once, or later from the files that were kept.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::prepared::Prepared;
use super::texel_weight::face_weights;
use crate::PipelineError;
use crate::arrays::plan::Plan;
use crate::arrays::unwrap::in_pool;
use crate::judge::group_uvs::GroupUvs;
use crate::judge::groups::WrittenUvs;
use crate::options::{CommandOptions, Options, Workers};
use unwrapd_files::document::{Document, GroupBy, Upload};
use unwrapd_files::picture::{HeatmapMeasure, Panel, heatmap_png, layout_png};
use unwrapd_maps::certificate::chart_ids;
use unwrapd_maps::measure::{FaceDistortion, face_distortion};
use unwrapd_maps::mesh::{CornerUvs, Resolution};

/// Side of a picture in pixels.
const SIDE: u32 = 1024;

/// What the pictures of a result are drawn from.
#[derive(Clone, Debug)]
pub struct Pictures {
    pub(crate) uvs: WrittenUvs,
    pub(crate) texture: Resolution,
    pub(crate) shown: HeatmapMeasure,
    pub(crate) workers: Workers,
}

/// A picture of an atlas, as the texture lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum AtlasPicture {
    /// The charts.
    Layout,
    /// The distortion.
    Heatmap,
}

/// The part of a report that says how its result is drawn.
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
    texcoord: u32,
}

impl Pictures {
    /// Returns what the pictures of a stored result are drawn from, equal to those of the computation that made it. `report` is part
    /// of its report; `input` is what it was made of, which only a heat map with weights of materials needs.
    ///
    /// # Errors
    /// If a file cannot be read, or is not what the report says.
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
        let sets: Vec<u32> = sets.map(|note| note.texcoord).collect();
        let document = Document::read(result)?;
        let mut uvs = WrittenUvs::of_sets(&document, (group_by, options.nodes()), &sets)?;
        if let Some(input) = input.filter(|_| !options.texel_weight.is_empty()) {
            let weights = weights(input, &options)?;
            for (group, weights) in uvs.groups.iter_mut().zip(weights) {
                group.weights = Some(weights);
            }
        }
        Ok(Self {
            uvs,
            texture: options.layout.resolution,
            shown: options.heatmap_measure,
            workers: options.settings().workers,
        })
    }

    /// Draws one picture. For a mesh of a few thousand faces this takes longer than unwrapping it.
    ///
    /// # Errors
    /// If no thread can be started.
    pub fn draw(&self, picture: AtlasPicture) -> Result<Vec<u8>, PipelineError> {
        in_pool(self.workers, || {
            let texture = self.texture;
            let [width, _] = texture.sides();
            let groups = self.uvs.groups.iter();
            let pages: Vec<Faces> = groups
                .flat_map(|group| Faces::new(group, texture).pages(width))
                .collect();
            let panels: Vec<Panel> = pages.iter().map(Faces::panel).collect();
            match picture {
                AtlasPicture::Layout => layout_png(&panels, SIDE, self.uvs.v_axis),
                AtlasPicture::Heatmap => heatmap_png(&panels, self.shown, SIDE, self.uvs.v_axis),
            }
        })
    }
}

/// The label of an atlas as reports have it, or its name where the letters of pictures do not spell the label.
fn title(group: &GroupUvs) -> String {
    let is_spelt = group.label.is_ascii();
    if is_spelt { &group.label } else { &group.name }.clone()
}

/// The texel density intended for each face of each group of a document.
fn weights(input: &Upload, options: &Options) -> Result<Vec<Vec<f64>>, PipelineError> {
    let prepared = Prepared::read(input, options, &Plan::new(&options.settings()))?;
    let document = &prepared.document;
    let primitives = options.nodes().primitives(document)?;
    let groups = document.groups(prepared.group_by);
    let weighed = |group| face_weights(document, &primitives, group, &options.texel_weight);
    groups.iter().map(weighed).collect()
}

/// What a panel borrows: faces that share a page.
struct Faces {
    name: String,
    uvs: Vec<CornerUvs>,
    charts: Vec<u32>,
    distortion: Vec<FaceDistortion>,
}

impl Faces {
    /// A group as its texels lie: the unit of u and v is the longer side of the texture.
    fn new(group: &GroupUvs, texture: Resolution) -> Self {
        let [u, v] = texture.sides();
        let scaled = |face: &CornerUvs| face.map(|uv| [uv[0] * u, uv[1] * v]);
        let uvs: Vec<CornerUvs> = group.uvs.iter().map(scaled).collect();
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

    /// The same page by page, each as if it were the first; a first one alone keeps its name.
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
        let on_page = |(page, faces): (u32, Vec<usize>)| {
            let shifted = |[u, v]: [f64; 2]| [u - f64::from(page) * width, v];
            Self {
                name: format!("{} {}", self.name, 1001 + page),
                uvs: faces.iter().map(|&f| self.uvs[f].map(shifted)).collect(),
                charts: faces.iter().map(|&f| self.charts[f]).collect(),
                distortion: faces.iter().map(|&f| self.distortion[f]).collect(),
            }
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

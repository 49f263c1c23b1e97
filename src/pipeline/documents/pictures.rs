//! The pictures of a result, drawn from the written bytes when they are asked for.

use std::collections::BTreeMap;

use crate::certificate::chart_ids;
use crate::measure::{FaceDistortion, face_distortion};
use crate::mesh::{CornerUvs, Resolution};
use crate::picture::{HeatmapMeasure, Panel, heatmap_png, layout_png};
use crate::pipeline::PipelineError;
use crate::pipeline::arrays::unwrap::in_pool;
use crate::pipeline::judge::group_uvs::GroupUvs;
use crate::pipeline::judge::groups::WrittenUvs;
use crate::pipeline::options::Workers;

/// Side of a picture in pixels.
const SIDE: u32 = 1024;

/// What the pictures of a result are drawn from.
#[derive(Clone, Debug)]
pub struct Pictures {
    pub(in crate::pipeline) uvs: WrittenUvs,
    pub(in crate::pipeline) texture: Resolution,
    pub(in crate::pipeline) shown: HeatmapMeasure,
    pub(in crate::pipeline) workers: Workers,
}

/// The pictures of a result, as the texture lies.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The UV layout.
    pub layout_png: Vec<u8>,
    /// The distortion.
    pub heatmap_png: Vec<u8>,
}

impl Pictures {
    /// Draws both. For a mesh of a few thousand faces this takes longer than unwrapping it.
    ///
    /// # Errors
    /// If no thread can be started.
    pub fn draw(&self) -> Result<Drawn, PipelineError> {
        in_pool(self.workers, || {
            let texture = self.texture;
            let [width, _] = texture.sides();
            let groups = self.uvs.groups.iter();
            let pages: Vec<Faces> = groups
                .flat_map(|group| Faces::new(group, texture).pages(width))
                .collect();
            let panels: Vec<Panel> = pages.iter().map(Faces::panel).collect();
            let (layout_png, heatmap_png) = rayon::join(
                || layout_png(&panels, SIDE, self.uvs.v_axis),
                || heatmap_png(&panels, self.shown, SIDE, self.uvs.v_axis),
            );
            Drawn {
                layout_png,
                heatmap_png,
            }
        })
    }
}

/// The label of an atlas as reports have it, or its name where the letters of pictures do not spell the label.
fn title(group: &GroupUvs) -> String {
    let is_spelt = group.label.is_ascii();
    if is_spelt { &group.label } else { &group.name }.clone()
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

//! The pictures of a result, drawn from the written bytes when they are asked for.

use super::PipelineError;
use super::arrays::in_pool;
use super::judge::{GroupUvs, WrittenUvs};
use crate::certificate::chart_ids;
use crate::measure::{FaceDistortion, face_distortion};
use crate::picture::{HeatmapMeasure, Panel, heatmap_png, layout_png};

/// Side of a picture in pixels.
const SIDE: u32 = 1024;

/// What the pictures of a result are drawn from.
#[derive(Clone, Debug)]
pub struct Pictures {
    pub(super) uvs: WrittenUvs,
    pub(super) shown: HeatmapMeasure,
    pub(super) threads: Option<usize>,
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
        in_pool(self.threads, || {
            let groups: Vec<Faces> = self.uvs.groups.iter().map(Faces::new).collect();
            let panels: Vec<Panel> = groups.iter().map(Faces::panel).collect();
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

/// What a panel borrows.
struct Faces<'a> {
    group: &'a GroupUvs,
    charts: Vec<u32>,
    distortion: Vec<FaceDistortion>,
}

impl<'a> Faces<'a> {
    fn new(group: &'a GroupUvs) -> Self {
        Self {
            group,
            charts: chart_ids(&group.positions, &group.triangles, &group.uvs),
            distortion: face_distortion(&group.positions, &group.triangles, &group.uvs),
        }
    }

    fn panel(&self) -> Panel<'_> {
        Panel {
            name: &self.group.name,
            uvs: &self.group.uvs,
            charts: &self.charts,
            distortion: &self.distortion,
        }
    }
}

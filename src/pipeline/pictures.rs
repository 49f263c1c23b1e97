//! The pictures of a result, drawn from the written bytes.

use super::judge::{GroupUvs, WrittenUvs};
use crate::certificate::chart_ids;
use crate::measure::{FaceDistortion, face_distortion};
use crate::picture::{HeatmapMeasure, Panel, heatmap_png, layout_png};

/// Side of a picture in pixels.
const SIDE: u32 = 1024;

/// The layout and the heat map.
pub(super) fn draw(uvs: &WrittenUvs, shown: HeatmapMeasure) -> (Vec<u8>, Vec<u8>) {
    let drawn: Vec<Drawn> = uvs.groups.iter().map(Drawn::new).collect();
    let panels: Vec<Panel> = drawn.iter().map(Drawn::panel).collect();
    rayon::join(
        || layout_png(&panels, SIDE, uvs.v_axis),
        || heatmap_png(&panels, shown, SIDE, uvs.v_axis),
    )
}

/// What a panel borrows.
struct Drawn<'a> {
    group: &'a GroupUvs,
    charts: Vec<u32>,
    distortion: Vec<FaceDistortion>,
}

impl<'a> Drawn<'a> {
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

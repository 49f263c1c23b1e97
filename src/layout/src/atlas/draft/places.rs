//! Layouts in other terms: places and angles, a plan, grid units.
use super::Draft;
use crate::atlas::arrangement::Arrangement;
use crate::atlas::layout::Layout;
use crate::atlas::outline::Outline;
use crate::atlas::plan::{Near, Plan, QuarterTurns};
use crate::atlas::poses::Poses;
use crate::atlas::squeeze::{Pose, Squeezed};
use crate::atlas::tight::{self, Page};
use crate::atlas::{AtlasOptions, OnRead};

/// Cells of the raster of the last layout for each of those, along a side.
const FINE: f64 = 2.0;

impl Draft {
    /// The arrangement as places and angles, of the pages that have charts.
    pub(super) fn loose(&self) -> Vec<Page> {
        let pose = |&chart: &usize| {
            let (poses, pose) = (&self.poses[chart], self.state.pose[chart]);
            let middle = poses.outline(pose).place(poses.outline(0).middle());
            let [i, j] = middle.map(|x| x * self.raster.scale);
            let [width, height] = poses.mask(pose).size.map(f64::from);
            let within = match Poses::turns(pose) {
                0 => [i, j],
                1 => [width - j, i],
                2 => [width - i, height - j],
                _ => [j, height - i],
            };
            let corner = self.state.corners[chart];
            let middle = [
                f64::from(corner.x) + within[0],
                f64::from(corner.y) + within[1],
            ];
            Pose::new(middle, Poses::angle(pose))
        };
        let page = |number: u32| {
            let is_here = |&&chart: &&usize| self.state.corners[chart].page == number;
            let charts: Vec<usize> = self.by_size.iter().filter(is_here).copied().collect();
            let squeezed = Squeezed {
                poses: charts.iter().map(pose).collect(),
                side: f64::from(self.state.side),
                shape: self.raster.texture.shape(self.raster.padding),
            };
            Page {
                number,
                charts,
                squeezed,
            }
        };
        let pages = (0..self.raster.texture.pages).map(page);
        pages.filter(|page| !page.charts.is_empty()).collect()
    }

    /// Returns the rotated charts and a layout that keeps exactly the padding; `None` if none is found, or if the charts leave no room
    /// for the padding.
    pub(in crate::atlas) fn tight(
        &self,
        options: &AtlasOptions,
        on_read: &OnRead,
    ) -> Option<(Vec<Outline>, Layout)> {
        let longer = f64::from(options.texture.resolution.longer());
        let asked = f64::from(options.packed_texels()) * self.raster.cells() / longer;
        if self.raster.padding < asked {
            return None;
        }
        let refined = |page: &Page| Page {
            squeezed: page.squeezed.refined(FINE),
            ..page.clone()
        };
        let pages: Vec<Page> = self.pages.iter().map(refined).collect();
        let level: Vec<&Outline> = self.level.iter().collect();
        tight::layout(&level, &pages, FINE * self.raster.scale, (options, on_read))
    }

    /// The arrangement as a plan for a fine raster.
    pub(in crate::atlas) fn plan(&self) -> Plan {
        let Arrangement {
            order,
            pose,
            corners,
            side,
            cost,
        } = &self.state;
        let share = |cells: u32| f64::from(cells.saturating_sub(1)) / f64::from(*side.max(&1));
        let posed = self.level.iter().zip(pose);
        let angle = |pose: usize| Poses::angle(pose - pose % 4);
        Plan {
            outlines: posed
                .map(|(level, &pose)| level.rotated(angle(pose)))
                .collect(),
            turns: pose
                .iter()
                .map(|&pose| QuarterTurns::Only(Poses::turns(pose)))
                .collect(),
            order: order.clone(),
            near: Some(Near {
                corners: (corners.iter())
                    .map(|corner| (corner.page, [corner.x, corner.y].map(share)))
                    .collect(),
                window: 3.0 / f64::from(*side.max(&1)),
                extent: (cost + self.raster.padding) / self.raster.scale,
            }),
        }
    }
}

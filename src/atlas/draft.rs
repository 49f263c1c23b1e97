//! A layout on a coarse raster, which becomes fuller as long as one likes.
use rayon::prelude::*;
use std::sync::Arc;

use super::arrangement::Arrangement;
use super::layout::padding;
use super::mask::Distances;
use super::outline::{Outline, outlines};
use super::plan::{Near, Plan, QuarterTurns, by_size, level};
use super::poses::Poses;
use super::sheet::Sheet;
use super::spot::Corner;
use super::texture::{Form, Texture};
use super::{AtlasError, AtlasOptions, ChartMap, Turns};
use crate::numerics::random::Random;

/// Cells along the side of the square page that the charts are expected to need. With 128 a cell is too much for the gaps that
/// matter; with 512 a trial costs four times as much, and less is found in the same time.
const RASTER: u32 = 256;
/// The share of that page that they are expected to fill.
const HOPE: f64 = 0.75;
/// Sides of squares in which all charts are first placed.
const SIDES: [u32; 3] = [RASTER, 2 * RASTER, 4 * RASTER];
/// Charts at most: of more the large ones leave room enough for the small ones.
const MOST_CHARTS: usize = 128;
/// Charts from which on a search reads all the words it may.
const MANY: u64 = 8;
/// Searches from different seeds.
const SEEDS: usize = 4;
/// Larger squares that a search accepts at its begin and at its end: about half a cell and a tenth of one.
const TEMPERATURES: [f64; 2] = [0.65, 0.13];
/// What a trial costs for each chart beside the words it reads.
const WORDS_PER_CHART: u64 = 1000;

/// A layout on a coarse raster.
///
/// It follows from an order of the charts and a pose of each: every chart is placed where the used square grows least. Simulated
/// annealing changes the one or the other and keeps what makes the square smaller, at first also what makes it a little larger.
/// What that costs is counted in words read, so the result is the same on every machine and for any number of threads.
#[derive(Clone)]
pub struct Draft {
    poses: Vec<Arc<Poses>>,
    raster: Raster,
    state: Arrangement,
}

/// How charts become cells.
#[derive(Clone, Copy)]
struct Raster {
    /// Cells per mesh unit.
    scale: f64,
    /// Cells kept free between charts.
    padding: f64,
    texture: Texture,
}

impl Draft {
    /// The charts in the order of their sizes; nothing for so many that a search would see only a few layouts, where a needle is
    /// longer than the raster, or where charts may not be turned by any angle.
    pub fn new(charts: &[ChartMap], options: &AtlasOptions) -> Result<Option<Self>, AtlasError> {
        let outlines = outlines(charts)?;
        if outlines.len() > MOST_CHARTS || options.turns == Turns::Quarters {
            return Ok(None);
        }
        Ok(Self::of(&Plan::largest_first(&outlines, options), options))
    }

    fn of(plan: &Plan, options: &AtlasOptions) -> Option<Self> {
        let area = plan.area().max(f64::MIN_POSITIVE);
        let texture = options.texture;
        let cells = f64::from(texture.raster(RASTER));
        let raster = Raster {
            scale: cells * (HOPE * texture.share() * f64::from(texture.pages) / area).sqrt(),
            padding: padding(options, plan.order.len(), cells),
            texture,
        };
        let extents = plan.order.iter().flat_map(|&i| plan.outlines[i].extent);
        let longest = extents.fold(0.0, f64::max) * raster.scale;
        if longest > f64::from(texture.raster(SIDES[2])) {
            return None;
        }
        let poses = plan.outlines.iter().map(|o| raster.poses(o)).collect();
        Self::laid_out(poses, raster)
    }

    /// The same with some parts, which come last among the charts, in place of one chart, laid out anew.
    pub fn replaced(&self, chart: usize, parts: &[ChartMap]) -> Result<Option<Self>, AtlasError> {
        let mut poses = self.poses.clone();
        poses.remove(chart);
        let page = HOPE * (self.raster.cells() / self.raster.scale).powi(2);
        let outlines = outlines(parts)?;
        let texture = self.raster.texture;
        let leveled = outlines
            .iter()
            .map(|outline| level(outline, page * texture.share(), texture));
        poses.extend(leveled.map(|outline| self.raster.poses(&outline)));
        Ok(Self::laid_out(poses, self.raster))
    }

    /// All charts placed, the largest first, in a square as large as that takes within reason.
    fn laid_out(poses: Vec<Arc<Poses>>, raster: Raster) -> Option<Self> {
        let level: Vec<&Outline> = poses.iter().map(|poses| poses.outline(0)).collect();
        let mut state = Arrangement {
            order: by_size(&level),
            pose: vec![0; poses.len()],
            corners: vec![Corner::default(); poses.len()],
            side: 0,
            cost: f64::INFINITY,
        };
        SIDES.into_iter().find_map(|side| {
            let largest = raster.texture.raster(side);
            let mut sheet = raster.sheet(largest);
            state.lay_out(&poses, &mut sheet, 0, largest)
        })?;
        Some(Self {
            poses,
            raster,
            state,
        })
    }

    /// The share of the square that is filled, less what whole cells of the coarse raster lose.
    pub fn fill(&self) -> f64 {
        let ratio = self.raster.cells() / (self.state.cost + self.raster.padding);
        HOPE * ratio * ratio
    }

    /// The drafts that several searches make of this one, together reading about so many words; the best first.
    pub(super) fn searched(&self, words: u64) -> Vec<Self> {
        let seeds = (0..SEEDS).into_par_iter().with_max_len(1);
        let mut drafts: Vec<Self> = seeds
            .map(|seed| {
                let mut draft = self.clone();
                draft.improve(words / SEEDS as u64, seed as u64);
                draft
            })
            .collect();
        drafts.sort_by(|a, b| a.state.cost.total_cmp(&b.state.cost));
        drafts
    }

    /// Searches a smaller square; reads about so many words, less of few charts. Never worse than before.
    pub fn improve(&mut self, words: u64, seed: u64) {
        if self.state.order.is_empty() {
            return;
        }
        // A few charts have few layouts.
        let n = (self.poses.len() as u64).min(MANY);
        let words = words * n * n / (MANY * MANY);
        let mut random = Random::new(seed);
        let largest = self.state.side + self.state.side / 16;
        let mut sheet = self.raster.sheet(largest);
        let mut state = self.state.clone();
        let [first, last] = TEMPERATURES;
        while sheet.work < words {
            let progress = sheet.work as f64 / words as f64;
            let temperature = first * (last / first).powf(progress);
            let bound = state.cost - temperature * (1.0 - random.unit()).ln();
            let mut trial = state.clone();
            let first = trial.change(&mut random);
            sheet.work += WORDS_PER_CHART * trial.order.len() as u64;
            let fits = trial.lay_out(&self.poses, &mut sheet, first, largest.min(bound as u32));
            if fits.is_some() && trial.cost <= bound {
                state = trial;
                if state.cost < self.state.cost {
                    self.state.clone_from(&state);
                }
            }
        }
    }

    /// As a plan for a fine raster.
    pub(super) fn plan(&self) -> Plan {
        let Arrangement {
            order,
            pose,
            corners,
            side,
            cost,
        } = &self.state;
        let share = |cells: u32| f64::from(cells.saturating_sub(1)) / f64::from(*side.max(&1));
        let posed = || self.poses.iter().zip(pose);
        Plan {
            outlines: posed()
                .map(|(poses, &pose)| poses.outline(pose).clone())
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

impl Raster {
    fn poses(self, outline: &Outline) -> Arc<Poses> {
        let distances = Distances {
            around: 0.0,
            padding: self.padding,
        };
        Arc::new(Poses::new(outline, self.scale, distances))
    }

    /// Cells along the longer side of the page that the charts are expected to need.
    fn cells(self) -> f64 {
        f64::from(self.texture.raster(RASTER))
    }

    fn sheet(self, side: u32) -> Sheet {
        let form = Form::new(self.texture, self.padding / 2.0);
        Sheet::new(form, side, self.padding.ceil() as u32 + 2, 0)
    }
}

//! A layout on a coarse raster, which becomes fuller as long as one likes.
use rayon::prelude::*;
use std::sync::Arc;

use super::arrangement::Arrangement;
use super::layout::{Layout, padding};
use super::mask::Distances;
use super::outline::{Outline, outlines};
use super::plan::{Near, Plan, QuarterTurns, by_size, level};
use super::poses::Poses;
use super::sheet::Sheet;
use super::squeeze::{Body, Pose, Squeezed};
use super::{AtlasError, AtlasOptions, ChartMap, Turns, tight};
use crate::numerics::random::Random;

/// Cells along the side of the square that the charts are expected to need. With 128 a cell is too much for the gaps that
/// matter; with 512 a trial costs four times as much, and less is found in the same time.
const RASTER: u32 = 256;
/// Cells of the finer raster for each of those.
const FINE: f64 = 4.0;
/// The share of that square that they are expected to fill.
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
    /// The same, or what a better state became, when charts made room for each other.
    squeezed: Option<Squeezed>,
}

/// How charts become cells.
#[derive(Clone, Copy)]
struct Raster {
    /// Cells per mesh unit.
    scale: f64,
    /// Cells kept free between charts.
    padding: f64,
}

impl Draft {
    /// The charts in the order of their sizes; nothing for so many that a search would see only a few layouts, where a needle is
    /// longer than the raster, or where charts may not be turned by any angle.
    pub fn new(charts: &[ChartMap], options: &AtlasOptions) -> Result<Option<Self>, AtlasError> {
        let outlines = outlines(charts)?;
        if outlines.len() > MOST_CHARTS || options.turns == Turns::Quarters {
            return Ok(None);
        }
        Ok(Self::of(
            &Plan::largest_first(&outlines, options.turns),
            options,
        ))
    }

    fn of(plan: &Plan, options: &AtlasOptions) -> Option<Self> {
        let area = plan.area().max(f64::MIN_POSITIVE);
        let raster = Raster {
            scale: f64::from(RASTER) * (HOPE / area).sqrt(),
            padding: padding(options, plan.order.len(), f64::from(RASTER)),
        };
        let extents = plan.order.iter().flat_map(|&i| plan.outlines[i].extent);
        let longest = extents.fold(0.0, f64::max) * raster.scale;
        if longest > f64::from(SIDES[2]) {
            return None;
        }
        let poses = plan.outlines.iter().map(|o| raster.poses(o)).collect();
        Self::laid_out(poses, raster)
    }

    /// The same with some parts, which come last among the charts, in place of one chart, laid out anew.
    pub fn replaced(&self, chart: usize, parts: &[ChartMap]) -> Result<Option<Self>, AtlasError> {
        let mut poses = self.poses.clone();
        poses.remove(chart);
        let total = HOPE * (f64::from(RASTER) / self.raster.scale).powi(2);
        let outlines = outlines(parts)?;
        let leveled = outlines.iter().map(|outline| level(outline, total));
        poses.extend(leveled.map(|outline| self.raster.poses(&outline)));
        Ok(Self::laid_out(poses, self.raster))
    }

    /// All charts placed, the largest first, in a square as large as that takes within reason.
    fn laid_out(poses: Vec<Arc<Poses>>, raster: Raster) -> Option<Self> {
        let level: Vec<&Outline> = poses.iter().map(|poses| poses.outline(0)).collect();
        let mut state = Arrangement {
            order: by_size(&level),
            pose: vec![0; poses.len()],
            corners: vec![[0; 2]; poses.len()],
            side: 0,
            cost: f64::INFINITY,
        };
        SIDES.into_iter().find_map(|largest| {
            let mut sheet = raster.sheet(largest);
            state.lay_out(&poses, &mut sheet, 0, largest)
        })?;
        Some(Self {
            poses,
            raster,
            state,
            squeezed: None,
        })
    }

    /// The share of the square that is filled, less what whole cells of the coarse raster lose.
    pub fn fill(&self) -> f64 {
        let ratio = f64::from(RASTER) / (self.side() + self.raster.padding);
        HOPE * ratio * ratio
    }

    /// Side of the square, in cells.
    fn side(&self) -> f64 {
        let squeezed = self.squeezed.as_ref().map(|squeezed| squeezed.side);
        squeezed.unwrap_or(f64::INFINITY).min(self.state.cost)
    }

    /// The layout as places and angles.
    fn loose(&self) -> Squeezed {
        let poses = self
            .poses
            .iter()
            .zip(&self.state.pose)
            .zip(&self.state.corners);
        Squeezed {
            poses: poses
                .map(|((poses, &pose), &corner)| {
                    let middle = poses.outline(pose).place(poses.outline(0).middle());
                    let [i, j] = middle.map(|x| x * self.raster.scale);
                    let [width, height] = poses.mask(pose).size.map(f64::from);
                    let within = match Poses::turns(pose) {
                        0 => [i, j],
                        1 => [width - j, i],
                        2 => [width - i, height - j],
                        _ => [j, height - i],
                    };
                    let middle = [0, 1].map(|k| f64::from(corner[k]) + within[k]);
                    Pose::new(middle, Poses::angle(pose))
                })
                .collect(),
            side: f64::from(self.state.side),
        }
    }

    /// The drafts that several searches make of this one, together reading about so many words; the best first.
    pub(super) fn searched(&self, words: u64) -> Vec<Self> {
        let words = words / SEEDS as u64;
        let seeds = (0..SEEDS).into_par_iter().with_max_len(1);
        let mut drafts: Vec<Self> = seeds
            .map(|seed| {
                let mut draft = self.clone();
                draft.improve(words / 4, seed as u64);
                draft.relocate(words / 4 * 3, seed as u64);
                draft
            })
            .collect();
        drafts.sort_by(|a, b| a.side().total_cmp(&b.side()));
        drafts
    }

    /// Searches a smaller square; reads about so many words, less of few charts. Never worse than before.
    pub fn improve(&mut self, words: u64, seed: u64) {
        if self.state.order.is_empty() {
            return;
        }
        self.anneal(words, &mut Random::new(seed));
        let mut squeezed = self.loose();
        squeezed.settle(&self.bodies());
        if self
            .squeezed
            .as_ref()
            .is_none_or(|best| squeezed.side < best.side)
        {
            self.squeezed = Some(squeezed);
        }
    }

    /// The best arrangement that is found while about so many words are read, or the one of before.
    fn anneal(&mut self, words: u64, random: &mut Random) {
        // A few charts have few layouts.
        let n = (self.poses.len() as u64).min(MANY);
        let words = words * n * n / (MANY * MANY);
        let largest = self.state.side + self.state.side / 16;
        let mut sheet = self.raster.sheet(largest);
        let mut state = self.state.clone();
        let mut best: Option<Arrangement> = None;
        let [first, last] = TEMPERATURES;
        while sheet.work < words {
            let progress = sheet.work as f64 / words as f64;
            let temperature = first * (last / first).powf(progress);
            let bound = state.cost - temperature * (1.0 - random.unit()).ln();
            let mut trial = state.clone();
            let first = trial.change(random);
            sheet.work += WORDS_PER_CHART * trial.order.len() as u64;
            let fits = trial.lay_out(&self.poses, &mut sheet, first, largest.min(bound as u32));
            if fits.is_some() && trial.cost <= bound {
                state = trial;
                if best.as_ref().is_none_or(|best| state.cost < best.cost) {
                    best = Some(state.clone());
                }
            }
        }
        self.state = best.unwrap_or(state);
    }

    /// Lets charts look for other places while about so many words are read.
    fn relocate(&mut self, words: u64, seed: u64) {
        let bodies = self.bodies();
        if let Some(squeezed) = &mut self.squeezed {
            squeezed.search(&bodies, words, seed);
        }
    }

    fn bodies(&self) -> Vec<Arc<Body>> {
        self.poses.iter().map(|poses| poses.body()).collect()
    }

    /// The charts turned, and a layout in which they lie as near to each other as they may; none where that is not found.
    pub(super) fn tight(&self, options: &AtlasOptions) -> Option<(Vec<Outline>, Layout)> {
        let mut squeezed = self.squeezed.clone()?;
        squeezed.scale(FINE);
        let level: Vec<&Outline> = self.poses.iter().map(|poses| poses.outline(0)).collect();
        tight::layout(&level, squeezed, FINE * self.raster.scale, options)
    }

    /// The arrangement as a plan for a fine raster.
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
                corners: corners.iter().map(|corner| corner.map(share)).collect(),
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

    fn sheet(self, side: u32) -> Sheet {
        Sheet::new(side, self.padding.ceil() as u32 + 2, 0)
    }
}

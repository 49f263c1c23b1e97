//! A layout on a coarse raster, which becomes fuller as long as one likes.
mod places;
mod search;

use std::sync::Arc;

use super::arrangement::Arrangement;
use super::layout::padding;
use super::mask::Distances;
use super::outline::{Outline, outlines};
use super::plan::{HOPE, Plan, by_size, level};
use super::poses::Poses;
use super::sheet::Sheet;
use super::spot::Corner;
use super::texture::{Form, Texture};
use super::tight::Page;
use super::{AtlasError, AtlasOptions, ChartMap, Turns};

/// Cells along the side of the square page that the charts are expected to need. With 128 a cell is too much for the gaps that
/// matter; with 512 a trial costs four times as much, and less is found in the same time.
const RASTER: u32 = 256;
/// Sides of squares in which all charts are first placed.
const SIDES: [u32; 3] = [RASTER, 2 * RASTER, 4 * RASTER];
/// Charts at most: of more the large ones leave room enough for the small ones.
const MOST_CHARTS: usize = 128;
/// Words that may be read at least: fewer are not worth the preparations.
const LEAST_WORDS: u64 = 20_000_000;

/// A layout on a coarse raster.
///
/// It follows from an order of the charts and a pose of each: every chart is placed where the used square grows least. Simulated
/// annealing changes the one or the other and keeps what makes the square smaller, at first also what makes it a little larger.
/// What comes of that is squeezed, charts moving and turning all at once.
/// What that costs is counted in words read, so the result is the same on every machine and for any number of threads.
#[derive(Clone)]
pub struct Draft {
    poses: Vec<Arc<Poses>>,
    raster: Raster,
    state: Arrangement,
    /// What that or a better one became when charts made room for each other, on square pages; none before the first search.
    pages: Vec<Page>,
    /// The charts in the order of their sizes.
    by_size: Vec<usize>,
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
    /// The charts in the order of their sizes; nothing for so many, or so few words, that a search would see only a few layouts,
    /// where a needle is longer than the raster, or where charts may not be turned by any angle.
    pub fn new(charts: &[ChartMap], options: &AtlasOptions) -> Result<Option<Self>, AtlasError> {
        let outlines = outlines(charts)?;
        let is_worth_it = outlines.len() <= MOST_CHARTS && options.search_words >= LEAST_WORDS;
        if !is_worth_it || options.turns == Turns::Quarters {
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
        let by_size = by_size(&level);
        let mut state = Arrangement {
            order: by_size.clone(),
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
            pages: Vec::new(),
            by_size,
        })
    }

    /// The share of the square that is filled, less what whole cells of the coarse raster lose.
    pub fn fill(&self) -> f64 {
        let ratio = self.raster.cells() / (self.side() + self.raster.padding);
        HOPE * ratio * ratio
    }

    /// Side of the square, in cells.
    fn side(&self) -> f64 {
        squeezed_side(&self.pages).min(self.state.cost)
    }
}

/// The side of the largest page, infinite without pages.
fn squeezed_side(pages: &[Page]) -> f64 {
    let sides = pages.iter().map(|page| page.squeezed.side);
    sides.max_by(f64::total_cmp).unwrap_or(f64::INFINITY)
}

impl Raster {
    fn poses(self, outline: &Outline) -> Arc<Poses> {
        let distances = Distances {
            around: 0.0,
            padding: self.padding,
        };
        Arc::new(Poses::new(outline, self.scale, distances))
    }

    /// Whether pages are squares: only there charts are squeezed.
    fn is_square(self) -> bool {
        self.texture.resolution.halvings() == [0; 2]
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

//! Layouts on a coarse raster, and a search that makes them fuller.
mod arrangement;
mod search;

use std::sync::Arc;

use super::effort::OnRead;
use super::gap::squeezed;
use super::layout::{Layout, Problem, padding};
use super::mask::{Distances, Rounding};
use super::occupancy::{Corner, Occupancy};
use super::outline::{Outline, outlines};
use super::page::{FINE, Form, RASTER, Region, Texture, page_side};
use super::plan::{HOPE, MOST_CHARTS, Plan};
use super::problem::{AtlasError, AtlasOptions, ChartMap, Rotation};
use super::squeeze::{Pose, Squeezed};
use arrangement::{Arrangement, Poses};

/// A chart is small if the half perimeter of its rectangle is at most this share of that side: it finds a place between the others.
const SMALL: f64 = 0.12;
/// Sides of the squares in which all charts are first placed, in sides of the page; tried in this order until the charts fit.
const SIDES: [u32; 5] = [1, 2, 4, 8, MOST_SIDES];
/// Length of the longest chart that is not a needle, in sides of the page. Ten pages, the area that one chart may be expected to
/// fill, are as large as 3.2 sides squared.
const MOST_SIDES: u32 = 16;
/// Maximum number of cells of all pages of an occupancy: those of a coarse page of [`MOST_SIDES`]. Pages with one side are exempt.
/// A search keeps dozens of snapshots, at about one to two bytes per cell.
const MOST_CELLS: u64 = ((RASTER * MOST_SIDES) as u64).pow(2);
/// Factor of the side that one chart alone requires, up to which a squeezed page counts as the smallest: squeezing ends with a step of
/// .0004 of the side.
const REACHED: f64 = 1.001;
/// Layout on a coarse raster.
///
/// The layout follows from an order of the charts and a pose of each: every chart is placed where the used part of the page grows
/// least. Simulated annealing changes the order or a pose, and keeps changes that make the page smaller, at first also some that
/// make it a little larger. Crowds are not annealed: their largest charts are placed first.
///
/// Charts are rounded to the nearest cells, so they may overlap by a fraction of a cell. The result is then squeezed, and all
/// charts move and turn at once.
///
/// The cost of the search is counted in words read, so the result is the same on every machine and for any number of threads.
#[derive(Clone)]
pub struct CoarseLayout {
    /// Charts, turned as in their first pose.
    pub(super) plan: Plan,
    /// Poses of each chart, which copies share.
    poses: Vec<Arc<Poses>>,
    raster: CoarseRaster,
    /// Arrangement with the largest charts first.
    first: Arrangement,
    /// Best arrangement so far.
    state: Arrangement,
    /// Squeezed charts of the best arrangement so far, in the order of `first`; `None` before a search succeeds.
    squeezed: Option<Squeezed>,
    /// Number of searches so far.
    n_searches: u64,
    /// `true` once a search has nothing left to try.
    is_exhausted: bool,
    /// Arrangements that were squeezed as far as possible.
    squeezed_to_the_end: Vec<Arrangement>,
    /// Number of large charts, the first ones by size.
    n_large: usize,
}

/// Raster on which charts become cells.
#[derive(Clone, Copy)]
struct CoarseRaster {
    /// Cells along the side of the square page that the charts are expected to need.
    side: u32,
    /// Cells per mesh unit.
    scale: f64,
    /// Cells kept free between charts.
    padding: f64,
    rotation: Rotation,
    texture: Texture,
}

impl CoarseLayout {
    /// Places the charts in the order of their sizes. Returns `None` if there are too many charts or no words for a search, if a
    /// needle is longer than the raster, if the charts have no area, or if they do not fit on the largest raster.
    pub fn new(charts: &[ChartMap], options: &AtlasOptions) -> Result<Option<Self>, AtlasError> {
        Ok(Self::of(&Plan::of(charts, options)?, options))
    }

    /// Like [`new`](Self::new), for charts that are already turned.
    pub(super) fn of(plan: &Plan, options: &AtlasOptions) -> Option<Self> {
        let n_charts = plan.outlines.len();
        if n_charts > MOST_CHARTS || options.budget_words == 0 || !plan.has_area() {
            return None;
        }
        let area = plan.area();
        let texture = options.texture;
        let side = texture.coarse_cells(plan.order.len());
        let cells = f64::from(texture.raster(side));
        let raster = CoarseRaster {
            side,
            scale: cells * (HOPE * texture.share() * f64::from(texture.pages) / area).sqrt(),
            padding: padding(options, plan.order.len(), cells),
            rotation: options.rotation,
            texture,
        };
        let extents = plan.order.iter().flat_map(|&i| plan.outlines[i].extent);
        let longest = extents.fold(0.0, f64::max) * raster.scale;
        let largest = raster.sides().last().unwrap_or(1);
        if longest > f64::from(raster.largest(largest)) {
            return None;
        }
        let mut coarse = Self::at_first(plan.clone(), &[], raster);
        coarse.lay_out().then_some(coarse)
    }

    /// Returns the layout with `parts` in place of one chart; they come last among the charts. It is laid out only when it is
    /// [improved](Self::improve), and its fill is 0 until then.
    pub fn replaced(&self, chart: usize, parts: &[ChartMap]) -> Result<Self, AtlasError> {
        let (mut charts, mut poses) = (self.plan.outlines.clone(), self.poses.clone());
        charts.remove(chart);
        poses.remove(chart);
        let n_others = charts.len();
        charts.extend(outlines(parts)?);
        let (rotation, texture) = (self.raster.rotation, self.raster.texture);
        let plan = Plan::leveled(charts, n_others, rotation, texture);
        Ok(Self::at_first(plan, &poses, self.raster))
    }

    /// Returns a layout with the leaning charts turned upright, which has yet to be laid out; `None` if no chart leans.
    pub(super) fn straightened(&self) -> Option<Self> {
        let straight = self.plan.straightened()?;
        Some(Self::at_first(straight, &[], self.raster))
    }

    /// Creates a layout that has yet to be laid out. `known` are poses of the first charts, which are reused where they still apply.
    fn at_first(plan: Plan, known: &[Arc<Poses>], raster: CoarseRaster) -> Self {
        let mut poses: Vec<Arc<Poses>> = Vec::with_capacity(plan.outlines.len());
        for (chart, (outline, &first)) in plan.outlines.iter().zip(&*plan.kind).enumerate() {
            let holds = |known: &&Arc<Poses>| known.level().has_copies == outline.has_copies;
            poses.push(match known.get(chart).filter(holds) {
                _ if first < chart => poses[first].clone(),
                Some(known) => known.clone(),
                None => raster.poses(outline),
            });
        }
        let is_large = |&&chart: &&usize| {
            let [width, height] = plan.outlines[chart].extent;
            (width + height) * raster.scale > SMALL * raster.cells()
        };
        let n_large = plan.order.iter().take_while(is_large).count().max(1);
        let first = Arrangement {
            order: plan.order.clone(),
            pose: vec![0; poses.len()],
            corners: vec![Corner::default(); poses.len()],
            side: 0,
            cost: f64::INFINITY,
        };
        Self {
            n_large,
            state: first.clone(),
            first,
            plan,
            poses,
            raster,
            squeezed: None,
            n_searches: 0,
            is_exhausted: false,
            squeezed_to_the_end: Vec::new(),
        }
    }

    /// Places all charts in their order, in the first of several squares in which they fit. Returns `false` if they fit in none.
    fn lay_out(&mut self) -> bool {
        let n = self.first.order.len();
        let is_laid_out = self.raster.sides().any(|side| {
            let largest = self.raster.largest(side);
            let mut occupancy = self.raster.occupancy(largest);
            let laid_out = self
                .first
                .lay_out(&self.poses, &mut occupancy, 0..n, largest);
            laid_out.is_some()
        });
        self.state = self.first.clone();
        is_laid_out
    }

    fn is_laid_out(&self) -> bool {
        self.state.cost.is_finite()
    }

    /// Returns the approximate share of the page that is filled; 0 before the charts are laid out.
    pub fn fill(&self) -> f64 {
        let ratio = self.raster.cells() / (self.side() + self.raster.padding);
        HOPE * ratio * ratio
    }

    /// Returns an upper bound of the scale of any layout of these charts, in UV units per mesh unit along the longer side: each
    /// chart has to fit on a page by itself.
    pub fn most_scale(&self) -> f64 {
        (1.0 - self.raster.padding / self.raster.cells()) / self.longest()
    }

    /// Returns an upper bound of the [fill](Self::fill) of any layout of these charts.
    pub fn most_fill(&self) -> f64 {
        let ratio = self.raster.cells() / (self.least_side() + self.raster.padding);
        HOPE * ratio * ratio
    }

    /// Returns a lower bound of the longer side of the largest page, in cells.
    fn least_side(&self) -> f64 {
        self.longest() * self.raster.scale
    }

    /// Returns the longer side of the smallest page that every chart fits on by itself, without borders, in mesh units.
    fn longest(&self) -> f64 {
        let texture = self.raster.texture;
        let mut longest = f64::MIN_POSITIVE;
        for &chart in &self.first.order {
            let outline = self.poses[chart].level();
            // A chart fits on its page at the first angle, if not on a smaller one.
            if page_side(outline.extent, texture.resolution.halvings()) > longest {
                longest = longest.max(outline.least_page(outline.rotation(), texture));
            }
        }
        longest
    }

    /// Returns whether the squeezed pages are as small as one chart alone requires, so that no search makes them smaller.
    pub(super) fn is_least(&self) -> bool {
        self.is_searched() && self.side() <= REACHED * self.least_side()
    }

    /// Returns `true` if a search has squeezed the layout.
    pub(super) fn is_searched(&self) -> bool {
        self.squeezed.is_some()
    }

    /// Returns `true` if there are too many charts to search their order.
    pub fn is_crowded(&self) -> bool {
        self.raster.texture.is_crowded(self.n_charts())
    }

    /// Returns the longer side of the largest page, in cells.
    fn side(&self) -> f64 {
        (self.squeezed.as_ref()).map_or(self.state.cost, |squeezed| squeezed.side)
    }
}

impl CoarseRaster {
    fn poses(self, outline: &Outline) -> Arc<Poses> {
        let distances = Distances {
            around: 0.0,
            padding: self.padding,
            rounding: Rounding::Nearest,
        };
        Arc::new(Poses::new(outline, self.scale, distances))
    }

    /// Returns the cells along the longer side of the page that the charts are expected to need.
    fn cells(self) -> f64 {
        f64::from(self.texture.raster(self.side))
    }

    /// Returns those of [`SIDES`] whose snapshots are not too large, and always the first.
    fn sides(self) -> impl Iterator<Item = u32> {
        let cells =
            move |sides: u32| u64::from(self.texture.pages) * u64::from(sides * self.side).pow(2);
        (SIDES.into_iter()).take_while(move |&sides| sides == 1 || cells(sides) <= MOST_CELLS)
    }

    /// Returns the cells along the longer side of a page that is `sides` times as long as the expected one.
    fn largest(self, sides: u32) -> u32 {
        self.texture.raster(sides * self.side)
    }

    fn occupancy(self, side: u32) -> Occupancy {
        let form = Form::new(self.texture, self.padding / 2.0);
        Occupancy::new(form, side, self.padding.ceil() as u32 + 2, 0)
    }
}

impl CoarseLayout {
    /// Returns an arrangement as poses of charts.
    fn loose(&self, state: &Arrangement) -> Squeezed {
        let texture = self.raster.texture;
        let page = f64::from(state.side) + self.raster.padding;
        let posed = self.first.order.iter().map(|&chart| {
            let (poses, pose) = (&self.poses[chart], state.pose[chart]);
            let [i, j] = poses.middle(pose);
            let Corner { page: number, x, y } = state.corners[chart];
            let frame = texture.frame(Region::page(number));
            let middle = [f64::from(x) + i + frame.left * page, f64::from(y) + j];
            (Pose::new(middle, Poses::angle(pose)), frame)
        });
        let CoarseRaster { padding, scale, .. } = self.raster;
        Squeezed::new(posed, Arc::default(), page, padding, scale)
    }

    /// Returns a layout that keeps exactly the padding. Returns `None` if none is found, or if the charts leave no room for the padding.
    pub(in crate::atlas) fn with_exact_gap(
        &self,
        options: &AtlasOptions,
        on_read: &OnRead,
    ) -> Option<Layout> {
        let longer = f64::from(options.texture.resolution.longer());
        let asked = f64::from(options.packed_texels()) * self.raster.cells() / longer;
        if self.raster.padding < asked {
            return None;
        }
        let start = self.squeezed.as_ref()?.refined(FINE);
        squeezed(&Problem::free(&self.plan, options, on_read), start)
    }
}

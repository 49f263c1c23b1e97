//! Layouts on a conservative raster, which keep the padding by construction.
//!
//! At one scale, charts are placed greedily, the largest first, each where the used part of the pages grows least. Cells of islands that
//! stay are occupied from the start, and each chart is placed where its region allows. The charts that find a place tell the next scale;
//! after a few attempts, the fullest layout counts. A prescribed scale has one attempt, which fills page after page.
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

use super::effort::OnRead;
use super::mask::{CellRun, Distances, Mask, Rounding, Turned};
use super::occupancy::{Corner, Occupancy, Window};
use super::outline::Outline;
use super::page::{Form, Region, Texture};
use super::plan::{HOPE, MOST_CHARTS, Plan, SLIVERS};
use super::problem::{AtlasOptions, Rotation, Scale};

use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::random::Random;
use unwrapd_method::solver::Control;

/// Scale and places of all charts.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// Grid steps per mesh unit.
    pub scale: f64,
    /// Grid steps per cell.
    pub cell: f64,
    /// Distance kept between charts, in texels.
    pub padding_texels: f64,
    pub charts: Vec<Place>,
}

impl Layout {
    /// Returns the area of the charts, in squares on the longer side of a page.
    pub(super) fn fill(&self, options: &AtlasOptions) -> f64 {
        let sizes = self.charts.iter().map(|place| place.outline.size);
        let area: f64 = sizes.map(|size| size * size).sum();
        area * (self.scale / options.texture.grid_side()).powi(2)
    }
}

/// Place of a chart.
#[derive(Clone, Debug)]
pub(super) struct Place {
    /// Outline at its angle on the page.
    pub outline: Outline,
    pub page: u32,
    /// Lower left corner of its bounding rectangle on the page, in grid steps.
    pub corner: [f64; 2],
    /// Factor by which it exceeds the common scale.
    pub stretch: f64,
    /// Distance by which its vertices may be moved, in grid steps.
    pub room: f64,
}

impl Place {
    /// Returns the center of the bounding rectangle, in grid steps. `scale` is the common one.
    pub(super) fn middle(&self, scale: f64) -> [f64; 2] {
        let extent = self.outline.extent;
        [0, 1].map(|k| self.corner[k] + extent[k] * scale * self.stretch / 2.0)
    }
}

/// Maximum number of scales tried once one fits, and before.
const ATTEMPTS: [usize; 2] = [12, 400];
/// Ratio of a scale that failed to the best one, below which the search ends. With 1.003 instead, the scales of 46 sets of charts around
/// islands or in regions are equal within .001 at the mean.
const NEAR: f64 = 1.005;
/// Maximum number of words of a search once the best scale is within [`NEAR`] of one that failed or of the next. The first scale may
/// leave a fifth of the pages empty.
const MOST_WORDS: u64 = 150_000_000;
/// Share of the room left by an attempt that the next scale aims at, since an attempt that does not fit is wasted. With 1, 10,000 bricks
/// fill .016 less.
const HASTE: f64 = 0.995;
/// Largest factor of the scale if the charts do not fit around what is taken.
const SMALLER: f64 = 0.95;
/// Scales at which a layout with copies alike is tried, relative to the fullest. It may be fuller, as copies lie in rows; the last
/// scale costs 6 % of the fill. With many charts, only scales up to 1 are tried.
const ALIKE: [f64; 5] = [1.06, 1.03, 1.0, 0.985, 0.97];

/// Returns the cells along a side of a square page. Each chart has about 16 along its own side.
pub(super) fn raster(n_charts: usize, most_cells: u32) -> u32 {
    match n_charts {
        0..=400 => {
            let least = (256 * n_charts as u32).isqrt().next_power_of_two();
            most_cells.clamp(least, 1024)
        }
        401..=20_000 => 2048,
        20_001..=1_000_000 => 4096,
        _ => 16384,
    }
}

/// Returns the cells kept free between charts.
pub(super) fn padding(options: &AtlasOptions, n_charts: usize, cells: f64) -> f64 {
    let texture = options.texture;
    // The smallest charts, with their padding, take at most half of the pages.
    let pages = f64::from(texture.pages) * texture.share();
    let most = (cells / (2.0 * n_charts as f64 / pages).sqrt() - 2.0).max(0.0);
    let longer = f64::from(texture.resolution.longer().max(1));
    (f64::from(options.packed_texels()) * cells / longer).min(most)
}

/// Outline that other charts keep clear of.
pub(super) struct Obstacle {
    pub page: u32,
    /// Outline in longer sides of a page, from the lower left corner of the first one.
    pub outline: Outline,
    /// Distance by which its vertices may be moved, in longer sides of a page.
    pub slack: f64,
}

impl Obstacle {
    /// Returns the cells that the outline touches on its page, and the position of the lower left one, counted from the inner corner of
    /// borders that are `border` cells wide.
    pub(super) fn body(
        &self,
        texture: Texture,
        cells: u32,
        border: f64,
    ) -> (Vec<CellRun>, [i64; 2]) {
        let cells = f64::from(cells);
        let around = self.slack * cells;
        let corners: Vec<[f64; 2]> = self.outline.edges().map(|edge| edge[0]).collect();
        let [low, _] = bounds_of(&corners);
        let left = [f64::from(self.page) * texture.resolution.sides()[0], 0.0];
        let first = |k: usize| ((low[k] - left[k]) * cells - border - around).floor();
        let first = [0, 1].map(first);
        let corner = |k: usize| left[k] + (first[k] + border + around) / cells;
        let outline = self.outline.with_origin([0, 1].map(corner));
        let distances = Distances {
            around,
            padding: 0.0,
            rounding: Rounding::Outward,
        };
        let mask = Mask::new(&outline, cells, distances);
        (mask.body.runs(), first.map(|x| x as i64))
    }
}

/// Charts to be packed, and what constrains them.
#[derive(Clone, Copy)]
pub(super) struct Problem<'a> {
    pub plan: &'a Plan,
    /// Region of each chart; empty if no chart has one.
    pub regions: &'a [Option<Region>],
    /// Islands that stay.
    pub obstacles: &'a [&'a Obstacle],
    pub options: &'a AtlasOptions,
    pub on_read: &'a OnRead<'a>,
}

impl<'a> Problem<'a> {
    /// Creates the problem of charts that have the pages for themselves.
    pub(super) fn free(plan: &'a Plan, options: &'a AtlasOptions, on_read: &'a OnRead<'a>) -> Self {
        Self {
            plan,
            regions: &[],
            obstacles: &[],
            options,
            on_read,
        }
    }

    /// Returns whether charts have regions or keep clear of islands.
    pub(super) fn is_constrained(&self) -> bool {
        !self.obstacles.is_empty() || self.regions.iter().any(Option::is_some)
    }

    /// Returns the best layout found; `None` if the charts do not fit, at any scale or at the prescribed one. The vertices of each chart
    /// may be moved by its `slack`, in cells.
    pub(super) fn layout(&self, slack: &[f64], most_cells: u32) -> Option<Layout> {
        let packing = Packing::new(self, slack, most_cells);
        let places = match self.options.scale {
            Scale::Largest => {
                let found = best(&packing)?;
                let is_crowded = self.plan.order.len() > MOST_CHARTS;
                if self.is_constrained() {
                    if is_crowded {
                        found
                    } else {
                        fuller(&packing, found)
                    }
                } else {
                    let is_tried = |share: &f64| *share <= 1.0 || !is_crowded;
                    let mut shares = ALIKE.into_iter().filter(is_tried);
                    let alike = shares.find_map(|share| alike(&packing, share * found.scale));
                    alike.unwrap_or(found)
                }
            }
            Scale::TexelsPerUnit(texels) => {
                let longer = f64::from(packing.texture.resolution.longer());
                let scale = texels * f64::from(packing.cells) / longer;
                alike(&packing, scale).or_else(|| packing.attempt(scale, &mut 0).ok())?
            }
        };
        Some(packing.layout(places))
    }
}

/// Returns a layout with copies alike at a scale; `None` if there are no copies or they do not fit.
fn alike(packing: &Packing, scale: f64) -> Option<ScaledPlaces> {
    let plan = packing.plan();
    if !plan.outlines.iter().any(|outline| outline.has_copies) {
        return None;
    }
    let alike = Packing {
        is_alike: true,
        taken: packing.taken.clone(),
        ..*packing
    };
    alike.attempt(scale, &mut 0).ok()
}

/// Returns the places of all charts at the largest scale that is found.
fn best(packing: &Packing) -> Option<ScaledPlaces> {
    let most_words = packing.problem.options.budget_words.min(MOST_WORDS);
    let demand = Demand::of(packing);
    let mut scale = demand.scale(HOPE);
    let mut best: Option<ScaledPlaces> = None;
    let mut failed = f64::INFINITY;
    let mut work = 0;
    for tried in 1..=ATTEMPTS[1] {
        let next = match packing.attempt(scale, &mut work) {
            Ok(attempt) => {
                let next = grown(packing, &demand, &attempt);
                if best.as_ref().is_none_or(|best| scale > best.scale) {
                    best = Some(attempt);
                }
                next.max(NEAR * scale)
            }
            Err(placed) => {
                failed = failed.min(scale);
                // Around what is taken, the last charts may lack room by far.
                let most = if packing.problem.is_constrained() {
                    SMALLER
                } else {
                    1.0 / NEAR
                };
                // Charts without area are no share of anything.
                (placed.sqrt() * scale).max(0.5 * scale).min(most * scale)
            }
        };
        let before = std::mem::replace(&mut scale, next);
        if let Some(good) = best.as_ref().map(|best| best.scale) {
            let is_ended = (packing.problem.on_read)(0) == Control::Finish;
            let is_read = work > most_words && failed.min(scale) < good * NEAR;
            let enough = tried >= ATTEMPTS[0] || is_read || failed < good * NEAR;
            if enough || is_ended || packing.plan().order.is_empty() || scale == before {
                break;
            }
            if scale >= failed || scale <= good {
                scale = f64::midpoint(good, failed.min(1.1 * good));
            }
        }
    }
    best
}

/// Returns the scale at which a layout would fill the page if the share of the used rows that charts fill stayed the same. Within
/// constraints, nothing tells that scale, and the result is infinite.
fn grown(packing: &Packing, demand: &Demand, attempt: &ScaledPlaces) -> f64 {
    if packing.problem.is_constrained() {
        return f64::INFINITY;
    }
    let [_, rows] = packing.form().reach(packing.whole());
    let used = f64::from(attempt.rows.max(1)) / f64::from(rows * packing.texture.pages);
    demand.scale(HASTE * demand.share(attempt.scale) / used)
}

/// Factor of the scale for each trial order, and number of failed trials in a row, per unit of patience, that end the search. Without
/// it, layouts around islands are emptier by .028 at the mean of 112 sets of charts.
const GROWTH: f64 = 1.004;
const MOST_IDLE: u64 = 100;
const SEED: u64 = 1;

/// Tries random changes of the order and of quarter turns, and keeps those that allow a larger scale.
fn fuller(packing: &Packing, mut best: ScaledPlaces) -> ScaledPlaces {
    let options = packing.problem.options;
    let mut plan = packing.plan().clone();
    let n = plan.order.len();
    let mut random = Random::new(SEED);
    let (mut work, mut idle) = (0, 0);
    let most_idle = MOST_IDLE * options.patience;
    while n > 1 && idle < most_idle && work < options.budget_words {
        if (packing.problem.on_read)(0) == Control::Finish {
            break;
        }
        let mut trial = plan.clone();
        let [i, j] = [random.below(n), random.below(n)];
        match random.below(3) {
            0 => trial.order.swap(i, j),
            1 => {
                let chart = trial.order.remove(i);
                trial.order.insert(j, chart);
            }
            _ => {
                let turns = match options.rotation {
                    Rotation::Any | Rotation::Quarter => random.below(4) as u32,
                    Rotation::None => 0,
                };
                trial.turns[trial.order[i]] = Some(turns);
            }
        }
        let problem = Problem {
            plan: &trial,
            ..*packing.problem
        };
        let tried = Packing {
            problem: &problem,
            taken: packing.taken.clone(),
            ..*packing
        };
        match tried.attempt(GROWTH * best.scale, &mut work) {
            Ok(attempt) => {
                (best, plan, idle) = (attempt, trial, 0);
            }
            Err(_) => idle += 1,
        }
    }
    best
}

/// Cells that charts take with their padding and the raster's rounding, as a polynomial of the scale in cells per mesh unit.
struct Demand {
    /// Coefficients of the square, the linear and the constant term: area, margin along outlines, margin at corners.
    terms: [f64; 3],
    /// Cells of all pages that are free.
    free: f64,
    /// Scale at which the longest chart fits, and at which the charts of no region would exceed its area.
    most: f64,
    cells: f64,
}

impl Demand {
    fn of(packing: &Packing) -> Self {
        let outlines = || {
            packing
                .plan()
                .order
                .iter()
                .map(|&i| &packing.plan().outlines[i])
        };
        let perimeter: f64 = outlines().map(Outline::perimeter).sum();
        let n = packing.plan().order.len() as f64;
        let around = packing.padding + 1.0;
        let form = packing.form();
        let longest = outlines().map(|outline| form.around(outline.extent));
        let longest = longest.fold(f64::MIN_POSITIVE, f64::max);
        let cells = f64::from(packing.cells);
        Self {
            terms: [
                packing.plan().area(),
                perimeter * around / 2.0,
                n * around * around / 2.0,
            ],
            free: cells * cells * packing.free,
            most: ((packing.target() - form.most_inset() - SLACK).max(1.0) / longest)
                .min(most_in_regions(packing)),
            cells,
        }
    }

    /// Returns the share of the pages that charts take at a scale.
    fn share(&self, scale: f64) -> f64 {
        let [a, b, c] = self.terms;
        (a * scale * scale + b * scale + c) / self.free
    }

    /// Returns the scale at which charts take a share of the pages, at most that at which the longest chart fits.
    fn scale(&self, share: f64) -> f64 {
        let [a, b, c] = self.terms;
        let missing = (share * self.free - c).max(1.0);
        let quadratic = 4.0 * a * missing;
        let root = if quadratic > SLIVERS * b * b {
            (-b + (b * b + quadratic).sqrt()) / (2.0 * a)
        } else {
            // Charts that have hardly any area take room along their length; those that are points take none at any scale.
            (missing / b).min(self.cells)
        };
        root.min(self.most)
    }
}

/// Returns the scale at which the charts of a region would cover it, the least of all regions.
fn most_in_regions(packing: &Packing) -> f64 {
    let mut least = f64::INFINITY;
    for region in packing.problem.regions.iter().flatten() {
        let outlines = packing.plan().outlines.iter().zip(packing.problem.regions);
        let inside = outlines.filter(|(_, other)| other.as_ref() == Some(region));
        let area: f64 = inside.map(|(outline, _)| outline.size.powi(2)).sum();
        least = least.min((packing.texture.frame(*region).area() / area).sqrt());
    }
    least * f64::from(packing.cells)
}

/// Distance of a vertex from its exact position, in cells, that needs no other layout.
pub(super) const SLACK: f64 = 1.0 / 64.0;

/// Least number of grid cells of a chart for each of its triangles; an equilateral triangle of height 4 has 9. Smaller charts, which
/// are far below a texel, are enlarged: nothing smaller can be represented.
const CELLS_PER_TRIANGLE: f64 = 16.0;
/// Cost of rastering a boundary edge, and of turning and placing a chart, in words.
const WORK_PER_EDGE: u64 = 100;
const WORK_PER_CHART: u64 = 10_000;
/// Number of charts whose masks are made at a time.
const BATCH: usize = 4096;

/// Free cells around pages beyond the reach of charts: the used part of a page may be rounded down.
const FRAME: u32 = 4;
/// Smallest share of the pages that is assumed to be free: islands that stay may cover each other.
const LEAST_FREE: f64 = 1e-3;

/// Charts on a raster, and the distances to be kept.
struct Packing<'a> {
    problem: &'a Problem<'a>,
    /// Distance that the vertices of each chart may be moved afterward, in cells.
    slack: &'a [f64],
    texture: Texture,
    /// Cells along the longer side of a page.
    cells: u32,
    /// Cells kept free between charts, and at each border.
    padding: f64,
    border: f64,
    /// `true` if charts that have copies are not turned, so that copies lie alike.
    is_alike: bool,
    /// Pages on which islands that stay occupy cells.
    taken: Arc<Occupancy>,
    /// Area of all pages that is not occupied then, in squares on the longer side of a page.
    free: f64,
}

/// Places of all charts at one scale.
struct ScaledPlaces {
    /// In cells per mesh unit.
    scale: f64,
    /// Place of each chart.
    spots: Vec<Spot>,
    /// Rows used of all pages.
    rows: u32,
}

/// Place of a chart on the raster.
#[derive(Clone, Copy)]
struct Spot {
    corner: Corner,
    /// Quarter turns, counter-clockwise.
    turns: u32,
    /// Width and height of the turned body, in cells.
    size: [u32; 2],
    /// Factor by which it exceeds the common scale.
    stretch: f64,
}

impl Spot {
    /// Spot of a chart without triangles.
    const NOWHERE: Self = Self {
        corner: Corner {
            page: 0,
            x: 0,
            y: 0,
        },
        turns: 0,
        size: [0; 2],
        stretch: 1.0,
    };
}

impl<'a> Packing<'a> {
    fn new(problem: &'a Problem<'a>, slack: &'a [f64], most_cells: u32) -> Self {
        let Problem { plan, options, .. } = *problem;
        let texture = options.texture;
        let on_page = plan.order.len() / texture.pages.max(1) as usize;
        let cells = texture.raster(raster(on_page, most_cells));
        let padding = padding(options, plan.order.len().max(1), f64::from(cells));
        let border = (padding / 2.0).max(SLACK);
        let form = Form::new(texture, border);
        let mut packing = Self {
            problem,
            slack,
            texture,
            cells,
            padding,
            border,
            is_alike: false,
            taken: Arc::new(Occupancy::new(form, 0, 0, 0)),
            free: f64::from(texture.pages) * texture.share(),
        };
        // Charts that stay may reach into the borders, which are free of others.
        let frame = (packing.reach() + border).ceil() as u32 + FRAME;
        let whole = packing.whole();
        let mut taken = Occupancy::new(form, whole, frame, whole);
        for obstacle in problem.obstacles {
            let (body, corner) = obstacle.body(texture, cells, border);
            taken.cover(&body, obstacle.page, corner);
        }
        packing.taken = Arc::new(taken);
        let sizes = problem.obstacles.iter().map(|it| it.outline.size);
        let covered: f64 = sizes.map(|size| size * size).sum();
        packing.free = (packing.free - covered).max(LEAST_FREE * packing.free);
        packing
    }

    fn plan(&self) -> &'a Plan {
        self.problem.plan
    }

    /// Returns the cells of a page that charts may use, along its longer side.
    fn target(&self) -> f64 {
        (f64::from(self.cells) - 2.0 * self.border).floor()
    }

    /// Returns the shape of pages without their borders.
    fn form(&self) -> Form {
        Form::new(self.texture, self.border)
    }

    /// Returns [`target`](Self::target) in whole cells, at least 1.
    fn whole(&self) -> u32 {
        self.target().max(1.0) as u32
    }

    /// Returns the cells kept free around a chart, including the slack.
    fn reach(&self) -> f64 {
        self.padding + 2.0 * SLACK
    }

    /// Places all charts at one scale. If one does not fit, returns the share of their area that was placed.
    fn attempt(&self, scale: f64, work: &mut u64) -> Result<ScaledPlaces, f64> {
        let plan = self.plan();
        let mut occupancy = Occupancy::clone(&self.taken);
        let mut spots = vec![Spot::NOWHERE; plan.outlines.len()];
        let mut lowest: HashMap<[u32; 2], Corner> = HashMap::new();
        let mut placed = 0.0;
        let area = plan.area();
        for batch in plan.order.chunks(BATCH) {
            let masks: Vec<Option<(Vec<Turned>, f64)>> =
                batch.par_iter().map(|&i| self.turned(i, scale)).collect();
            for (&i, turned) in batch.iter().zip(masks) {
                let (turned, stretch) = turned.ok_or(placed / area)?;
                let mut read =
                    WORK_PER_CHART + WORK_PER_EDGE * plan.outlines[i].edges().len() as u64;
                let [w, h] = turned[0].size;
                let row = lowest.entry([w.min(h), w.max(h)].map(rough)).or_default();
                let before = occupancy.work;
                let region = self.problem.regions.get(i).copied().flatten();
                let window = match region {
                    Some(region) => self.window(region),
                    None => Window::from(Corner { x: 0, ..*row }),
                };
                let found = occupancy.find(&turned, window);
                read += occupancy.work - before;
                *work += read;
                (self.problem.on_read)(read);
                let (index, corner) = found.ok_or(placed / area)?;
                if region.is_none() {
                    *row = corner;
                }
                let mask = &turned[index];
                occupancy.take(mask, corner);
                spots[i] = Spot {
                    corner,
                    turns: mask.turns,
                    size: mask.size,
                    stretch,
                };
                placed += plan.outlines[i].size * plan.outlines[i].size;
            }
        }
        Ok(ScaledPlaces {
            scale,
            spots,
            rows: occupancy.tops.iter().sum(),
        })
    }

    /// Returns the layout that places charts there.
    fn layout(&self, places: ScaledPlaces) -> Layout {
        let scale = places.scale;
        let cell = self.texture.grid_side() / f64::from(self.cells);
        let longer = f64::from(self.texture.resolution.longer());
        let padding = self.padding * longer / f64::from(self.cells);
        let most = f64::from(self.problem.options.padding_texels);
        let spots = places.spots.into_iter().enumerate();
        Layout {
            scale: scale * cell,
            cell,
            padding_texels: padding.min(most),
            charts: spots
                .map(|(chart, spot)| self.place(chart, spot, scale, cell))
                .collect(),
        }
    }

    /// Returns the place of a chart, at `scale` cells per mesh unit and `cell` grid steps per cell.
    fn place(&self, chart: usize, spot: Spot, scale: f64, cell: f64) -> Place {
        let outline = self.plan().outlines[chart].quarter_turned(spot.turns);
        let around = self.slack[chart] - SLACK;
        let Corner { x, y, page } = spot.corner;
        // Before it is turned, a chart lies at the lower left corner of its mask.
        let is_at_far_side = [matches!(spot.turns, 1 | 2), spot.turns >= 2];
        let corner = [0, 1].map(|k| {
            let near = self.border + f64::from([x, y][k]);
            let corner = if is_at_far_side[k] {
                let extent = outline.extent[k] * scale * spot.stretch;
                near + f64::from(spot.size[k]) - around - extent
            } else {
                near + around
            };
            corner * cell
        });
        Place {
            outline,
            page,
            corner,
            stretch: spot.stretch,
            room: self.slack[chart] * cell,
        }
    }

    /// Returns the cells of a region, with the border kept to its sides.
    fn window(&self, region: Region) -> Window {
        let frame = self.texture.frame(region);
        let cells = f64::from(self.cells);
        let left = [frame.left * cells, 0.0];
        let [low, high] = frame.bounds(cells - 2.0 * self.border, 2.0 * self.border);
        let [x, y] = [0, 1].map(|k| (low[k] - left[k]).ceil() as u32);
        let page = frame.page;
        Window {
            far: [0, 1].map(|k| (high[k] - left[k]).max(0.0) as u32),
            end_page: page + 1,
            ..Window::from(Corner { page, x, y })
        }
    }

    /// Returns the turned masks of a chart and its stretch; `None` if it is longer than a page.
    fn turned(&self, chart: usize, scale: f64) -> Option<(Vec<Turned>, f64)> {
        let outline = &self.plan().outlines[chart];
        let distances = Distances {
            around: self.slack[chart] - SLACK,
            padding: self.reach(),
            rounding: Rounding::Outward,
        };
        let unit = scale * self.texture.grid_side() / f64::from(self.cells);
        let stretch = stretch(outline, unit);
        let longest = outline.extent[0].max(outline.extent[1]);
        let fits = longest * scale * stretch + 2.0 * distances.around < f64::from(self.whole());
        fits.then(|| {
            let mask = Mask::new(outline, scale * stretch, distances);
            let turned = match self.plan().turns[chart] {
                Some(turns) => vec![Turned::new(&mask, turns)],
                None if self.is_alike && outline.has_copies => vec![Turned::new(&mask, 0)],
                None => Turned::all(mask),
            };
            (turned, stretch)
        })
    }
}

/// Rounds a size down to a class that is at most a quarter wide. Narrower classes read more than twice as many words for a scatter of
/// sizes, and hardly fill more.
fn rough(size: u32) -> u32 {
    let finer = size
        .checked_ilog2()
        .map_or(0, |bits| bits.saturating_sub(2));
    size >> finer << finer
}

/// Returns the factor by which a chart has to exceed the common scale, `unit` grid units per mesh unit, to be large enough for the
/// grid. It is 1 for a chart without area.
pub(super) fn stretch(outline: &Outline, unit: f64) -> f64 {
    if outline.size == 0.0 {
        return 1.0;
    }
    let root = (outline.n_triangles as f64 * CELLS_PER_TRIANGLE).sqrt();
    let longest = outline.extent[0].max(outline.extent[1]);
    (root / (outline.size * unit))
        .min(8.0 * root / (longest * unit))
        .max(1.0)
}

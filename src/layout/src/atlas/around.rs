//! Charts packed around islands that stay in place.
//!
//! The cells of the islands are occupied before the first chart is placed. Pages keep their size, so the search is for the largest
//! scale of the other charts at which each finds a place, and for an order of the charts that allows it.
use thiserror::Error;

use super::effort::OnRead;
use super::grid::{Repair, Snapped, doubled_area, snapped};
use super::layout::{Attempt, Extent, Layout, Packing, SLACK, padding, raster};
use super::mask::{Distances, Mask, Rounding, Run};
use super::occupancy::Occupancy;
use super::outline::{Outline, outlines};
use super::pack::{self, is_cramped, on_grid};
use super::page::{GRID_SIDE, Texture};
use super::plan::{HOPE, Plan, QuarterTurns};
use super::problem::{Atlas, AtlasError, AtlasOptions, ChartMap, Placed, Rotation, Scale};
use unwrapd_maps::plane::{BoxIndex, search_budget, segment_distance};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of, touch, widened};
use unwrapd_method::numerics::random::Random;
use unwrapd_method::solver::Control;

/// Free cells around pages beyond the reach of charts: the used part of a page may be rounded down.
const FRAME: u32 = 4;
/// Maximum number of layouts, each with more room for vertices that had to move farther than the last one allowed.
const ROUNDS: usize = 6;

/// Packs charts around others that stay, with quarter turns at most. The atlas contains the packed charts, then those that stay.
pub fn pack_around(
    charts: &[ChartMap],
    stays: &[Stay],
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Result<Atlas, AroundError> {
    let texture = options.texture;
    let staying = Staying::all(stays, texture)?;
    let longer = f64::from(texture.resolution.longer());
    let gap = f64::from(options.padding_texels) / longer;
    if let Some((islands, distance)) = too_near(&staying, gap) {
        return Err(AroundError::TooNear {
            islands,
            texels: distance * longer,
        });
    }
    let mut atlas = around(charts, &staying, options, on_read)?;
    for (stay, staying) in stays.iter().zip(staying) {
        let placed = staying.placed(texture);
        let doubled = |t: &[u32; 3]| doubled_area(t.map(|v| placed.grid[v as usize])) as f64;
        let covered: f64 = stay.map.triangles.iter().map(doubled).sum();
        atlas.utilization += covered / (2.0 * GRID_SIDE * GRID_SIDE * f64::from(texture.pages));
        atlas.placed.push(placed);
    }
    Ok(atlas)
}

fn around(
    charts: &[ChartMap],
    staying: &[Staying],
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Result<Atlas, AroundError> {
    let texture = options.texture;
    // Other islands keep their angles, up to quarter turns, while one is arranged by hand.
    let options = &AtlasOptions {
        rotation: match options.rotation {
            Rotation::Any => Rotation::Quarter,
            rotation => rotation,
        },
        ..options.clone()
    };
    let plan = Plan::largest_first(&outlines(charts)?, options);
    let on_page = plan.order.len() / texture.pages.max(1) as usize;
    let cells = texture.raster(raster(on_page, options.most_cells));
    let padding = padding(options, plan.order.len().max(1), f64::from(cells));
    let mut slack = vec![SLACK; charts.len()];
    for round in 0..=ROUNDS {
        let mut packing = Packing {
            plan: &plan,
            slack: &slack,
            texture,
            cells,
            padding,
            border: (padding / 2.0).max(SLACK),
            on_read,
            is_alike: false,
            extent: Extent::Full,
            taken: None,
        };
        let taken = taken(&packing, staying);
        packing.taken = Some(&taken);
        let (scale, attempt) = placed(&packing, staying, options).ok_or(AroundError::NoRoom)?;
        let cell = texture.grid_side() / f64::from(cells);
        let longer = f64::from(texture.resolution.longer());
        let layout = Layout {
            scale: scale * cell,
            cell,
            border: packing.border,
            spare: 0.0,
            padding_texels: (padding * longer / f64::from(cells))
                .min(f64::from(options.padding_texels)),
            charts: attempt.spots,
        };
        let repair = if round < ROUNDS {
            Repair::Open
        } else {
            Repair::Nothing
        };
        let snapped = on_grid(charts, &plan.outlines, &layout, repair);
        if repair == Repair::Nothing || !is_cramped(&snapped, &layout, &mut slack) {
            return Ok(pack::atlas(charts, &layout, &slack, snapped, options));
        }
    }
    Err(AroundError::NoRoom)
}

/// Returns pages on which the charts that stay occupy cells.
fn taken(packing: &Packing, staying: &[Staying]) -> Occupancy {
    let whole = packing.whole();
    // Charts that stay may reach into the borders, which are free of others.
    let frame = (packing.reach() + packing.border).ceil() as u32 + FRAME;
    let mut occupancy = Occupancy::new(packing.form(), whole, frame, whole);
    for chart in staying {
        let (body, corner) = chart.body(packing.texture, packing.cells, packing.border);
        occupancy.cover(&body, chart.page, corner);
    }
    occupancy
}

/// A chart that stays where it is.
#[derive(Clone, Copy, Debug)]
pub struct Stay<'a> {
    /// Map of the chart. Its unit is the longer side of a page, its origin the lower left corner of the first page.
    pub map: ChartMap<'a>,
    /// Island that the chart belongs to. Charts of one island keep no distance from each other.
    pub island: usize,
}

/// Error of packing charts around others.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum AroundError {
    /// A chart that stays extends beyond the page that holds its middle, or lies on no page.
    #[error("island {island} leaves its page")]
    OffPage {
        /// Island of the chart.
        island: usize,
    },
    /// Two charts that stay are nearer than the padding, or overlap.
    #[error("islands {} and {} are {texels} texels apart", islands[0], islands[1])]
    TooNear {
        /// Islands of the charts.
        islands: [usize; 2],
        /// Their distance; 0 if they overlap.
        texels: f64,
    },
    /// The other charts do not fit.
    #[error("the other charts do not fit")]
    NoRoom,
    /// The charts cannot be placed on any page.
    #[error(transparent)]
    Atlas(#[from] AtlasError),
}

/// Maximum number of scales tried after the first one at which the charts fit.
const ATTEMPTS: usize = 12;
/// Ratio of a scale that failed to the largest one that did not, below which the search ends.
const NEAR: f64 = 1.003;
/// Factor of the scale while the charts fit.
const LARGER: f64 = 1.15;
/// Smallest and largest factor of the scale if the charts do not fit.
const SMALLER: [f64; 2] = [0.5, 0.95];
/// Smallest scale tried, as a share of the scale at which the charts would cover the free area.
const LEAST: f64 = 0.01;
/// Smallest share of the pages that is assumed to be free.
const LEAST_FREE: f64 = 1e-3;
/// Factor of the scale for each trial order, and number of failed trials in a row, per unit of patience, that end the search.
const GROWTH: f64 = 1.004;
const MOST_IDLE: u64 = 100;
const SEED: u64 = 1;

/// Returns the scale, in cells per mesh unit, and a place for each chart; `None` if a chart finds no place.
pub(super) fn placed(
    packing: &Packing,
    staying: &[Staying],
    options: &AtlasOptions,
) -> Option<(f64, Attempt)> {
    let cells = f64::from(packing.cells);
    if packing.plan.order.is_empty() {
        // The unit of what stays is that of a page.
        return Some((cells, packing.attempt(cells, &mut 0).ok()?));
    }
    match options.scale {
        Scale::Largest => {
            let found = largest(packing, staying, options.budget_words)?;
            Some(grown(packing, found, options))
        }
        Scale::TexelsPerUnit(texels) => {
            let scale = texels * cells / f64::from(options.texture.resolution.longer());
            Some((scale, packing.attempt(scale, &mut 0).ok()?))
        }
    }
}

/// Returns the largest scale found at which the charts fit in the order of the plan, and their places.
fn largest(packing: &Packing, staying: &[Staying], budget_words: u64) -> Option<(f64, Attempt)> {
    let texture = packing.texture;
    let pages = f64::from(texture.pages) * texture.share();
    let taken: f64 = staying.iter().map(|chart| chart.outline.size.powi(2)).sum();
    let free = (pages - taken).max(LEAST_FREE * pages) * f64::from(packing.cells).powi(2);
    let most = (free / packing.plan.area()).sqrt();
    // Charts without area: at this scale the longest is as long as a page.
    let most = if most.is_finite() {
        most
    } else {
        f64::from(packing.cells) / packing.plan.longest().max(1.0 / f64::from(packing.cells))
    };
    let mut scale = HOPE.sqrt() * most;
    let mut best: Option<(f64, Attempt)> = None;
    let (mut failed, mut work, mut tried) = (f64::INFINITY, 0, 0);
    while scale >= LEAST * most {
        match packing.attempt(scale, &mut work) {
            Ok(attempt) => best = Some((scale, attempt)),
            Err(share) => {
                failed = scale;
                scale *= share.sqrt().clamp(SMALLER[0], SMALLER[1]);
            }
        }
        if let Some((good, _)) = best {
            let is_ended = (packing.on_read)(0) == Control::Finish || work > budget_words;
            if is_ended || tried == ATTEMPTS || failed < good * NEAR {
                break;
            }
            tried += 1;
            scale = if failed.is_finite() {
                (good * failed).sqrt()
            } else {
                LARGER * good
            };
        }
    }
    best
}

/// Tries random changes of the order and of quarter turns, and keeps those that allow a larger scale. Does nothing for a crowd, which
/// hardly gains.
fn grown(
    packing: &Packing,
    (mut scale, mut best): (f64, Attempt),
    options: &AtlasOptions,
) -> (f64, Attempt) {
    let n = packing.plan.order.len();
    let mut plan = packing.plan.clone();
    let mut random = Random::new(SEED);
    let (mut work, mut idle) = (0, 0);
    let most_idle = MOST_IDLE * options.patience;
    while n > 1 && !packing.is_crowded() && idle < most_idle && work < options.budget_words {
        if (packing.on_read)(0) == Control::Finish {
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
                trial.turns[trial.order[i]] = QuarterTurns::Only(turns);
            }
        }
        let tried = Packing {
            plan: &trial,
            ..*packing
        };
        match tried.attempt(GROWTH * scale, &mut work) {
            Ok(attempt) => {
                (scale, best, plan, idle) = (GROWTH * scale, attempt, trial, 0);
            }
            Err(_) => idle += 1,
        }
    }
    (scale, best)
}

/// Distance to which a chart may extend beyond its page, in units of u and v: less than half a step of the grid, so that rounding
/// brings it back.
const BEYOND: f64 = 1.0 / 33_554_432.0;
/// Tolerance of distances for rounding, in longer sides of a page.
const ROUNDED: f64 = 1e-9;

/// A chart that stays on its page.
pub(super) struct Staying {
    pub page: u32,
    /// Outline in longer sides of a page, from the lower left corner of the first one.
    pub outline: Outline,
    island: usize,
    bounds: Bounds,
    snapped: Snapped,
}

impl Staying {
    /// Checks that each chart lies within a page, and rounds it to the grid.
    pub(super) fn all(stays: &[Stay], texture: Texture) -> Result<Vec<Self>, AroundError> {
        let maps: Vec<ChartMap> = stays.iter().map(|stay| stay.map).collect();
        let outlined = outlines(&maps)?.into_iter().zip(stays);
        let staying = outlined.map(|(outline, stay)| {
            let corners: Vec<[f64; 2]> = outline.corners().collect();
            let bounds = bounds_of(&corners);
            let outline = outline.with_corner([0.0; 2]);
            let island = stay.island;
            let page = page(bounds, texture).ok_or(AroundError::OffPage { island })?;
            let snapped = snapped(&stay.map, &outline, texture.grid_side(), Repair::Open);
            Ok(Self {
                page,
                outline,
                island,
                bounds,
                snapped,
            })
        });
        staying.collect()
    }

    /// Returns the cells that the chart touches on its page, and the position of the lower left one, counted from the inner corner of
    /// borders that are `border` cells wide.
    pub(super) fn body(&self, texture: Texture, cells: u32, border: f64) -> (Vec<Run>, [i64; 2]) {
        let cells = f64::from(cells);
        let around = (self.snapped.largest_move + 1.0) * cells / texture.grid_side();
        let left = [f64::from(self.page) * texture.resolution.sides()[0], 0.0];
        let first = |k: usize| ((self.bounds[0][k] - left[k]) * cells - border - around).floor();
        let first = [0, 1].map(first);
        let corner = |k: usize| left[k] + (first[k] + border + around) / cells;
        let outline = self.outline.with_corner([0, 1].map(corner));
        let distances = Distances {
            around,
            padding: 0.0,
            rounding: Rounding::Outward,
        };
        let mask = Mask::new(&outline, cells, distances);
        (mask.body.runs(), first.map(|x| x as i64))
    }

    /// Returns the chart on the grid.
    pub(super) fn placed(self, texture: Texture) -> Placed {
        let on_page = |point| texture.on_page(0, point);
        Placed {
            grid: self.snapped.grid.into_iter().map(on_page).collect(),
        }
    }

    /// Returns whether the first corner of another chart lies inside.
    fn covers(&self, other: &Self) -> bool {
        let Some([x, y]) = other.outline.corners().next() else {
            return false;
        };
        let is_near = touch(&self.bounds, &[[x, y], [x, y]]);
        let crossings = self.outline.edges().map(|[p, q]| {
            // To the right of the point, upward and downward.
            let is_left =
                |p: [f64; 2], q: [f64; 2]| (q[0] - p[0]) * (y - p[1]) > (q[1] - p[1]) * (x - p[0]);
            match (p[1] <= y, q[1] <= y) {
                (true, false) => i32::from(is_left(p, q)),
                (false, true) => -i32::from(!is_left(p, q)),
                _ => 0,
            }
        });
        is_near && crossings.sum::<i32>() != 0
    }
}

/// Returns the page that contains a box; `None` if it lies on no page or extends beyond one.
fn page([low, high]: Bounds, texture: Texture) -> Option<u32> {
    let sides = texture.resolution.sides();
    let page = (f64::midpoint(low[0], high[0]) / sides[0]).floor();
    let left = [page * sides[0], 0.0];
    let is_inside = |k: usize| {
        let beyond = BEYOND * sides[k];
        low[k] >= left[k] - beyond && high[k] <= left[k] + sides[k] + beyond
    };
    let is_page = page >= 0.0 && page < f64::from(texture.pages);
    (is_page && is_inside(0) && is_inside(1)).then_some(page as u32)
}

/// Returns the nearest two islands and their distance if it is less than `gap`; 0 if they overlap.
pub(super) fn too_near(charts: &[Staying], gap: f64) -> Option<([usize; 2], f64)> {
    let mut edges = Vec::new();
    let mut owners = Vec::new();
    for (owner, chart) in charts.iter().enumerate() {
        edges.extend(chart.outline.edges());
        owners.resize(edges.len(), owner);
    }
    let boxes: Vec<Bounds> = (edges.iter())
        .map(|edge| widened(bounds_of(edge), gap / 2.0))
        .collect();
    let mut nearest: Option<(f64, [usize; 2])> = None;
    let mut found = |distance: f64, a: usize, b: usize| {
        let [a, b] = [a, b].map(|owner| charts[owner].island);
        let new = (distance, [a.min(b), a.max(b)]);
        if a != b && nearest.is_none_or(|known| new < known) {
            nearest = Some(new);
        }
    };
    // Should the search end early, for charts that lie in heaps, the certificate tells.
    BoxIndex::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
        let [a, b] = [i, j].map(|edge| owners[edge as usize]);
        if charts[a].island != charts[b].island {
            let distance = segment_distance(edges[i as usize], edges[j as usize]);
            if distance < gap - ROUNDED || distance <= 0.0 {
                found(distance, a, b);
            }
        }
    });
    for (a, b) in pairs(charts) {
        if charts[a].covers(&charts[b]) || charts[b].covers(&charts[a]) {
            found(0.0, a, b);
        }
    }
    nearest.map(|(distance, islands)| (islands, distance))
}

/// Returns the pairs of charts whose boxes meet.
fn pairs(charts: &[Staying]) -> Vec<(usize, usize)> {
    let boxes: Vec<Bounds> = charts.iter().map(|chart| chart.bounds).collect();
    let mut pairs = Vec::new();
    BoxIndex::new(&boxes).pairs(search_budget(boxes.len()), |a, b| {
        pairs.push((a as usize, b as usize));
    });
    pairs
}

//! Charts packed within constraints: in regions, in groups, and around islands that stay in place.
//!
//! Pages keep their size, so the search is for the largest scale of the charts. They are first placed on a raster on which the cells of
//! islands that stay are occupied, each where its region allows. Then all charts move at once while the pages shrink together with the
//! islands and the regions ([`squeeze`](super::squeeze)), which is the same as growing the charts.
use std::collections::BTreeMap;
use std::sync::Arc;

use super::coarse::{FINE, MOST_CHARTS, raster_side};
use super::effort::OnRead;
use super::gap::{Border, Squeezing};
use super::grid::{Repair, doubled_area};
use super::layout::{Attempt, Extent, Layout, Packing, SLACK, best, padding, raster};
use super::occupancy::Occupancy;
use super::outline::{Outline, outlines};
use super::pack::{self, ROUNDS, give_room, is_cramped, on_grid};
use super::page::{GRID_SIDE, Region};
use super::plan::{Plan, QuarterTurns};
use super::problem::{
    Atlas, AtlasOptions, ChartMap, ConstraintError, Constraints, Placed, Rotation, Scale,
};
use super::squeeze::{FixedBody, Pose, Squeezed};
use super::stay::{Obstacle, Staying, too_near};
use unwrapd_method::numerics::random::Random;
use unwrapd_method::solver::Control;

/// Free cells around pages beyond the reach of charts: the used part of a page may be rounded down.
const FRAME: u32 = 4;
/// Smallest share of the pages that is assumed to be free: islands that stay may cover each other.
const LEAST_FREE: f64 = 1e-3;
/// Maximum number of cells along the side of the raster for a few charts that are then squeezed. On a raster that is four times as fine,
/// the search takes four times as long, and the squeezed layouts are no fuller.
const SQUEEZED_CELLS: u32 = 256;

/// Packs charts within constraints. The atlas contains the packed charts, then those that stay.
pub fn pack_within(
    charts: &[ChartMap],
    constraints: &Constraints,
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Result<Atlas, ConstraintError> {
    let texture = options.texture;
    let staying = Staying::all(constraints.stays, texture)?;
    let longer = f64::from(texture.resolution.longer());
    let gap = f64::from(options.padding_texels) / longer;
    if let Some((islands, distance)) = too_near(&staying, gap) {
        return Err(ConstraintError::TooNear {
            islands,
            texels: distance * longer,
        });
    }
    let outside = |region: &Option<Region>| {
        region.is_some_and(|region| region.on_page(texture.pages).is_none())
    };
    if let Some(chart) = constraints.regions.iter().position(outside) {
        return Err(ConstraintError::Region { chart });
    }
    let groups = Group::all(charts, constraints)?;
    let maps: Vec<ChartMap> = groups.iter().map(Group::map).collect();
    let regions: Vec<Option<Region>> = groups.iter().map(|group| group.region).collect();
    let obstacles: Vec<&Obstacle> = staying.iter().map(|it| &it.obstacle).collect();
    let problem = Problem {
        charts: &maps,
        regions: &regions,
        obstacles: &obstacles,
    };
    let mut atlas = problem.packed(options, on_read)?;
    atlas.placed = Group::split(&groups, atlas.placed, charts);
    for (stay, staying) in constraints.stays.iter().zip(staying) {
        let placed = staying.placed(texture);
        let doubled = |t: &[u32; 3]| doubled_area(t.map(|v| placed.grid[v as usize])) as f64;
        let covered: f64 = stay.map.triangles.iter().map(doubled).sum();
        atlas.utilization += covered / (2.0 * GRID_SIDE * GRID_SIDE * f64::from(texture.pages));
        atlas.placed.push(placed);
    }
    Ok(atlas)
}

/// Charts that keep their positions relative to each other, as one map.
struct Group {
    /// Indices of the charts.
    members: Vec<usize>,
    uv: Vec<[f64; 2]>,
    triangles: Vec<[u32; 3]>,
    region: Option<Region>,
}

impl Group {
    /// Joins the charts of each group, in the order of their first charts.
    fn all(charts: &[ChartMap], constraints: &Constraints) -> Result<Vec<Self>, ConstraintError> {
        // In a joined map, an index that is out of range could name a vertex of another chart.
        outlines(charts)?;
        let mut groups: Vec<Self> = Vec::new();
        let mut index_of: BTreeMap<usize, usize> = BTreeMap::new();
        for (chart, map) in charts.iter().enumerate() {
            let new = Self {
                members: Vec::new(),
                uv: Vec::new(),
                triangles: Vec::new(),
                region: constraints.regions.get(chart).copied().flatten(),
            };
            let index = match constraints.groups.get(chart) {
                Some(&group) => *index_of.entry(group).or_insert(groups.len()),
                None => groups.len(),
            };
            if index == groups.len() {
                groups.push(new);
            }
            let group = &mut groups[index];
            let first = group.uv.len() as u32;
            group.members.push(chart);
            group.uv.extend(map.uv);
            (group.triangles).extend(map.triangles.iter().map(|t| t.map(|v| first + v)));
        }
        Ok(groups)
    }

    fn map(&self) -> ChartMap<'_> {
        ChartMap {
            uv: &self.uv,
            triangles: &self.triangles,
        }
    }

    /// Returns the places of the charts from those of their groups.
    fn split(groups: &[Self], placed: Vec<Placed>, charts: &[ChartMap]) -> Vec<Placed> {
        let mut of_charts = vec![Placed { grid: Vec::new() }; charts.len()];
        for (group, placed) in groups.iter().zip(placed) {
            let mut grid = placed.grid.into_iter();
            for &chart in &group.members {
                of_charts[chart].grid = grid.by_ref().take(charts[chart].uv.len()).collect();
            }
        }
        of_charts
    }
}

/// Charts to be packed, with the region of each, and the charts that stay.
pub(super) struct Problem<'a> {
    pub charts: &'a [ChartMap<'a>],
    /// Region of each chart; empty if no chart has one.
    pub regions: &'a [Option<Region>],
    pub obstacles: &'a [&'a Obstacle],
}

impl Problem<'_> {
    /// Packs the charts: on a coarse raster, squeezed, if that is possible; otherwise on a fine raster.
    fn packed(&self, options: &AtlasOptions, on_read: &OnRead) -> Result<Atlas, ConstraintError> {
        let charts = self.charts;
        let plan = Plan::largest_first(&outlines(charts)?, options);
        let n = plan.order.len();
        let mut slack = vec![SLACK; charts.len()];
        if options.scale == Scale::Largest && (1..=MOST_CHARTS).contains(&n) {
            let cells = options.most_cells.min(SQUEEZED_CELLS);
            let on_raster = self.on_raster((&plan, &slack), cells, (options, on_read));
            let layout = on_raster.and_then(|found| self.squeezed(&plan, &found, options, on_read));
            if let Some(layout) = layout {
                let snapped = on_grid(charts, &layout, Repair::Open);
                if !is_cramped(&snapped, &layout) {
                    return Ok(pack::atlas(charts, &layout, snapped, options));
                }
            }
        }
        for repair in [[Repair::Open; ROUNDS].as_slice(), &[Repair::Nothing]].concat() {
            let layout = self
                .on_raster((&plan, &slack), options.most_cells, (options, on_read))
                .ok_or(ConstraintError::NoRoom)?;
            let snapped = on_grid(charts, &layout, repair);
            if repair == Repair::Nothing || !is_cramped(&snapped, &layout) {
                return Ok(pack::atlas(charts, &layout, snapped, options));
            }
            give_room(&snapped, &layout, &mut slack);
        }
        Err(ConstraintError::NoRoom)
    }

    /// Returns a layout on a raster that keeps the padding by construction; `None` if the charts do not fit.
    pub(super) fn on_raster(
        &self,
        (plan, slack): (&Plan, &[f64]),
        most_cells: u32,
        (options, on_read): (&AtlasOptions, &OnRead),
    ) -> Option<Layout> {
        let texture = options.texture;
        let on_page = plan.order.len() / texture.pages.max(1) as usize;
        let cells = texture.raster(raster(on_page, most_cells));
        let padding = padding(options, plan.order.len().max(1), f64::from(cells));
        let mut packing = Packing {
            plan,
            slack,
            texture,
            cells,
            padding,
            border: (padding / 2.0).max(SLACK),
            on_read,
            is_alike: false,
            extent: Extent::Full,
            regions: self.regions,
            taken: None,
            free: f64::from(texture.pages) * texture.share(),
        };
        let occupied = self.taken(&packing);
        packing.taken = Some(&occupied);
        let sizes = self.obstacles.iter().map(|it| it.outline.size);
        let taken: f64 = sizes.map(|size| size * size).sum();
        packing.free = (packing.free - taken).max(LEAST_FREE * packing.free);
        let found = placed(&packing, options)?;
        Some(packing.layout(found, f64::from(cells), options))
    }

    /// Returns pages on which the charts that stay occupy cells.
    fn taken(&self, packing: &Packing) -> Occupancy {
        let whole = packing.whole();
        // Charts that stay may reach into the borders, which are free of others.
        let frame = (packing.reach() + packing.border).ceil() as u32 + FRAME;
        let mut occupancy = Occupancy::new(packing.form(), whole, frame, whole);
        for obstacle in self.obstacles {
            let (body, corner) = obstacle.body(packing.texture, packing.cells, packing.border);
            occupancy.cover(&body, obstacle.page, corner);
        }
        occupancy
    }

    /// Squeezes a layout, and brings charts exactly as near as permitted. Returns `None` if that fails, or if the layout has no room for
    /// the padding.
    fn squeezed(
        &self,
        plan: &Plan,
        found: &Layout,
        options: &AtlasOptions,
        on_read: &OnRead,
    ) -> Option<Layout> {
        let texture = options.texture;
        if found.padding_texels < f64::from(options.padding_texels) {
            return None;
        }
        let page = FINE * f64::from(texture.raster(raster_side(plan.order.len(), texture)));
        let padding = options.padding_share() * page;
        let scale = found.scale * page / texture.grid_side();
        let obstacles = self.obstacles.iter();
        let fixed = obstacles.map(|it| FixedBody::new(&it.outline, page, padding));
        let stays: Vec<Outline> = (self.obstacles.iter().map(|it| it.outline.clone())).collect();
        let squeezing = Squeezing {
            level: &plan.outlines,
            charts: &plan.order,
            scale,
            border: Border::Fixed,
            stays: &stays,
            options,
            on_read,
        };
        squeezing.settled_layout(self.poses((plan, found), page, fixed.collect(), options))
    }

    /// Returns the poses of a layout on pages with `page` cells along the longer side, in the order of the plan.
    pub(super) fn poses(
        &self,
        (plan, found): (&Plan, &Layout),
        page: f64,
        fixed: Arc<[FixedBody]>,
        options: &AtlasOptions,
    ) -> Squeezed {
        let texture = options.texture;
        let padding = options.padding_share() * page;
        let cell = page / texture.grid_side();
        let posed = |&chart: &usize| {
            let place = &found.charts[chart];
            let region = self.regions.get(chart).copied().flatten();
            let frame = texture.frame(region.unwrap_or(Region::page(place.page)));
            let [x, y] = place.middle(found.scale).map(|x| x * cell - padding / 2.0);
            let angle = plan.outlines[chart].angle_to(&place.outline);
            (Pose::new([x + frame.left * page, y], angle), frame)
        };
        Squeezed::new(plan.order.iter().map(posed), fixed, page, padding)
    }
}

/// Returns the scale, in cells per mesh unit, and a place for each chart; `None` if a chart finds no place.
fn placed(packing: &Packing, options: &AtlasOptions) -> Option<(f64, Attempt)> {
    let cells = f64::from(packing.cells);
    if packing.plan.order.is_empty() {
        // The unit of what stays is that of a page.
        return Some((cells, packing.attempt(cells, &mut 0).ok()?));
    }
    match options.scale {
        Scale::Largest => {
            let found = best(packing, options.budget_words)?;
            Some(grown(packing, found, options))
        }
        Scale::TexelsPerUnit(texels) => {
            let scale = texels * cells / f64::from(options.texture.resolution.longer());
            Some((scale, packing.attempt(scale, &mut 0).ok()?))
        }
    }
}

/// Factor of the scale for each trial order, and number of failed trials in a row, per unit of patience, that end the search.
const GROWTH: f64 = 1.004;
const MOST_IDLE: u64 = 100;
const SEED: u64 = 1;

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

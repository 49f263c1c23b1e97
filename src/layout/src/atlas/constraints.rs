//! Charts packed within constraints: in regions, in groups, and around islands that stay in place.
//!
//! Pages keep their size, so the search is for the largest scale of the charts. They are first placed on a raster on which the cells of
//! islands that stay are occupied, each where its region allows. Then all charts move at once while the pages shrink together with the
//! islands and the regions ([`squeeze`](super::squeeze)), which is the same as growing the charts.
use std::collections::BTreeMap;

use super::coarse::CoarseLayout;
use super::effort::OnRead;
use super::grid::{Repair, Snapped, doubled_area, snapped};
use super::layout::{Obstacle, Problem};
use super::outline::outlines;
use super::pack::{fullest, packed};
use super::page::{GRID_SIDE, Region, Texture};
use super::plan::Plan;
use super::problem::{Atlas, AtlasOptions, ChartMap, ConstraintError, Constraints, Placed, Stay};
use unwrapd_maps::plane::{BoxIndex, search_budget, segment_distance};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of, touch, widened};

/// Distance to which a chart may extend beyond its page, in units of u and v: less than half a step of the grid, so that rounding
/// brings it back.
const BEYOND: f64 = 1.0 / 33_554_432.0;
/// Tolerance of distances for rounding, in longer sides of a page.
const ROUNDED: f64 = 1e-9;

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
    let plan = Plan::of(&maps, options)?;
    let problem = Problem {
        plan: &plan,
        regions: &regions,
        obstacles: &obstacles,
        options,
        on_read,
    };
    let coarse = if problem.is_constrained() {
        None
    } else {
        CoarseLayout::of(&plan, options)
    };
    let exact = fullest(&problem, coarse.as_ref());
    let mut atlas = packed(&problem, &maps, exact).ok_or(ConstraintError::NoRoom)?;
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

/// A chart that stays on its page.
pub(super) struct Staying {
    pub obstacle: Obstacle,
    island: usize,
    bounds: Bounds,
    snapped: Snapped,
}

impl Staying {
    /// Checks that each chart lies within a page, and rounds it to the grid.
    pub(super) fn all(stays: &[Stay], texture: Texture) -> Result<Vec<Self>, ConstraintError> {
        let maps: Vec<ChartMap> = stays.iter().map(|stay| stay.map).collect();
        let outlined = outlines(&maps)?.into_iter().zip(stays);
        let staying = outlined.map(|(outline, stay)| {
            let corners: Vec<[f64; 2]> = outline.corners().collect();
            let bounds = bounds_of(&corners);
            let outline = outline.with_corner([0.0; 2]);
            let island = stay.island;
            let page = page(bounds, texture).ok_or(ConstraintError::OffPage { island })?;
            let snapped = snapped(&stay.map, &outline, texture.grid_side(), Repair::Open);
            Ok(Self {
                obstacle: Obstacle {
                    page,
                    slack: (snapped.largest_move + 1.0) / texture.grid_side(),
                    outline,
                },
                island,
                bounds,
                snapped,
            })
        });
        staying.collect()
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
        let Some([x, y]) = other.obstacle.outline.corners().next() else {
            return false;
        };
        let is_near = touch(&self.bounds, &[[x, y], [x, y]]);
        let crossings = self.obstacle.outline.edges().map(|[p, q]| {
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
        edges.extend(chart.obstacle.outline.edges());
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

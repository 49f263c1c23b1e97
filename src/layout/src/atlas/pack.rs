//! Packing: from chart maps to places on the grid.
use rayon::prelude::*;

use super::coarse::CoarseLayout;
use super::effort::{Effort, OnRead, UNHEARD};
use super::gap::squeezed_layout;
use super::given::{Given, Tidiness, given};
use super::grid::{Repair, Snapped, aligned, doubled_area, snapped};
use super::layout::{Layout, Problem, SLACK};
use super::outline::Outline;
use super::page::GRID_SIDE;
use super::plan::{MOST_CHARTS, Plan};
use super::problem::{
    Atlas, AtlasError, AtlasOptions, Borders, ChartMap, Limit, Placed, Positions, Scale,
};

/// Maximum number of layouts, each with more room for vertices that had to move farther than the last one allowed.
const ROUNDS: usize = 6;
/// Maximum number of cells along the side of the raster for charts within constraints that are then squeezed. On a raster that is four times as fine,
/// the search takes four times as long, and the squeezed layouts are no fuller.
const SQUEEZED_CELLS: u32 = 256;
/// Share of the largest scale that a chart permits from which on it is said to set the scale.
const LIMITING: f64 = 0.99;
/// Fill that straight charts may lose by lying along the axes.
const STRAIGHT: f64 = 0.02;

/// Places all charts on pages, at least the padding apart.
///
/// If all triangles of a chart are positive, they are positive on the grid, unless the grid is too coarse. Then, and if a chart has
/// flipped or degenerate triangles, it is rounded without repair. The atlas does not depend on the number of threads.
pub fn pack(charts: &[ChartMap], options: &AtlasOptions) -> Result<Atlas, AtlasError> {
    let coarse = CoarseLayout::new(charts, options)?;
    pack_coarse(charts, coarse.as_ref(), options, UNHEARD)
}

/// Like [`pack`], but starts from a coarse layout. Without one, and at first at a given scale, the largest charts are placed first.
pub fn pack_coarse(
    charts: &[ChartMap],
    coarse: Option<&CoarseLayout>,
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Result<Atlas, AtlasError> {
    let plan = match coarse {
        Some(coarse) => coarse.plan.clone(),
        None => Plan::of(charts, options)?,
    };
    let atlas = pack_plan(charts, &plan, coarse, options, on_read)?;
    let limit = limit(&atlas, &plan.outlines, options);
    Ok(Atlas { limit, ..atlas })
}

fn pack_plan(
    charts: &[ChartMap],
    plan: &Plan,
    coarse: Option<&CoarseLayout>,
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Result<Atlas, AtlasError> {
    let problem = Problem::free(plan, options, on_read);
    let exact = match options.positions {
        _ if is_placed_once(&problem) => None,
        Positions::Unrelated => fullest(&problem, coarse),
        Positions::Layout => fuller(
            fullest(&problem, coarse),
            given(charts, options, on_read)?,
            options,
        ),
    };
    packed(&problem, charts, exact).ok_or(match options.scale {
        Scale::Largest => AtlasError::TooManyCharts {
            charts: charts.len(),
        },
        Scale::TexelsPerUnit(_) => AtlasError::TextureTooSmall,
    })
}

/// Returns the fullest layout that keeps exactly the padding: one that is searched from a coarse layout, or one on the raster that is
/// squeezed.
pub(super) fn fullest(problem: &Problem, coarse: Option<&CoarseLayout>) -> Option<Layout> {
    let options = problem.options;
    if let Some(coarse) = coarse.filter(|coarse| !coarse.is_crowded()) {
        return searched(coarse, options, problem.on_read);
    }
    let plan = problem.plan;
    if options.scale != Scale::Largest || plan.order.len() > MOST_CHARTS || !plan.has_area() {
        return None;
    }
    let slack = vec![SLACK; problem.plan.outlines.len()];
    let cells = if problem.is_constrained() {
        SQUEEZED_CELLS
    } else {
        u32::MAX
    };
    let on_raster = |plan: Plan| {
        let problem = Problem {
            plan: &plan,
            ..*problem
        };
        let layout = problem.layout(&slack, options.most_cells.min(cells))?;
        Some((plan, layout))
    };
    let any = on_raster(problem.plan.clone());
    let straight = problem.plan.straightened().and_then(on_raster);
    let least = any
        .as_ref()
        .map_or(0.0, |(_, any)| any.fill(options) - STRAIGHT);
    let (plan, found) = straight
        .filter(|(_, straight)| straight.fill(options) >= least)
        .or(any)?;
    let problem = Problem {
        plan: &plan,
        ..*problem
    };
    let squeezed = squeezed_layout(&problem, &found);
    Some(
        squeezed
            .filter(|it| it.scale > found.scale)
            .unwrap_or(found),
    )
}

/// Rounds an exact layout, or one on the raster, to the grid. Lays charts out anew on the raster, with more room, while a vertex has to
/// move farther than its chart has room for. Returns `None` if the charts do not fit.
pub(super) fn packed(
    problem: &Problem,
    charts: &[ChartMap],
    exact: Option<Layout>,
) -> Option<Atlas> {
    let options = problem.options;
    if let Some(layout) = exact {
        let snapped = on_grid(charts, &layout, Repair::Open);
        if !is_cramped(&snapped, &layout) {
            return Some(atlas(charts, &layout, snapped, options));
        }
    }
    let mut slack = vec![SLACK; charts.len()];
    for _ in 0..ROUNDS {
        let layout = problem.layout(&slack, options.most_cells)?;
        let snapped = on_grid(charts, &layout, Repair::Open);
        if !is_cramped(&snapped, &layout) {
            return Some(atlas(charts, &layout, snapped, options));
        }
        give_room(&snapped, &layout, &mut slack);
    }
    let layout = problem.layout(&slack, options.most_cells)?;
    let rounded = on_grid(charts, &layout, Repair::Nothing);
    Some(atlas(charts, &layout, rounded, options))
}

/// Returns the fuller of a layout that was searched and the given one, which has to be fuller by [`STRAIGHT`] if straight charts lean.
fn fuller(exact: Option<Layout>, given: Option<Given>, options: &AtlasOptions) -> Option<Layout> {
    let Some(Given { layout, tidiness }) = given else {
        return exact;
    };
    let advantage = match tidiness {
        Tidiness::Straight => 0.0,
        Tidiness::Leaning => STRAIGHT,
    };
    exact
        .filter(|exact| exact.fill(options) >= layout.fill(options) - advantage)
        .or(Some(layout))
}

/// Returns whether a vertex moves farther than its chart has room for.
fn is_cramped(snapped: &[Snapped], layout: &Layout) -> bool {
    let mut charts = snapped.iter().zip(&layout.charts);
    charts.any(|(snapped, place)| snapped.needed() > place.room)
}

/// Enlarges the slack, in cells, of every chart with a vertex that moves farther than the chart has room for.
fn give_room(snapped: &[Snapped], layout: &Layout, slack: &mut [f64]) {
    for ((snapped, place), slack) in snapped.iter().zip(&layout.charts).zip(slack) {
        if snapped.needed() > place.room {
            *slack = 1.5 * snapped.needed() / layout.cell;
        }
    }
}

/// Returns whether charts fit at the prescribed scale if each is placed once, the largest first.
pub fn fits(charts: &[ChartMap], options: &AtlasOptions) -> Result<bool, AtlasError> {
    let plan = Plan::of(charts, options)?;
    let problem = Problem::free(&plan, options, UNHEARD);
    Ok(is_placed_once(&problem))
}

/// Returns whether charts fit at the prescribed scale, if there is one, without a search.
fn is_placed_once(problem: &Problem) -> bool {
    let Problem { plan, options, .. } = *problem;
    let slack = vec![SLACK; plan.outlines.len()];
    options.scale != Scale::Largest && problem.layout(&slack, options.most_cells).is_some()
}

/// Searches for the fullest layout. Straight charts lie along the axes unless other angles fill more than [`STRAIGHT`] more of the
/// squeezed page. One search tells whether they do. At a prescribed scale they may lie at any angle, since a little less fill may be too
/// little.
fn searched(coarse: &CoarseLayout, options: &AtlasOptions, on_read: &OnRead) -> Option<Layout> {
    let any = searched_once(coarse.clone(), options, on_read);
    let least = any.fill() - STRAIGHT;
    let straight = coarse
        .straightened()
        .filter(|it| options.scale == Scale::Largest && it.most_fill() >= least)
        .map(|straight| searched_once(straight, options, on_read))
        .filter(|it| it.fill() >= least);
    searched_further(straight.unwrap_or(any), options, on_read)
}

/// Searches unless that was done before, or the options permit no search.
fn searched_once(
    mut coarse: CoarseLayout,
    options: &AtlasOptions,
    on_read: &OnRead,
) -> CoarseLayout {
    if !coarse.is_searched() && options.patience > 0 {
        let words = Effort::High.words(coarse.n_charts());
        coarse.improve(Effort::High, words.min(options.budget_words), on_read);
    }
    coarse
}

/// Returns the approximate number of words that [`pack`] reads.
pub fn expected_words(n_charts: usize, options: &AtlasOptions) -> u64 {
    (options.patience * Effort::High.words(n_charts)).min(options.budget_words)
}

/// Searches from more seeds, and brings charts exactly as near as permitted. As more patience only adds seeds and
/// the fullest result counts, it never gives an emptier page.
fn searched_further(
    mut coarse: CoarseLayout,
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Option<Layout> {
    let words = Effort::High.words(coarse.n_charts());
    // The first search was made before.
    let mut left = options.budget_words.saturating_sub(words);
    let mut fullest: Option<Layout> = None;
    for round in 1..=options.patience {
        let before = coarse.fill();
        if round > 1 {
            coarse.improve(Effort::High, words.min(left), on_read);
            left = left.saturating_sub(words);
        }
        if round == 1 || coarse.fill() > before {
            let exact = coarse.with_exact_gap(options, on_read);
            let scale = |exact: &Option<Layout>| exact.as_ref().map_or(0.0, |it| it.scale);
            if scale(&exact) > scale(&fullest) {
                fullest = exact;
            }
        }
    }
    fullest
}

/// Rounds each chart to the grid, at the origin.
fn on_grid(charts: &[ChartMap], layout: &Layout, repair: Repair) -> Vec<Snapped> {
    let charts = charts.par_iter().zip(&layout.charts);
    charts
        .map(|(map, place)| snapped(map, &place.outline, layout.scale * place.stretch, repair))
        .collect()
}

/// Shifts each rounded chart to its place on its page.
fn atlas(
    charts: &[ChartMap],
    layout: &Layout,
    snapped: Vec<Snapped>,
    options: &AtlasOptions,
) -> Atlas {
    let texture = options.texture;
    let moved_vertices = snapped.iter().map(|s| s.moved).sum();
    let largest_move = snapped.iter().map(|s| s.largest_move).fold(0.0, f64::max);
    let texel = texture.grid_side() as i32 / texture.resolution.longer().max(1) as i32;
    let places = snapped.into_iter().zip(&layout.charts);
    let placed: Vec<Placed> = (charts.iter().zip(places))
        .map(|(map, (snapped, place))| {
            if map.triangles.is_empty() {
                return Placed {
                    grid: vec![[0; 2]; map.uv.len()],
                };
            }
            let [x, y] = place.corner.map(|x| x.round() as i32);
            let shifted = snapped.grid.iter().map(|[i, j]| [x + i, y + j]).collect();
            let grid = match options.borders {
                Borders::Free => shifted,
                Borders::OnTexels => aligned(map, shifted, texel),
            };
            let on_page = grid.into_iter().map(|p| texture.on_page(place.page, p));
            Placed {
                grid: on_page.collect(),
            }
        })
        .collect();
    let doubled = |(map, placed): (&ChartMap, &Placed)| {
        let of = |t: &[u32; 3]| doubled_area(t.map(|v| placed.grid[v as usize])) as f64;
        map.triangles.iter().map(of).sum::<f64>()
    };
    let covered: f64 = charts.iter().zip(&placed).map(doubled).sum();
    Atlas {
        placed,
        scale: layout.scale / texture.grid_side(),
        utilization: covered / (2.0 * GRID_SIDE * GRID_SIDE * f64::from(texture.pages)),
        padding_texels: layout.padding_texels,
        enlarged_charts: layout
            .charts
            .iter()
            .filter(|place| place.stretch > 1.0)
            .count(),
        moved_vertices,
        largest_move,
        limit: None,
    }
}

/// Returns the chart that alone sets the scale of an atlas, if there is one.
fn limit(atlas: &Atlas, outlines: &[Outline], options: &AtlasOptions) -> Option<Limit> {
    // A straight chart that lies along the axes could lie at another angle.
    let side = |outline: &Outline| outline.least_page(options.rotation, options.texture);
    let sides = outlines.iter().map(side).enumerate();
    let (chart, longest) = sides.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let most = (1.0 - options.padding_share()) / longest;
    (options.scale == Scale::Largest && atlas.scale >= LIMITING * most).then(|| Limit {
        chart,
        utilization: atlas.utilization * (most / atlas.scale).max(1.0).powi(2),
    })
}

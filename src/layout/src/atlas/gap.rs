//! Layouts in which charts are exactly as far apart as they have to be.
//!
//! A raster of cells keeps charts up to a cell too far apart, or slightly too near. Here, charts are squeezed on a finer raster,
//! their distances are measured, and they are given the room that is still missing.
use rayon::prelude::*;
use std::sync::Arc;

use super::layout::{Layout, Place, Problem, stretch};
use super::outline::Outline;
use super::page::{FINE, Region};
use super::problem::Scale;
use super::squeeze::{Body, FixedBody, Pose, Squeezed};
use unwrapd_maps::plane::{BoxIndex, Segment, Visit, search_budget, segment_distance};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of};

/// Maximum number of rounds that correct the room between charts.
const ROUNDS: usize = 4;
/// Room added beyond what is missing, in cells.
const SPARE: f64 = 0.01;
/// Distance by which rounding may move a vertex, in cells.
const ROUNDED: f64 = 0.002;
/// Smallest share by which charts are spread if no round keeps them far enough apart; it is doubled up to [`SPREADS`] times.
const LEAST_SPREAD: f64 = 1e-4;
const SPREADS: u32 = 8;
/// Share of the scale for which charts that are too small for the grid are enlarged, since the final scale may be a little smaller.
const SMALLER: f64 = 0.98;

/// Charts whose distances are measured and corrected.
struct Measuring<'a> {
    problem: &'a Problem<'a>,
    /// Cells per mesh unit.
    scale: f64,
}

/// Squeezes charts from where they lie, and brings them exactly as near as permitted. Returns `None` if they could not be brought far
/// enough apart, or if they do not fit at a prescribed scale.
pub(super) fn squeezed(problem: &Problem, start: Squeezed) -> Option<Layout> {
    let scale = start.scale;
    Measuring { problem, scale }.layout(start)
}

/// Squeezes a layout on the raster. Returns `None` if that fails, or if the layout has no room for the padding.
pub(super) fn squeezed_layout(problem: &Problem, found: &Layout) -> Option<Layout> {
    let Problem { plan, options, .. } = *problem;
    if found.padding_texels < f64::from(options.padding_texels) {
        return None;
    }
    let texture = options.texture;
    let page = FINE * f64::from(texture.raster(texture.coarse_cells(plan.order.len())));
    let padding = options.padding_share() * page;
    let obstacles = problem.obstacles.iter();
    let fixed = obstacles.map(|it| FixedBody::new(&it.outline, page, padding));
    squeezed(problem, poses(problem, found, page, fixed.collect()))
}

impl Measuring<'_> {
    /// Returns a layout near squeezed charts in which they keep the padding; `None` if there is none.
    fn layout(&self, mut squeezed: Squeezed) -> Option<Layout> {
        let kept = squeezed.padding;
        let Problem { plan, options, .. } = *self.problem;
        let charts = plan.order.par_iter();
        let body = |&chart: &usize| Arc::new(Body::new(&plan.outlines[chart], self.scale, kept));
        let bodies: Vec<Arc<Body>> = charts.map(body).collect();
        let padding = self.padding(squeezed.side);
        squeezed.padding = padding + 2.0 * ROUNDED;
        let (mut room, mut best) = (padding - kept, None);
        for _ in 0..ROUNDS {
            let words = options.budget_words / ROUNDS as u64;
            if !squeezed.loosen(&bodies, room, words, self.problem.on_read) {
                break;
            }
            let (places, missing) = self.measured(&squeezed);
            if missing <= 0.0 && self.fits(&places) {
                best = Some(places);
            }
            if (-2.0 * SPARE..=0.0).contains(&missing) {
                break;
            }
            room += missing + SPARE;
        }
        // Where charts overlap, the distance that is missing is not known.
        let spread = || {
            let mut shares = (0..SPREADS).map(|power| LEAST_SPREAD * f64::from(1 << power));
            shares.find_map(|share| {
                let (places, missing) = self.measured(&squeezed.spread(1.0 + share));
                (missing <= 0.0 && self.fits(&places)).then_some(places)
            })
        };
        self.on_grid(best.or_else(spread)?)
    }

    /// Returns whether the page has room for the places, which matters at a prescribed scale, and each frame for its chart.
    fn fits(&self, places: &Places) -> bool {
        // Frames have a margin of [`ROUNDED`].
        self.around(places.side) <= self.page(places.side) && places.overhang <= ROUNDED / 2.0
    }

    /// Places charts as squeezed, and measures the distance that is missing between two of them, in cells; negative if they are farther
    /// apart than they have to be.
    fn measured(&self, squeezed: &Squeezed) -> (Places, f64) {
        let padded = Squeezed {
            padding: self.padding(squeezed.side) + 2.0 * ROUNDED,
            ..squeezed.clone()
        };
        let mut places = Places::new(self, &padded);
        // Pages end where their charts end, unless charts have frames, or keep clear of islands, which are given relative to the page.
        places.side = if self.problem.is_constrained() {
            squeezed.side
        } else {
            self.side(places.reach)
        };
        let missing = self.padding(places.side) + 2.0 * ROUNDED - places.gap;
        (places, missing)
    }

    /// Returns the longer side, without borders, of the smallest page on which charts may extend to `reach`, to the right and up.
    fn side(&self, reach: [f64; 2]) -> f64 {
        let frame = self.problem.options.texture.frame(Region::page(0));
        let least = self.padding(0.0);
        frame.side(reach, [least + 2.0 * ROUNDED, self.padding(1.0) - least])
    }

    /// Returns the cells per texel if the longer side of a page, without borders, is `side`.
    fn texel(&self, side: f64) -> f64 {
        let longer = f64::from(self.problem.options.texture.resolution.longer());
        match self.problem.options.scale {
            Scale::Largest => side / (longer - f64::from(self.problem.options.packed_texels())),
            Scale::TexelsPerUnit(texels) => self.scale / texels,
        }
    }

    /// Returns the cells kept between charts.
    fn padding(&self, side: f64) -> f64 {
        f64::from(self.problem.options.packed_texels()) * self.texel(side)
    }

    /// Returns the cells along the longer side of the page that charts need, with borders.
    fn around(&self, side: f64) -> f64 {
        side + self.padding(side) + 2.0 * ROUNDED
    }

    /// Returns the cells along the longer side of a page, which a prescribed scale determines.
    fn page(&self, side: f64) -> f64 {
        match self.problem.options.scale {
            Scale::Largest => self.around(side),
            Scale::TexelsPerUnit(_) => {
                f64::from(self.problem.options.texture.resolution.longer()) * self.texel(side)
            }
        }
    }

    /// Converts places from cells to grid steps. Returns `None` if a chart would be too small for the grid.
    fn on_grid(&self, places: Places) -> Option<Layout> {
        let cell = self.problem.options.texture.grid_side() / self.page(places.side);
        let scale = self.scale * cell;
        let border = self.padding(places.side) / 2.0 + ROUNDED;
        let is_small = |place: &Place| stretch(&place.outline, scale) > place.stretch;
        if places.charts.iter().any(is_small) {
            return None;
        }
        let nowhere = |outline: &Outline| Place {
            outline: outline.clone(),
            page: 0,
            corner: [0.0; 2],
            stretch: 1.0,
            room: 0.0,
        };
        let mut charts: Vec<Place> = self.problem.plan.outlines.iter().map(nowhere).collect();
        for (&chart, place) in self.problem.plan.order.iter().zip(places.charts) {
            charts[chart] = Place {
                corner: place.corner.map(|x| (border + x) * cell),
                room: ROUNDED * cell,
                ..place
            };
        }
        Some(Layout {
            scale,
            cell,
            padding_texels: f64::from(self.problem.options.padding_texels),
            charts,
        })
    }
}

/// Returns the poses of a layout on pages with `page` cells along the longer side, in the order of the plan.
pub(super) fn poses(
    problem: &Problem,
    found: &Layout,
    page: f64,
    fixed: Arc<[FixedBody]>,
) -> Squeezed {
    let texture = problem.options.texture;
    let padding = problem.options.padding_share() * page;
    let cell = page / texture.grid_side();
    let posed = problem.plan.order.iter().map(|&chart| {
        let place = &found.charts[chart];
        let region = problem.regions.get(chart).copied().flatten();
        let frame = texture.frame(region.unwrap_or(Region::page(place.page)));
        let [x, y] = (place.middle(found.scale)).map(|x| x * cell - padding / 2.0);
        let angle = problem.plan.outlines[chart].angle_to(&place.outline);
        (Pose::new([x + frame.left * page, y], angle), frame)
    });
    let scale = found.scale * cell;
    Squeezed::new(posed, fixed, page, padding, scale)
}

/// Places of squeezed charts in cells, without borders.
struct Places {
    charts: Vec<Place>,
    /// Largest extents of the charts to the right and up, in cells.
    reach: [f64; 2],
    /// Longer side, without borders, of the page that the charts need, in cells.
    side: f64,
    /// Smallest distance between two charts, in cells.
    gap: f64,
    /// Largest distance by which a chart leaves its frame, in cells; 0 if all are inside, or if the page is cropped.
    overhang: f64,
}

impl Places {
    /// Places charts as squeezed; in their frames if they are constrained.
    fn new(measuring: &Measuring, squeezed: &Squeezed) -> Self {
        let problem = measuring.problem;
        let is_fixed = problem.is_constrained();
        let level = &problem.plan.outlines;
        let cells = squeezed.side + squeezed.padding;
        let unit = SMALLER * measuring.scale * problem.options.texture.grid_side() / cells;
        let mut places = Self {
            charts: Vec::with_capacity(problem.plan.order.len()),
            reach: [0.0; 2],
            side: 0.0,
            gap: 0.0,
            overhang: 0.0,
        };
        let mut edges: Vec<Segment> = Vec::new();
        let mut owners = Vec::new();
        let posed = problem.plan.order.iter().zip(&squeezed.poses);
        for ((&chart, pose), frame) in posed.zip(squeezed.frames.iter()) {
            let outline = level[chart].rotated(pose.angle);
            let middle = outline.place(level[chart].middle());
            let left = [frame.left * cells, 0.0];
            let bounds = frame.bounds(squeezed.side, squeezed.padding);
            let [low, high] = bounds.map(|end| [0, 1].map(|k| end[k] - left[k]));
            let stretch = stretch(&outline, unit);
            let scale = stretch * measuring.scale;
            let corner = [0, 1].map(|k| {
                let extent = outline.extent[k] * scale;
                let corner = (pose.middle[k] - middle[k] * scale - left[k]).max(0.0);
                let corner = if is_fixed {
                    corner.min(high[k] - extent).max(low[k])
                } else {
                    corner
                };
                let far = corner + extent;
                places.reach[k] = places.reach[k].max(far);
                if is_fixed {
                    places.overhang = places.overhang.max(far - high[k]);
                }
                corner
            });
            let place = |p: [f64; 2]| [0, 1].map(|k| left[k] + corner[k] + p[k] * scale);
            edges.extend(outline.edges().map(|edge| edge.map(place)));
            owners.resize(edges.len(), places.charts.len() as u32);
            places.charts.push(Place {
                outline,
                page: frame.page,
                corner,
                stretch,
                room: 0.0,
            });
        }
        for obstacle in problem.obstacles {
            let place = |p: [f64; 2]| p.map(|x| x * cells - squeezed.padding / 2.0);
            edges.extend(obstacle.outline.edges().map(|edge| edge.map(place)));
        }
        // Islands keep no distance from each other.
        owners.resize(edges.len(), problem.plan.order.len() as u32);
        places.gap = smallest_gap(&edges, &owners);
        places
    }
}

/// Returns the smallest distance between edges of two charts; infinite for a single chart, and 0 if the search was truncated.
pub(super) fn smallest_gap(edges: &[Segment], charts: &[u32]) -> f64 {
    let boxes: Vec<Bounds> = edges.iter().map(|edge| bounds_of(edge)).collect();
    let distance = |i: u32, j: u32| segment_distance(edges[i as usize], edges[j as usize]);
    match BoxIndex::new(&boxes).closest(charts, search_budget(edges.len()), distance) {
        (gap, Visit::Complete) => gap,
        (_, Visit::Truncated) => 0.0,
    }
}

//! Layouts in which charts are exactly as far apart as they have to be.
//!
//! A raster of cells keeps charts up to a cell too far apart, or slightly too near. Here, charts are squeezed on a finer raster,
//! their distances are measured, and they are given the room that is still missing.
use rayon::prelude::*;
use std::sync::Arc;

use super::effort::OnRead;
use super::layout::{Layout, stretch};
use super::occupancy::{Corner, Spot};
use super::outline::Outline;
use super::page::Region;
use super::problem::{AtlasOptions, Scale};
use super::squeeze::{Body, Squeezed};
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
/// Each of these rounds reads about one part in `SHARE` of the word budget at most.
const SHARE: u64 = 16;
/// Share of the scale for which charts that are too small for the grid are enlarged, since the final scale may be a little smaller.
const SMALLER: f64 = 0.98;
/// Number of positions per cell, along each axis, to which charts are rounded.
const PLACES: f64 = 256.0;

/// Squeezed charts of one page.
#[derive(Clone)]
pub(super) struct Page {
    pub number: u32,
    /// Indices of the charts, in the order of the poses.
    pub charts: Vec<usize>,
    pub squeezed: Squeezed,
    pub border: Border,
    /// Outlines of the islands that stay, in longer sides of a page from the lower left corner of the first one.
    pub stays: Arc<[Outline]>,
}

impl Page {
    /// Creates a page without islands that stay, which ends where its charts end.
    pub(super) fn cropped(number: u32, charts: Vec<usize>, squeezed: Squeezed) -> Self {
        Self {
            number,
            charts,
            squeezed,
            border: Border::Cropped,
            stays: Arc::default(),
        }
    }
}

/// Relation of a page to the charts on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Border {
    /// The page ends where its charts end.
    Cropped,
    /// Charts have frames, or keep clear of islands, which are given relative to the page.
    Fixed,
}

/// Returns the turned outlines and a layout near squeezed pages in which charts keep the padding. Returns `None` if charts could
/// not be brought far enough apart, or if they do not fit at a prescribed scale.
///
/// The returned outlines are `level` turned by the angles of the squeezed poses. `scale` is in cells per mesh unit.
pub(super) fn layout(
    level: &[&Outline],
    pages: &[Page],
    scale: f64,
    (options, on_read): (&AtlasOptions, &OnRead),
) -> Option<(Vec<Outline>, Layout)> {
    let tight = Tight {
        level,
        scale,
        options,
        on_read,
    };
    let placed = (0..pages.len()).map(|i| {
        let others = pages.iter().enumerate().filter(|&(j, _)| j != i);
        let least = others.map(|(_, page)| page.squeezed.side);
        tight.places(&pages[i], least.fold(0.0, f64::max))
    });
    tight.layout(pages, placed.collect::<Option<_>>()?)
}

/// Squeezes the charts of a page, then places them as [`layout`] does. Reads at most half of the word budget.
pub(super) fn settled_layout(
    outlines: &[Outline],
    mut page: Page,
    scale: f64,
    (options, on_read): (&AtlasOptions, &OnRead),
) -> Option<(Vec<Outline>, Layout)> {
    let body = |&chart: &usize| Arc::new(Body::new(&outlines[chart], scale, page.squeezed.padding));
    let bodies: Vec<Arc<Body>> = page.charts.iter().map(body).collect();
    let words = options.budget_words / 2;
    let is_apart = page.squeezed.settle(&bodies, words, on_read);
    let level: Vec<&Outline> = outlines.iter().collect();
    is_apart
        .then(|| layout(&level, &[page], scale, (options, on_read)))
        .flatten()
}

/// Charts to be placed, on a raster of `scale` cells per mesh unit.
struct Tight<'a> {
    level: &'a [&'a Outline],
    /// Cells per mesh unit.
    scale: f64,
    options: &'a AtlasOptions,
    on_read: &'a OnRead<'a>,
}

impl Tight<'_> {
    /// Places the charts of a page as near to each other as permitted if the longer side of the largest page is at least `least`.
    /// Returns `None` if they cannot be kept far enough apart.
    fn places(&self, page: &Page, least: f64) -> Option<Places> {
        let mut squeezed = page.squeezed.clone();
        let kept = self.padding(squeezed.side);
        squeezed.padding = kept + 2.0 * ROUNDED;
        let level: Vec<&Outline> = page.charts.iter().map(|&chart| self.level[chart]).collect();
        let bodies: Vec<Arc<Body>> = (level.par_iter())
            .map(|outline| Arc::new(Body::new(outline, self.scale, kept)))
            .collect();
        let (mut room, mut best) = (0.0, None);
        for _ in 0..ROUNDS {
            let words = self.options.budget_words / SHARE;
            if !squeezed.loosen(&bodies, room, (words, self.on_read)) {
                break;
            }
            let (places, missing) = self.measured(&level, page, &squeezed, least);
            if missing <= 0.0 && self.fits(&places) {
                best = Some(places);
            }
            if (-2.0 * SPARE..=0.0).contains(&missing) {
                break;
            }
            room += missing + SPARE;
        }
        // Where charts overlap, the distance that is missing is not known.
        best.or_else(|| {
            let mut shares = (0..SPREADS).map(|power| LEAST_SPREAD * f64::from(1 << power));
            shares.find_map(|share| {
                let spread = squeezed.spread(1.0 + share);
                let (places, missing) = self.measured(&level, page, &spread, least);
                (missing <= 0.0 && self.fits(&places)).then_some(places)
            })
        })
    }

    /// Returns whether the page has room for the places, which matters at a prescribed scale, and each frame for its chart.
    fn fits(&self, places: &Places) -> bool {
        self.around(places.side) <= self.page(places.side) && places.overhang <= 0.0
    }

    /// Places charts as squeezed, and measures the distance that is missing between two of them, in cells; negative if they are farther
    /// apart than they have to be.
    fn measured(
        &self,
        level: &[&Outline],
        page: &Page,
        squeezed: &Squeezed,
        least: f64,
    ) -> (Places, f64) {
        let page = Page {
            squeezed: Squeezed {
                padding: self.padding(squeezed.side) + 2.0 * ROUNDED,
                ..squeezed.clone()
            },
            ..page.clone()
        };
        let grid_side = self.options.texture.grid_side();
        let mut places = Places::new(level, &page, self.scale, grid_side);
        places.side = match page.border {
            Border::Cropped => self.side(places.reach),
            Border::Fixed => squeezed.side,
        };
        let missing = self.padding(places.side.max(least)) + 2.0 * ROUNDED - places.gap;
        (places, missing)
    }

    /// Returns the longer side, without borders, of the smallest page on which charts may extend to `reach`, to the right and up.
    fn side(&self, reach: [f64; 2]) -> f64 {
        let frame = self.options.texture.frame(Region::page(0));
        let least = self.padding(0.0);
        frame.side(reach, [least + 2.0 * ROUNDED, self.padding(1.0) - least])
    }

    /// Returns the cells per texel if the longer side of the largest page, without borders, is `side`.
    fn texel(&self, side: f64) -> f64 {
        let longer = f64::from(self.options.texture.resolution.longer());
        match self.options.scale {
            Scale::Largest => side / (longer - f64::from(self.options.packed_texels())),
            Scale::TexelsPerUnit(texels) => self.scale / texels,
        }
    }

    /// Returns the cells kept between charts.
    fn padding(&self, side: f64) -> f64 {
        f64::from(self.options.packed_texels()) * self.texel(side)
    }

    /// Returns the cells along the longer side of the page that charts need, with borders.
    fn around(&self, side: f64) -> f64 {
        side + self.padding(side) + 2.0 * ROUNDED
    }

    /// Returns the cells along the longer side of a page, which a prescribed scale determines.
    fn page(&self, side: f64) -> f64 {
        match self.options.scale {
            Scale::Largest => self.around(side),
            Scale::TexelsPerUnit(_) => {
                f64::from(self.options.texture.resolution.longer()) * self.texel(side)
            }
        }
    }

    fn layout(&self, pages: &[Page], placed: Vec<Places>) -> Option<(Vec<Outline>, Layout)> {
        let sides = placed.iter().map(|places| places.side);
        let side = sides.max_by(f64::total_cmp)?;
        let padding = self.padding(side);
        let cell = self.options.texture.grid_side() / (PLACES * self.page(side));
        let scale = PLACES * self.scale * cell;
        let mut outlines: Vec<Outline> = self.level.iter().copied().cloned().collect();
        let mut charts = vec![(Spot::default(), 1.0); outlines.len()];
        for (page, places) in pages.iter().zip(placed) {
            let mut stretched = places.outlines.iter().zip(&places.stretches);
            let is_small = |(outline, &by): (&Outline, &f64)| stretch(outline, scale) > by;
            if places.gap < padding + 2.0 * ROUNDED || stretched.any(is_small) {
                return None;
            }
            let placed = places.outlines.into_iter().zip(places.corners);
            let placed = placed.zip(places.stretches);
            for (&chart, ((outline, corner), stretch)) in page.charts.iter().zip(placed) {
                outlines[chart] = outline;
                charts[chart].1 = stretch;
                charts[chart].0.corner = Corner {
                    page: page.number + corner.page,
                    ..corner
                };
            }
        }
        let layout = Layout {
            scale,
            cell,
            border: PLACES * (padding / 2.0 + ROUNDED),
            spare: PLACES * ROUNDED,
            padding_texels: f64::from(self.options.padding_texels),
            charts,
        };
        Some((outlines, layout))
    }
}

/// Charts at rounded positions on one page.
struct Places {
    outlines: Vec<Outline>,
    /// Factor by which each chart exceeds the common scale.
    stretches: Vec<f64>,
    /// Lower left corners, in units of 1/[`PLACES`] of a cell.
    corners: Vec<Corner>,
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
    /// Rounds the positions of squeezed charts. Keeps them in their frames if the border is fixed.
    fn new(level: &[&Outline], page: &Page, scale: f64, grid_side: f64) -> Self {
        let Page {
            squeezed, border, ..
        } = page;
        let cells = squeezed.side + squeezed.padding;
        let mut places = Self {
            outlines: Vec::with_capacity(level.len()),
            stretches: Vec::with_capacity(level.len()),
            corners: Vec::with_capacity(level.len()),
            reach: [0.0; 2],
            side: 0.0,
            gap: 0.0,
            overhang: 0.0,
        };
        let mut edges: Vec<Segment> = Vec::new();
        let mut charts = Vec::new();
        let posed = level
            .iter()
            .zip(&squeezed.poses)
            .zip(squeezed.frames.iter());
        for ((level, pose), frame) in posed {
            let outline = level.rotated(pose.angle);
            let middle = outline.place(level.middle());
            let left = [frame.left * cells, 0.0];
            let [low, high] = frame.bounds(squeezed.side, squeezed.padding);
            let stretch = stretch(&outline, SMALLER * scale * grid_side / cells);
            let scale = stretch * scale;
            let rounded = [0, 1].map(|k| {
                let extent = outline.extent[k] * scale;
                let corner = pose.middle[k] - middle[k] * scale - left[k];
                let corner = (corner * PLACES).round().max(0.0);
                let corner = match border {
                    Border::Cropped => corner,
                    Border::Fixed => corner
                        .min(((high[k] - left[k] - extent) * PLACES).floor())
                        .max(((low[k] - left[k]) * PLACES).ceil()),
                };
                let far = corner / PLACES + extent;
                places.reach[k] = places.reach[k].max(far);
                if *border == Border::Fixed {
                    places.overhang = places.overhang.max(far + left[k] - high[k]);
                }
                corner
            });
            let place = |p: [f64; 2]| [0, 1].map(|k| left[k] + rounded[k] / PLACES + p[k] * scale);
            edges.extend(outline.edges().map(|edge| edge.map(place)));
            charts.resize(edges.len(), places.outlines.len() as u32);
            places.outlines.push(outline);
            places.stretches.push(stretch);
            places.corners.push(Corner {
                page: frame.page,
                x: rounded[0] as u32,
                y: rounded[1] as u32,
            });
        }
        for outline in page.stays.iter() {
            let place = |p: [f64; 2]| p.map(|x| x * cells - squeezed.padding / 2.0);
            edges.extend(outline.edges().map(|edge| edge.map(place)));
        }
        // Islands keep no distance from each other.
        charts.resize(edges.len(), level.len() as u32);
        places.gap = smallest_gap(&edges, &charts);
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

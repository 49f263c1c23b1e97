//! The scale of the atlas and a place for every chart.
//!
//! For a given scale the charts are placed greedily, the largest first, each where the used square
//! grows least. The scale is then corrected by what came out, a few times; the best attempt counts.
//! What an attempt costs is counted in words read, not in seconds, so the result is the same on
//! every machine.
use rayon::prelude::*;
use std::collections::HashMap;

use super::mask::{Distances, Mask};
use super::outline::Outline;
use super::sheet::{Sheet, Spot, Turned};
use super::{AtlasOptions, GRID_SIDE};

/// Where all charts lie.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// Grid units per mesh unit.
    pub scale: f64,
    /// Grid units per cell.
    pub cell: f64,
    /// Free cells at each border.
    pub border: f64,
    /// Distance kept between charts, in texels.
    pub padding_texels: f64,
    /// For each chart its place, and the factor by which it exceeds the common scale.
    pub charts: Vec<(Spot, f64)>,
}

/// How far a vertex may end up from its exact position, in cells, without another layout.
pub(super) const SLACK: f64 = 1.0 / 64.0;
/// Grid cells a chart has for each of its triangles (an equilateral triangle of height 4 has 9).
/// A smaller chart, far below a texel, is enlarged to that: nothing smaller can be represented.
const CELLS_PER_TRIANGLE: f64 = 16.0;
/// Words the search for a scale may read: about half a second.
const WORK: u64 = 500_000_000;
/// What rastering a triangle, and turning and placing a chart, cost in words.
const WORK_PER_TRIANGLE: u64 = 100;
const WORK_PER_CHART: u64 = 10_000;
/// Scales tried at most, and at most until one fits (each is then smaller by some per cent).
const ATTEMPTS: [usize; 2] = [12, 400];
/// The search ends when the best scale and one that failed are as near as this. With many charts the
/// fill hardly depends on luck, and every attempt costs more.
const NEAR: f64 = 1.003;
const NEAR_IF_MANY: f64 = 1.015;
/// The share of the square that the first attempt hopes to fill.
const HOPE: f64 = 0.75;
/// With more charts than this the square has its full width from the start, and a row where one
/// chart found no place is not searched again for another of the same size.
const MANY: usize = 400;
/// Charts whose masks are made at a time.
const BATCH: usize = 4096;

/// Cells along a side.
fn raster(n_charts: usize) -> u32 {
    match n_charts {
        0..=4_000 => 1024,
        4_001..=60_000 => 2048,
        60_001..=1_000_000 => 4096,
        _ => 16384,
    }
}

struct Search<'a> {
    outlines: &'a [Outline<'a>],
    /// For each chart, how far its vertices may be moved afterwards, in cells.
    slack: &'a [f64],
    /// Indices of the charts that have triangles, by falling size.
    order: Vec<usize>,
    cells: u32,
    padding: f64,
    border: f64,
    area: f64,
}

struct Attempt {
    spots: Vec<(Spot, f64)>,
    /// Side of the used square and its highest row.
    side: u32,
    top: u32,
}

/// The best layout found; none when there are more charts than cells.
pub(super) fn layout(
    outlines: &[Outline],
    slack: &[f64],
    options: &AtlasOptions,
) -> Option<Layout> {
    let mut order: Vec<usize> = (0..outlines.len())
        .filter(|&i| !outlines[i].triangles.is_empty())
        .collect();
    let half_perimeter = |i: usize| outlines[i].extent[0] + outlines[i].extent[1];
    order.sort_by(|&i, &j| half_perimeter(j).total_cmp(&half_perimeter(i)));
    let cells = raster(order.len());
    let texel = f64::from(cells) / f64::from(options.resolution.max(1));
    // The smallest charts, with their padding, take at most half of the square.
    let most = (f64::from(cells) / (2.0 * order.len() as f64).sqrt() - 2.0).max(0.0);
    let wanted = f64::from(options.padding_texels);
    let padding = (wanted * texel).min(most);
    let border = (padding / 2.0).max(SLACK);
    let area = outlines
        .iter()
        .map(|outline| outline.size * outline.size)
        .sum();
    let search = Search {
        outlines,
        slack,
        order,
        cells,
        padding,
        border,
        area,
    };
    let (scale, attempt) = search.best()?;
    let cell = GRID_SIDE / (f64::from(attempt.side.max(1)) + 2.0 * border);
    Some(Layout {
        scale: scale * cell,
        cell,
        border,
        padding_texels: wanted.min(padding / texel),
        charts: attempt.spots,
    })
}

impl Search<'_> {
    /// Cells of the square that charts may use.
    fn target(&self) -> f64 {
        (f64::from(self.cells) - 2.0 * self.border).floor()
    }

    /// The scale (cells per mesh unit) with the best fill, and its layout.
    fn best(&self) -> Option<(f64, Attempt)> {
        let near = if self.is_crowded() {
            NEAR_IF_MANY
        } else {
            NEAR
        };
        let mut scale = self.first_scale();
        let mut best: Option<(f64, Attempt)> = None;
        let mut failed = f64::INFINITY;
        let mut work = 0;
        for tried in 1..=ATTEMPTS[1] {
            scale *= match self.attempt(scale, &mut work) {
                Ok(attempt) if f64::from(attempt.side) <= self.target() => {
                    let room = self.room(&attempt);
                    let density = |scale: f64, attempt: &Attempt| scale / f64::from(attempt.side);
                    let new = density(scale, &attempt);
                    if best
                        .as_ref()
                        .is_none_or(|(scale, best)| new > density(*scale, best))
                    {
                        best = Some((scale, attempt));
                    }
                    room.max(near)
                }
                not_yet => {
                    failed = failed.min(scale);
                    let room = not_yet.map_or_else(f64::sqrt, |attempt| self.room(&attempt));
                    room.clamp(0.5, 1.0 / near)
                }
            };
            if let Some((good, _)) = best {
                let enough = tried >= ATTEMPTS[0] || work > WORK || failed < good * near;
                if enough || self.order.len() <= 1 {
                    break;
                }
                if scale >= failed || scale <= good {
                    scale = f64::midpoint(good, failed.min(1.1 * good));
                }
            }
        }
        best
    }

    /// The factor by which a layout could grow if it grew evenly. The square of many charts has its
    /// full width from the start, so their area grows with the height alone.
    fn room(&self, attempt: &Attempt) -> f64 {
        if self.is_crowded() {
            (self.target() / f64::from(attempt.top.max(1))).sqrt()
        } else {
            self.target() / f64::from(attempt.side.max(1))
        }
    }

    fn is_crowded(&self) -> bool {
        self.order.len() > MANY
    }

    /// The scale at which the areas, with their padding and the raster's rounding, fill the hoped-for
    /// share: the root of a quadratic; and at most the scale at which the longest chart fits.
    fn first_scale(&self) -> f64 {
        let perimeter: f64 = self
            .order
            .iter()
            .map(|&i| self.outlines[i].perimeter())
            .sum();
        let n = self.order.len() as f64;
        let around = self.padding + 1.0;
        let (a, b) = (self.area, perimeter * around / 2.0);
        let c = n * around * around / 2.0 - HOPE * f64::from(self.cells) * f64::from(self.cells);
        let root = (-b + (b * b - 4.0 * a * c.min(-1.0)).sqrt()) / (2.0 * a);
        let longest = self
            .order
            .iter()
            .map(|&i| self.outlines[i].extent[0].max(self.outlines[i].extent[1]));
        let longest = longest.fold(f64::MIN_POSITIVE, f64::max);
        root.min((self.target() - SLACK).max(1.0) / longest)
    }

    /// All charts placed at one scale, or the share of their area that was placed.
    fn attempt(&self, scale: f64, work: &mut u64) -> Result<Attempt, f64> {
        let target = self.target().max(1.0) as u32;
        let (capacity, side) = if self.is_crowded() {
            (target, target)
        } else {
            (target + target / 4, 0)
        };
        let padding = self.padding + 2.0 * SLACK;
        let mut sheet = Sheet::new(capacity, padding.ceil() as u32 + 1, side);
        let mut spots = vec![(Spot::default(), 1.0); self.outlines.len()];
        let mut lowest: HashMap<[u32; 2], u32> = HashMap::new();
        let mut placed = 0.0;
        for batch in self.order.chunks(BATCH) {
            let masks: Vec<Option<(Mask, f64)>> = batch
                .par_iter()
                .map(|&i| self.mask(i, scale, padding, capacity))
                .collect();
            for (&i, mask) in batch.iter().zip(masks) {
                let (mask, stretch) = mask.ok_or(placed / self.area)?;
                *work +=
                    WORK_PER_CHART + WORK_PER_TRIANGLE * self.outlines[i].triangles.len() as u64;
                let turned = Turned::all(&mask);
                let (w, h) = (mask.body.width, mask.body.height);
                let row = lowest.entry([w.min(h), w.max(h)]).or_insert(0);
                let before = sheet.work;
                let spot = sheet.find(&turned, *row);
                *work += sheet.work - before;
                let spot = spot.ok_or(placed / self.area)?;
                if self.is_crowded() {
                    *row = spot.y;
                }
                sheet.take(&turned, spot);
                spots[i] = (spot, stretch);
                placed += self.outlines[i].size * self.outlines[i].size;
            }
        }
        Ok(Attempt {
            spots,
            side: sheet.side,
            top: sheet.top,
        })
    }

    /// The mask of a chart and its stretch; none when it does not fit at all.
    fn mask(&self, i: usize, scale: f64, padding: f64, capacity: u32) -> Option<(Mask, f64)> {
        let outline = &self.outlines[i];
        let around = self.slack[i] - SLACK;
        let unit = scale * GRID_SIDE / f64::from(self.cells);
        let root = (outline.triangles.len() as f64 * CELLS_PER_TRIANGLE).sqrt();
        let longest = outline.extent[0].max(outline.extent[1]);
        let stretch = (root / (outline.size * unit))
            .min(8.0 * root / (longest * unit))
            .max(1.0);
        let fits = longest * scale * stretch + 2.0 * around < f64::from(capacity);
        fits.then(|| {
            (
                Mask::new(outline, scale * stretch, Distances { around, padding }),
                stretch,
            )
        })
    }
}

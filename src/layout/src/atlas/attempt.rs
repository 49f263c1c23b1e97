//! All charts placed at one scale.
use rayon::prelude::*;
use std::collections::HashMap;

use super::OnRead;
use super::mask::{Distances, Mask, Rounding};
use super::outline::Outline;
use super::plan::{Near, Plan, QuarterTurns};
use super::sheet::Sheet;
use super::spot::{Corner, Spot, Window};
use super::texture::{Form, Texture};
use super::turned::Turned;

/// How far a vertex may end up from its exact position, in cells, without another layout.
pub(super) const SLACK: f64 = 1.0 / 64.0;

/// Grid cells a chart has for each of its triangles (an equilateral triangle of height 4 has 9).
/// A smaller chart, far below a texel, is enlarged to that: nothing smaller can be represented.
const CELLS_PER_TRIANGLE: f64 = 16.0;
/// What rastering a piece of boundary, and turning and placing a chart, cost in words.
const WORK_PER_EDGE: u64 = 100;
const WORK_PER_CHART: u64 = 10_000;
/// With more charts than this pages are used to their borders from the start.
const MANY: usize = 400;
/// Charts whose masks are made at a time.
const BATCH: usize = 4096;

/// What is to be packed, and the distances to be kept.
pub(super) struct Packing<'a> {
    pub plan: &'a Plan,
    /// For each chart, how far its vertices may be moved afterward, in cells.
    pub slack: &'a [f64],
    pub texture: Texture,
    /// Cells along the longer side of a page.
    pub cells: u32,
    /// Cells kept free between charts, and at each border.
    pub padding: f64,
    pub border: f64,
    /// `true` if charts that have copies are not turned, so that copies lie alike.
    pub is_alike: bool,
    /// How far pages are used from the start.
    pub extent: Extent,
    /// Pages on which cells are taken before the first chart is placed.
    pub taken: Option<&'a Sheet>,
    pub on_read: &'a OnRead<'a>,
}

/// How far pages are used from the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// As little as charts need; they may come to need more than there is.
    Growing,
    /// To their borders; a row where one chart found no place is not searched again for another of about the same size.
    Full,
}

/// A place for every chart.
pub(super) struct Attempt {
    /// For each chart its place, and the factor by which it exceeds the common scale.
    pub spots: Vec<(Spot, f64)>,
    /// The longer side of what is used of a page, and the rows used of all.
    pub side: u32,
    pub rows: u32,
}

impl Packing<'_> {
    /// Cells of a page that charts may use, along its longer side.
    pub(super) fn target(&self) -> f64 {
        (f64::from(self.cells) - 2.0 * self.border).floor()
    }

    /// Whether there are so many charts that the fill hardly depends on luck.
    pub(super) fn is_crowded(&self) -> bool {
        self.plan.order.len() > MANY
    }

    /// The shape of pages without their borders.
    pub(super) fn form(&self) -> Form {
        Form::new(self.texture, self.border)
    }

    /// The same in whole cells.
    pub(super) fn whole(&self) -> u32 {
        self.target().max(1.0) as u32
    }

    /// Cells kept free around a chart, with what charts may be moved by.
    pub(super) fn reach(&self) -> f64 {
        self.padding + 2.0 * SLACK
    }

    /// All charts placed at one scale, or the share of their area that was placed.
    pub(super) fn attempt(&self, scale: f64, work: &mut u64) -> Result<Attempt, f64> {
        let target = self.whole();
        let is_full = self.is_crowded() || self.extent == Extent::Full;
        let (capacity, side) = if is_full {
            (target, target)
        } else {
            (target + target / 4, 0)
        };
        let padding = self.reach();
        let empty = || Sheet::new(self.form(), capacity, padding.ceil() as u32 + 1, side);
        let mut sheet = self.taken.cloned().unwrap_or_else(empty);
        let mut spots = vec![(Spot::default(), 1.0); self.plan.outlines.len()];
        let mut lowest: HashMap<[u32; 2], Corner> = HashMap::new();
        let mut placed = 0.0;
        let area = self.plan.area();
        for batch in self.plan.order.chunks(BATCH) {
            let masks: Vec<Option<(Vec<Turned>, f64)>> = batch
                .par_iter()
                .map(|&i| self.turned(i, scale, padding, capacity))
                .collect();
            for (&i, turned) in batch.iter().zip(masks) {
                let (turned, stretch) = turned.ok_or(placed / area)?;
                let mut read =
                    WORK_PER_CHART + WORK_PER_EDGE * self.plan.outlines[i].edges().len() as u64;
                let [w, h] = turned[0].size;
                let row = lowest.entry([w.min(h), w.max(h)].map(rough)).or_default();
                let before = sheet.work;
                let spot = match &self.plan.near {
                    Some(near) => find_near(near, i, &mut sheet, &turned, target),
                    None => sheet.find(&turned, Window::from(Corner { x: 0, ..*row })),
                };
                read += sheet.work - before;
                *work += read;
                (self.on_read)(read);
                let (mask, spot) = spot.ok_or(placed / area)?;
                if is_full {
                    *row = spot.corner;
                }
                sheet.take(&turned[mask], spot.corner);
                spots[i] = (spot, stretch);
                placed += self.plan.outlines[i].size * self.plan.outlines[i].size;
            }
        }
        Ok(Attempt {
            spots,
            side: sheet.side,
            rows: sheet.tops.iter().sum(),
        })
    }

    /// The turned masks of a chart and its stretch; none when it does not fit at all.
    fn turned(
        &self,
        i: usize,
        scale: f64,
        padding: f64,
        capacity: u32,
    ) -> Option<(Vec<Turned>, f64)> {
        let outline = &self.plan.outlines[i];
        let around = self.slack[i] - SLACK;
        let unit = scale * self.texture.grid_side() / f64::from(self.cells);
        let stretch = stretch(outline, unit);
        let longest = outline.extent[0].max(outline.extent[1]);
        let fits = longest * scale * stretch + 2.0 * around < f64::from(capacity);
        fits.then(|| {
            let distances = Distances {
                around,
                padding,
                rounding: Rounding::Outward,
            };
            let mask = Mask::new(outline, scale * stretch, distances);
            let turned = match self.plan.turns[i] {
                QuarterTurns::Only(turns) => vec![Turned::new(mask, turns)],
                QuarterTurns::Any if self.is_alike && outline.has_copies => {
                    vec![Turned::new(mask, 0)]
                }
                // The first chart goes to the corner of a square, whichever way it is turned.
                QuarterTurns::Any
                    if self.plan.order.first() == Some(&i)
                        && self.form().is_square()
                        && self.taken.is_none() =>
                {
                    vec![Turned::new(mask, 0)]
                }
                QuarterTurns::Any => Turned::all(mask),
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

/// A place for a chart near where it should lie, or else to the right and up of that.
fn find_near(
    near: &Near,
    chart: usize,
    sheet: &mut Sheet,
    turned: &[Turned],
    side: u32,
) -> Option<(usize, Spot)> {
    let cells = |share: f64| (share * f64::from(side)) as u32;
    let (page, lowest) = near.corners[chart];
    let corner = |[x, y]: [u32; 2]| Corner { page, x, y };
    let window = Window {
        lowest: corner(lowest.map(cells)),
        highest: corner(lowest.map(|share| cells(share + near.window))),
    };
    let found = sheet.find(turned, window);
    found.or_else(|| sheet.find(turned, Window::from(window.lowest)))
}

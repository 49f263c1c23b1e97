//! All charts placed at one scale.
use rayon::prelude::*;
use std::collections::HashMap;

use super::GRID_SIDE;
use super::layout::SLACK;
use super::mask::{Distances, Mask};
use super::outline::Outline;
use super::plan::{Near, Plan, QuarterTurns};
use super::sheet::{Sheet, Spot, Window};
use super::turned::Turned;

/// Grid cells a chart has for each of its triangles (an equilateral triangle of height 4 has 9).
/// A smaller chart, far below a texel, is enlarged to that: nothing smaller can be represented.
const CELLS_PER_TRIANGLE: f64 = 16.0;
/// What rastering a piece of boundary, and turning and placing a chart, cost in words.
const WORK_PER_EDGE: u64 = 100;
const WORK_PER_CHART: u64 = 10_000;
/// With more charts than this the square has its full width from the start, and a row where one
/// chart found no place is not searched again for another of the same size.
const MANY: usize = 400;
/// Charts whose masks are made at a time.
const BATCH: usize = 4096;

/// What is to be packed, and the distances to be kept.
pub(super) struct Packing<'a> {
    pub plan: &'a Plan,
    /// For each chart, how far its vertices may be moved afterwards, in cells.
    pub slack: &'a [f64],
    /// Cells along a side of the square.
    pub cells: u32,
    /// Cells kept free between charts, and at each border.
    pub padding: f64,
    pub border: f64,
}

/// A place for every chart.
pub(super) struct Attempt {
    /// For each chart its place, and the factor by which it exceeds the common scale.
    pub spots: Vec<(Spot, f64)>,
    /// Side of the used square and its highest row.
    pub side: u32,
    pub top: u32,
}

impl Packing<'_> {
    /// Cells of the square that charts may use.
    pub(super) fn target(&self) -> f64 {
        (f64::from(self.cells) - 2.0 * self.border).floor()
    }

    /// Whether the square has its full width from the start.
    pub(super) fn is_crowded(&self) -> bool {
        self.plan.order.len() > MANY
    }

    /// All charts placed at one scale, or the share of their area that was placed.
    pub(super) fn attempt(&self, scale: f64, work: &mut u64) -> Result<Attempt, f64> {
        let target = self.target().max(1.0) as u32;
        let (capacity, side) = if self.is_crowded() {
            (target, target)
        } else {
            (target + target / 4, 0)
        };
        let padding = self.padding + 2.0 * SLACK;
        let mut sheet = Sheet::new(capacity, padding.ceil() as u32 + 1, side);
        let mut spots = vec![(Spot::default(), 1.0); self.plan.outlines.len()];
        let mut lowest: HashMap<[u32; 2], u32> = HashMap::new();
        let mut placed = 0.0;
        let area = self.plan.area();
        for batch in self.plan.order.chunks(BATCH) {
            let masks: Vec<Option<(Vec<Turned>, f64)>> = batch
                .par_iter()
                .map(|&i| self.turned(i, scale, padding, capacity))
                .collect();
            for (&i, turned) in batch.iter().zip(masks) {
                let (turned, stretch) = turned.ok_or(placed / area)?;
                *work +=
                    WORK_PER_CHART + WORK_PER_EDGE * self.plan.outlines[i].edges().len() as u64;
                let [w, h] = turned[0].size;
                let row = lowest.entry([w.min(h), w.max(h)]).or_insert(0);
                let before = sheet.work;
                let spot = match &self.plan.near {
                    Some(near) => find_near(near, i, &mut sheet, &turned, target),
                    None => sheet.find(&turned, Window::from([0, *row])),
                };
                *work += sheet.work - before;
                let (mask, spot) = spot.ok_or(placed / area)?;
                if self.is_crowded() {
                    *row = spot.y;
                }
                sheet.take(&turned[mask], [spot.x, spot.y]);
                spots[i] = (spot, stretch);
                placed += self.plan.outlines[i].size * self.plan.outlines[i].size;
            }
        }
        Ok(Attempt {
            spots,
            side: sheet.side,
            top: sheet.top,
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
        let unit = scale * GRID_SIDE / f64::from(self.cells);
        let stretch = stretch(outline, unit);
        let longest = outline.extent[0].max(outline.extent[1]);
        let fits = longest * scale * stretch + 2.0 * around < f64::from(capacity);
        fits.then(|| {
            let mask = Mask::new(outline, scale * stretch, Distances { around, padding });
            let turned = match self.plan.turns[i] {
                QuarterTurns::Only(turns) => vec![Turned::new(mask, turns)],
                // The first chart goes to the corner, whichever way it is turned.
                QuarterTurns::Any if self.plan.order.first() == Some(&i) => {
                    vec![Turned::new(mask, 0)]
                }
                QuarterTurns::Any => Turned::all(mask),
            };
            (turned, stretch)
        })
    }
}

/// The factor by which a chart at so many grid units per mesh unit has to exceed the common scale.
pub(super) fn stretch(outline: &Outline, unit: f64) -> f64 {
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
    let lowest = near.corners[chart];
    let window = Window {
        lowest: lowest.map(cells),
        highest: lowest.map(|share| cells(share + near.window)),
    };
    let found = sheet.find(turned, window);
    found.or_else(|| sheet.find(turned, Window::from(window.lowest)))
}

//! Charts on a raster of square cells.
//!
//! The *body* is every cell that a triangle touches. The *reach* is every cell within the padding of the chart (a disk, not a box).
//! Two charts keep their distance if the reach of one contains no cell of the body of the other: each point of the second chart
//! then lies in a cell that is farther away.
//!
//! On a coarse raster, this keeps charts half a cell too far apart on average, which is more than the best layouts differ by.
//! [`Rounding::Nearest`] keeps them at the right distance on average. They may then overlap a little, and the caller has to
//! separate them.
//!
//! Bitmaps hold 64 cells in a machine word. [`Turned`] is a mask after quarter turns, as the search for a free place reads it.
use super::outline::Outline;

/// Cells of a chart at one scale.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Mask {
    /// Cells that the chart occupies.
    pub body: Bitmap,
    /// Cells nearer than the padding, in a block that is larger than the body by `margin` on each side.
    pub reach: Bitmap,
    pub margin: u32,
}

/// Distances for which a mask is made, in cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Distances {
    /// Added around the chart to both body and reach: the distance by which its outline may still move.
    pub around: f64,
    /// Kept free around that.
    pub padding: f64,
    pub rounding: Rounding,
}

/// Cells that a chart occupies at its outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rounding {
    /// All cells that it touches.
    Outward,
    /// Cells whose centers it covers.
    Nearest,
}

impl Mask {
    /// Rasterizes the outline at `scale` cells per mesh unit. The lower left corner of the chart's bounding rectangle lies at
    /// (`around`, `around`) in the body.
    pub(super) fn new(outline: &Outline, scale: f64, distances: Distances) -> Self {
        let Distances {
            around,
            padding,
            rounding,
        } = distances;
        let margin = padding.ceil() as u32 + 1;
        let cells = |extent: f64| (extent * scale + 2.0 * around) as u32 + 1;
        let [width, height] = outline.extent.map(cells);
        let mut body = Bitmap::new(width, height);
        let mut reach = Bitmap::new(width + 2 * margin, height + 2 * margin);
        let place = |p: [f64; 2]| p.map(|x| x * scale + around);
        let segments = || outline.edges().map(|edge| edge.map(place));
        fill(&mut body, segments());
        for segment in segments() {
            if rounding == Rounding::Outward {
                touch(&mut body, segment);
            }
            if around > 0.0 {
                thicken(&mut body, segment, around);
            }
            let outward = segment.map(|p| p.map(|x| x + f64::from(margin)));
            thicken(&mut reach, outward, around + padding);
        }
        for run in body.runs() {
            let CellRun { row, start, end } = run;
            reach.set(CellRun {
                row: row + margin,
                start: start + margin,
                end: end + margin,
            });
        }
        Self {
            body,
            reach,
            margin,
        }
    }

    pub(super) fn quarter_turn(&self) -> Self {
        Self {
            body: self.body.quarter_turn(),
            reach: self.reach.quarter_turn(),
            margin: self.margin,
        }
    }
}

/// Sets the cells whose centers closed directed lines wind around.
///
/// A cell that no line touches lies inside or outside as a whole. Together with the cells of [`touch`], these cells cover the area.
fn fill(bitmap: &mut Bitmap, segments: impl Iterator<Item = [[f64; 2]; 2]>) {
    let first_center = |x: f64, end: u32| ((x - 0.5).ceil().max(0.0) as u32).min(end);
    // Row, column at which the winding number changes, and the change.
    let mut crossings: Vec<(u32, u32, i32)> = Vec::new();
    for [p, q] in segments {
        let (low, high, sign) = if p[1] <= q[1] { (p, q, 1) } else { (q, p, -1) };
        for row in first_center(low[1], bitmap.height)..first_center(high[1], bitmap.height) {
            let share = (f64::from(row) + 0.5 - low[1]) / (high[1] - low[1]);
            let x = low[0] + share.clamp(0.0, 1.0) * (high[0] - low[0]);
            crossings.push((row, first_center(x, bitmap.width), sign));
        }
    }
    crossings.sort_unstable();
    let mut winding = 0;
    for pair in crossings.windows(2) {
        let [(row, start, sign), (_, end, _)] = [pair[0], pair[1]];
        winding += sign;
        // The winding number of closed lines is 0 at the end of a row.
        if winding != 0 && start < end {
            bitmap.set(CellRun { row, start, end });
        }
    }
}

/// Sets the cells that a segment touches.
fn touch(bitmap: &mut Bitmap, [p, q]: [[f64; 2]; 2]) {
    sweep(bitmap, [p[1].min(q[1]), p[1].max(q[1])], |strip| {
        let mut range = Range::EMPTY;
        range.add_segment(p, q, strip);
        range
    });
}

/// Sets the cells within `radius` of a segment.
fn thicken(bitmap: &mut Bitmap, [p, q]: [[f64; 2]; 2], radius: f64) {
    let d = [q[0] - p[0], q[1] - p[1]];
    let length = d[0].hypot(d[1]).max(f64::MIN_POSITIVE);
    let normal = [-d[1] / length * radius, d[0] / length * radius];
    sweep(
        bitmap,
        [p[1].min(q[1]) - radius, p[1].max(q[1]) + radius],
        |strip| {
            let mut range = Range::EMPTY;
            range.add_disk(p, radius, strip);
            range.add_disk(q, radius, strip);
            for sign in [-1.0, 1.0] {
                let shifted = |p: [f64; 2]| [p[0] + sign * normal[0], p[1] + sign * normal[1]];
                range.add_segment(shifted(p), shifted(q), strip);
            }
            range
        },
    );
}

/// Sets in every row between two heights the cells of the range that `range` returns for the row's strip.
fn sweep(bitmap: &mut Bitmap, [low, high]: [f64; 2], range: impl Fn([f64; 2]) -> Range) {
    for row in low.max(0.0) as u32..=(high.max(0.0) as u32).min(bitmap.height - 1) {
        let Range { low, high } = range([f64::from(row), f64::from(row + 1)]);
        if low <= high {
            let start = low.max(0.0) as u32;
            let end = (high.max(0.0) as u32 + 1).min(bitmap.width);
            if start < end {
                bitmap.set(CellRun { row, start, end });
            }
        }
    }
}

/// Interval of x that a convex shape covers within a horizontal strip; empty if `low > high`.
#[derive(Clone, Copy)]
struct Range {
    low: f64,
    high: f64,
}

impl Range {
    const EMPTY: Self = Self {
        low: f64::INFINITY,
        high: f64::NEG_INFINITY,
    };

    fn add(&mut self, x: f64) {
        self.low = self.low.min(x);
        self.high = self.high.max(x);
    }

    fn add_segment(&mut self, p: [f64; 2], q: [f64; 2], [bottom, top]: [f64; 2]) {
        let (p, q) = if p[1] <= q[1] { (p, q) } else { (q, p) };
        if q[1] < bottom || p[1] > top {
            return;
        }
        let at = |y: f64| p[0] + (q[0] - p[0]) * ((y - p[1]) / (q[1] - p[1])).clamp(0.0, 1.0);
        self.add(if p[1] < bottom { at(bottom) } else { p[0] });
        self.add(if q[1] > top { at(top) } else { q[0] });
    }

    fn add_disk(&mut self, center: [f64; 2], radius: f64, [bottom, top]: [f64; 2]) {
        let above = (bottom - center[1]).max(center[1] - top).max(0.0);
        if above <= radius {
            let half = (radius * radius - above * above).sqrt();
            self.add(center[0] - half);
            self.add(center[0] + half);
        }
    }
}

/// Cells `start..end` of one row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CellRun {
    pub row: u32,
    pub start: u32,
    pub end: u32,
}

/// Rectangular block of cells, one bit each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Bitmap {
    pub width: u32,
    pub height: u32,
    words: usize,
    bits: Vec<u64>,
}

impl Bitmap {
    pub(super) fn new(width: u32, height: u32) -> Self {
        let words = width.div_ceil(64) as usize;
        Self {
            width,
            height,
            words,
            bits: vec![0; words * height as usize],
        }
    }

    /// Sets the cells of a run.
    pub(super) fn set(&mut self, run: CellRun) {
        let row = &mut self.bits[run.row as usize * self.words..][..self.words];
        set_bits(row, run.start, run.end);
    }

    /// Returns the bitmap after a quarter turn counter-clockwise: (x, y) goes to (height − 1 − y, x).
    fn quarter_turn(&self) -> Self {
        let mut out = Self::new(self.height, self.width);
        for CellRun { row, start, end } in self.runs() {
            let x = self.height - 1 - row;
            for y in start..end {
                out.bits[y as usize * out.words + x as usize / 64] |= 1 << (x % 64);
            }
        }
        out
    }

    /// Returns all runs of set cells, row by row.
    pub(super) fn runs(&self) -> Vec<CellRun> {
        let mut runs = Vec::new();
        for row in 0..self.height {
            let words = &self.bits[row as usize * self.words..][..self.words];
            let mut end = 0;
            loop {
                let start = next(words, end, 0).min(self.width);
                end = next(words, start, u64::MAX).min(self.width);
                if start >= end {
                    break;
                }
                runs.push(CellRun { row, start, end });
            }
        }
        runs
    }
}

/// Returns the first position from `x` on whose bit differs from those of `ground`; `u32::MAX` if there is none.
fn next(words: &[u64], x: u32, ground: u64) -> u32 {
    let mut keep = u64::MAX << (x % 64);
    for (i, word) in words.iter().enumerate().skip((x / 64) as usize) {
        let differs = (word ^ ground) & keep;
        if differs != 0 {
            return 64 * i as u32 + differs.trailing_zeros();
        }
        keep = u64::MAX;
    }
    u32::MAX
}

/// Sets bits `start..end`.
pub(super) fn set_bits(words: &mut [u64], start: u32, end: u32) {
    for (i, word) in words
        .iter_mut()
        .enumerate()
        .take(end.div_ceil(64) as usize)
        .skip((start / 64) as usize)
    {
        let first = start.saturating_sub(64 * i as u32).min(63);
        let last = (end - 64 * i as u32).min(64);
        *word |= u64::MAX >> (64 - last) & u64::MAX << first;
    }
}

/// A mask after quarter turns.
pub(super) struct Turned {
    pub turns: u32,
    pub body: Vec<CellRun>,
    /// Width and height, in cells.
    pub size: [u32; 2],
    /// Tests of its reach, in the order in which they are made.
    pub probes: Vec<Probe>,
    pub margin: u32,
}

impl Turned {
    /// Turns a mask counter-clockwise by `turns` quarters.
    pub(super) fn new(mask: &Mask, turns: u32) -> Self {
        if turns == 0 {
            return Self::of(mask, 0);
        }
        let once = mask.quarter_turn();
        let turned = (1..turns).fold(once, |mask, _| mask.quarter_turn());
        Self::of(&turned, turns)
    }

    /// Returns whether both occupy the same cells and keep the same cells free.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.size == other.size && self.body == other.body && self.probes == other.probes
    }

    /// Returns the quarter turns of a mask that differ: four, two for a mask with the symmetry of a rectangle, or one for that of a
    /// square.
    pub(super) fn all(mask: Mask) -> Vec<Self> {
        let mut masks = vec![mask];
        for turns in 1..4 {
            let turned = masks[turns - 1].quarter_turn();
            if turned == masks[0] {
                break;
            }
            masks.push(turned);
        }
        let turned = masks.into_iter().zip(0..);
        turned.map(|(mask, turns)| Self::of(&mask, turns)).collect()
    }

    fn of(turned: &Mask, turns: u32) -> Self {
        Self {
            turns,
            probes: Probe::of(&scattered(turned.reach.runs())),
            body: turned.body.runs(),
            size: [turned.body.width, turned.body.height],
            margin: turned.margin,
        }
    }
}

/// Orders runs so that an occupied place is detected early: the longest run first, then runs far from each other before their
/// neighbors.
fn scattered(mut runs: Vec<CellRun>) -> Vec<CellRun> {
    let bits = usize::BITS - runs.len().leading_zeros();
    let mut keyed: Vec<(usize, CellRun)> = runs
        .drain(..)
        .enumerate()
        .map(|(i, run)| (i.reverse_bits() >> (usize::BITS - bits.max(1)), run))
        .collect();
    keyed.sort_unstable_by_key(|&(key, _)| key);
    let mut runs: Vec<CellRun> = keyed.into_iter().map(|(_, run)| run).collect();
    let longest = (0..runs.len()).max_by_key(|&i| (runs[i].end - runs[i].start, usize::MAX - i));
    if let Some(longest) = longest {
        runs.swap(0, longest);
    }
    runs
}

/// Number of widths of windows: 1 to 64 cells.
pub(super) const WIDTHS: usize = 7;

/// Two windows of one width in one row. Both have to be free.
///
/// A run whose length is between 2ᵏ and 2ᵏ⁺¹ is free if its first and its last window of 2ᵏ cells are free. A run longer than two
/// of the widest windows takes several probes.
#[derive(PartialEq, Eq)]
pub(super) struct Probe {
    /// Row of the mask times [`WIDTHS`], plus k.
    pub lane: u32,
    /// Columns of the mask at which the windows begin.
    pub starts: [u32; 2],
}

impl Probe {
    /// Returns the probes that test whether all cells of some runs are free, in the order of the runs.
    pub(super) fn of(runs: &[CellRun]) -> Vec<Self> {
        let mut probes = Vec::with_capacity(runs.len());
        for run in runs {
            let k = (run.end - run.start).ilog2().min(WIDTHS as u32 - 1);
            let width = 1 << k;
            let (mut first, last) = (run.start, run.end - width);
            loop {
                let second = (first + width).min(last);
                probes.push(Self {
                    lane: run.row * WIDTHS as u32 + k,
                    starts: [first, second],
                });
                if second == last {
                    break;
                }
                first = (second + width).min(last);
            }
        }
        probes
    }
}

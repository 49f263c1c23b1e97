//! Charts on a raster of square cells, conservatively.
//!
//! The *body* is every cell a triangle touches. The *reach* is every cell within the padding of
//! the chart (a disk, not a box). Two charts keep their distance when the reach of one meets no
//! cell of the other's body: each point of the second then lies in a cell that is farther away.
use super::outline::Outline;

/// Cells `start..end` of one row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Run {
    pub row: u32,
    pub start: u32,
    pub end: u32,
}

/// A block of cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Bitmap {
    pub width: u32,
    pub height: u32,
    words: usize,
    bits: Vec<u64>,
}

impl Bitmap {
    fn new(width: u32, height: u32) -> Self {
        let words = width.div_ceil(64) as usize;
        Self {
            width,
            height,
            words,
            bits: vec![0; words * height as usize],
        }
    }

    fn set(&mut self, run: Run) {
        let row = &mut self.bits[run.row as usize * self.words..][..self.words];
        set_bits(row, run.start, run.end);
    }

    /// A quarter turn counter-clockwise: (x, y) goes to (height − 1 − y, x).
    pub(super) fn quarter_turn(&self) -> Self {
        let mut out = Self::new(self.height, self.width);
        for run in self.runs() {
            let x = self.height - 1 - run.row;
            for row in run.start..run.end {
                out.bits[row as usize * out.words + (x / 64) as usize] |= 1 << (x % 64);
            }
        }
        out
    }

    /// All runs, row by row.
    pub(super) fn runs(&self) -> Vec<Run> {
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
                runs.push(Run { row, start, end });
            }
        }
        runs
    }
}

/// First place from `x` on whose bit differs from those of `ground`.
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

/// One chart's cells at one scale.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Mask {
    /// Cells the chart touches.
    pub body: Bitmap,
    /// Cells nearer than the padding, in a block larger by `margin` on each side.
    pub reach: Bitmap,
    pub margin: u32,
}

/// The distances a mask is made for, in cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Distances {
    /// Added around the chart to both body and reach: how far its outline may still move.
    pub around: f64,
    /// Kept free around that.
    pub padding: f64,
}

impl Mask {
    /// Rasters the outline at `scale` cells per mesh unit. The lower left corner of the chart's
    /// bounding rectangle comes to lie at (`around`, `around`) in the body.
    pub(super) fn new(outline: &Outline, scale: f64, distances: Distances) -> Self {
        let Distances { around, padding } = distances;
        let margin = padding.ceil() as u32 + 1;
        let cells = |extent: f64| (extent * scale + 2.0 * around) as u32 + 1;
        let [width, height] = outline.extent.map(cells);
        let mut body = Bitmap::new(width, height);
        let mut reach = Bitmap::new(width + 2 * margin, height + 2 * margin);
        let place = |v: u32| outline.uv[v as usize].map(|x| x * scale + around);
        for triangle in outline.triangles {
            fill(&mut body, &triangle.map(place));
        }
        let outward = |v: u32| place(v).map(|x| x + f64::from(margin));
        for &[p, q] in &outline.boundary {
            if around > 0.0 {
                thicken(&mut body, [place(p), place(q)], around);
            }
            thicken(&mut reach, [outward(p), outward(q)], around + padding);
        }
        for run in body.runs() {
            let Run { row, start, end } = run;
            reach.set(Run {
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

/// Sets the cells a triangle touches.
fn fill(bitmap: &mut Bitmap, triangle: &[[f64; 2]; 3]) {
    let [a, b, c] = *triangle;
    sweep(
        bitmap,
        [a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1])],
        |strip| {
            let mut range = Range::EMPTY;
            for [p, q] in [[a, b], [b, c], [c, a]] {
                range.add_segment(p, q, strip);
            }
            range
        },
    );
}

/// Sets the cells nearer than `radius` to a segment.
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

/// Sets, in every row between two heights, the cells of the range found for the row's strip.
fn sweep(bitmap: &mut Bitmap, [low, high]: [f64; 2], range: impl Fn([f64; 2]) -> Range) {
    for row in low.max(0.0) as u32..=(high.max(0.0) as u32).min(bitmap.height - 1) {
        let Range { low, high } = range([f64::from(row), f64::from(row + 1)]);
        if low <= high {
            let start = low.max(0.0) as u32;
            let end = (high.max(0.0) as u32 + 1).min(bitmap.width);
            if start < end {
                bitmap.set(Run { row, start, end });
            }
        }
    }
}

/// Interval of x that a convex shape covers within a horizontal strip.
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

//! The cells that are taken, and the search for a free place.
//!
//! All positions of one row are tested together, 64 to a machine word: a run of a mask, of length
//! between 2ᵏ and 2ᵏ⁺¹, is blocked at x when one of two windows of 2ᵏ cells is, and for each k the
//! sheet keeps one bit per window.
use super::bitmap::{Run, set_bits};
use super::mask::Mask;

/// A place for one mask.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Spot {
    /// Column and row of the body's lower left cell.
    pub x: u32,
    pub y: u32,
    /// Quarter turns, counter-clockwise.
    pub turns: u32,
    /// Size of the body *before* it is turned, in cells.
    pub width: u32,
    pub height: u32,
}

/// One of the four turned versions of a mask, with the runs of its reach in the order of the test.
pub(super) struct Turned {
    turns: u32,
    body: Vec<Run>,
    size: [u32; 2],
    reach: Vec<Run>,
    margin: u32,
}

impl Turned {
    /// The mask after so many quarter turns.
    pub(super) fn new(mask: Mask, turns: u32) -> Self {
        let turned = (0..turns).fold(mask, |mask, _| mask.quarter_turn());
        Self::of(&turned, turns)
    }

    /// The quarter turns that differ: four, or one of a square.
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
            reach: scattered(turned.reach.runs()),
            body: turned.body.runs(),
            size: [turned.body.width, turned.body.height],
            margin: turned.margin,
        }
    }

    /// Width and height, in cells.
    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }
}

/// The longest run first, then runs far from each other before their neighbours: an occupied place
/// is found out early.
fn scattered(mut runs: Vec<Run>) -> Vec<Run> {
    let bits = usize::BITS - runs.len().leading_zeros();
    let mut keyed: Vec<(usize, Run)> = runs
        .drain(..)
        .enumerate()
        .map(|(i, run)| (i.reverse_bits() >> (usize::BITS - bits.max(1)), run))
        .collect();
    keyed.sort_unstable_by_key(|&(key, _)| key);
    let mut runs: Vec<Run> = keyed.into_iter().map(|(_, run)| run).collect();
    let longest = (0..runs.len()).max_by_key(|&i| (runs[i].end - runs[i].start, usize::MAX - i));
    if let Some(longest) = longest {
        runs.swap(0, longest);
    }
    runs
}

/// The occupied cells of a square.
pub(super) struct Sheet {
    /// Side of the square that may be used, in cells.
    capacity: u32,
    /// Free cells on each side of it, so that a reach may stick out.
    frame: u32,
    words: usize,
    /// `windows[k]`, one row of `words` after the other: bit x says that a cell of x..x + 2ᵏ is taken.
    windows: Vec<Vec<u64>>,
    blocked: Vec<u64>,
    /// Side of the square used so far.
    pub side: u32,
    /// Rows used so far.
    pub top: u32,
    /// Words read so far: what the search cost, on any machine.
    pub work: u64,
}

impl Sheet {
    /// An empty square. No mask's margin may exceed `frame`.
    pub(super) fn new(capacity: u32, frame: u32, side: u32) -> Self {
        let cells = capacity + 2 * frame;
        let words = cells.div_ceil(64) as usize + 2;
        let levels = (u32::BITS - cells.leading_zeros()) as usize;
        let windows = vec![vec![0; words * cells as usize]; levels];
        Self {
            capacity,
            frame,
            words,
            windows,
            blocked: Vec::new(),
            side,
            top: 0,
            work: 0,
        }
    }

    /// Empty again, with another side that may be used, at most that of before.
    pub(super) fn clear(&mut self, capacity: u32) {
        let used = (self.top + self.frame + 1) as usize * self.words;
        for windows in &mut self.windows {
            let end = used.min(windows.len());
            windows[..end].fill(0);
        }
        self.capacity = capacity;
        (self.side, self.top) = (0, 0);
    }

    /// The place that makes the used square grow least, and for which of the masks; of those the lowest. Only columns and rows
    /// from `lowest` on are searched.
    pub(super) fn find(&mut self, turned: &[Turned], lowest: [u32; 2]) -> Option<(usize, Spot)> {
        let mut best: Option<(u32, (usize, Spot))> = None;
        for y in lowest[1]..self.capacity {
            for (index, mask) in turned.iter().enumerate() {
                let limit = best.map_or(self.capacity, |(side, _)| side - 1);
                let [width, height] = mask.size;
                if width > limit || y + height > limit {
                    continue;
                }
                if let Some(x) = self.first_free(mask, y, [lowest[0], limit - width]) {
                    let (width, height) = if mask.turns % 2 == 0 {
                        (width, height)
                    } else {
                        (height, width)
                    };
                    let spot = Spot {
                        x,
                        y,
                        turns: mask.turns,
                        width,
                        height,
                    };
                    let right = x + mask.size[0];
                    let side = self.side.max(right).max(y + mask.size[1]);
                    best = Some((side, (index, spot)));
                    if side == self.side {
                        return best.map(|(_, spot)| spot);
                    }
                }
            }
            let lowest_top = turned.iter().map(|t| y + t.size[1]).min();
            if best.is_some_and(|(side, _)| lowest_top.is_none_or(|top| top >= side)) {
                break;
            }
        }
        best.map(|(_, spot)| spot)
    }

    /// Smallest free x between two, in row `y`.
    fn first_free(&mut self, mask: &Turned, y: u32, [first, last]: [u32; 2]) -> Option<u32> {
        if first > last {
            return None;
        }
        let n = (last / 64 + 1) as usize;
        self.blocked.clear();
        self.blocked.resize(n, 0);
        if last % 64 < 63 {
            self.blocked[n - 1] = u64::MAX << (last % 64 + 1);
        }
        set_bits(&mut self.blocked, 0, first);
        for run in &mask.reach {
            let k = (run.end - run.start).ilog2();
            let row = (y + self.frame - mask.margin + run.row) as usize * self.words;
            let row = &self.windows[k as usize][row..row + self.words];
            let first = self.frame - mask.margin + run.start;
            let second = self.frame - mask.margin + run.end - (1 << k);
            self.work += n as u64;
            if merge(&mut self.blocked, row, first, second) {
                return None;
            }
        }
        let word = self.blocked.iter().position(|&word| word != u64::MAX)?;
        Some(64 * word as u32 + self.blocked[word].trailing_ones())
    }

    /// Takes the cells of a mask's body, whose lower left cell comes to lie at `corner`.
    pub(super) fn take(&mut self, mask: &Turned, corner: [u32; 2]) {
        let x = corner[0] + self.frame;
        for run in &mask.body {
            let row = (corner[1] + self.frame + run.row) as usize;
            let words = &mut self.windows[0][row * self.words..(row + 1) * self.words];
            set_bits(words, x + run.start, x + run.end);
            self.refresh(row, x + run.start, x + run.end);
        }
        self.top = self.top.max(corner[1] + mask.size[1]);
        self.side = self.side.max(corner[0] + mask.size[0]).max(self.top);
    }

    /// Derives the wider windows of a row from its cells, where cells `start..end` were taken.
    fn refresh(&mut self, row: usize, start: u32, end: u32) {
        let range = row * self.words..(row + 1) * self.words;
        for k in 1..self.windows.len() {
            let (narrow, wide) = self.windows.split_at_mut(k);
            let narrow = &narrow[k - 1][range.clone()];
            let first = (start.saturating_sub(1 << k) / 64) as usize;
            let last = (end / 64) as usize;
            for (i, word) in wide[0][range.clone()][first..=last].iter_mut().enumerate() {
                *word = narrow[first + i] | shifted(narrow, first + i, 1 << (k - 1));
            }
        }
    }
}

/// Adds two shifted copies of a row; whether every bit is set now.
fn merge(blocked: &mut [u64], row: &[u64], first: u32, second: u32) -> bool {
    let (p, r) = ((first / 64) as usize, first % 64);
    let (q, s) = ((second / 64) as usize, second % 64);
    let n = blocked.len();
    let (a, b) = (&row[p..=p + n], &row[q..=q + n]);
    let mut all = u64::MAX;
    for i in 0..n {
        // The double shift keeps a shift by 0 from becoming one by 64.
        let x = a[i] >> r | a[i + 1] << 1 << (63 - r);
        let y = b[i] >> s | b[i + 1] << 1 << (63 - s);
        blocked[i] |= x | y;
        all &= blocked[i];
    }
    all == u64::MAX
}

/// Word `i` of a row shifted down by `by` bits.
fn shifted(row: &[u64], i: usize, by: u32) -> u64 {
    let at = |i: usize| row.get(i).copied().unwrap_or(0);
    let i = i + (by / 64) as usize;
    at(i) >> (by % 64) | at(i + 1) << 1 << (63 - by % 64)
}

//! The cells that are taken, and the search for a free place.
//!
//! All positions of one row are tested together, 64 to a machine word: a run of a mask, of length
//! between 2ᵏ and 2ᵏ⁺¹, is blocked at x when one of two windows of 2ᵏ cells is, and for each k the
//! sheet keeps one bit per window. Runs longer than two of the widest windows take more of them.
use super::bitmap::set_bits;
use super::turned::Turned;

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

/// Where a place is looked for: columns and rows from `lowest` to `highest`, both included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub lowest: [u32; 2],
    pub highest: [u32; 2],
}

impl Window {
    /// Everywhere.
    pub(super) const ALL: Self = Self::from([0; 2]);

    /// To the right and up.
    pub(super) const fn from(lowest: [u32; 2]) -> Self {
        Self {
            lowest,
            highest: [u32::MAX - 1; 2],
        }
    }
}

/// Widths of windows at most: up to 64 cells.
const WIDTHS: usize = 7;

/// The occupied cells of a square.
pub(super) struct Sheet {
    /// Side of the square that may be used, in cells.
    capacity: u32,
    /// Free cells on each side of it, so that a reach may stick out.
    frame: u32,
    words: usize,
    widths: usize,
    /// Row after row, in each for every width 2ᵏ `words` of bits: bit x says that a cell of x..x + 2ᵏ is taken.
    rows: Vec<u64>,
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
        let widths = WIDTHS.min((u32::BITS - cells.leading_zeros()) as usize);
        Self {
            capacity,
            frame,
            words,
            widths,
            rows: vec![0; words * widths * cells as usize],
            blocked: Vec::new(),
            side,
            top: 0,
            work: 0,
        }
    }

    /// Empty again, with another side that may be used, at most that of before.
    pub(super) fn clear(&mut self, capacity: u32) {
        let used = (self.top + self.frame + 1) as usize * self.words * self.widths;
        let end = used.min(self.rows.len());
        self.rows[..end].fill(0);
        self.capacity = capacity;
        (self.side, self.top) = (0, 0);
    }

    /// The place within the window that makes the used square grow least, and for which of the masks; of those the lowest.
    pub(super) fn find(&mut self, turned: &[Turned], window: Window) -> Option<(usize, Spot)> {
        let Window { lowest, highest } = window;
        let mut best: Option<(u32, (usize, Spot))> = None;
        for y in lowest[1]..self.capacity.min(highest[1] + 1) {
            for (index, mask) in turned.iter().enumerate() {
                let limit = best.map_or(self.capacity, |(side, _)| side - 1);
                let [width, height] = mask.size;
                if width > limit || y + height > limit {
                    continue;
                }
                let columns = [lowest[0], highest[0].min(limit - width)];
                if let Some(x) = self.first_free(mask, y, columns) {
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
        let inset = self.frame - mask.margin;
        for run in &mask.reach {
            let k = (run.end - run.start).ilog2().min(self.widths as u32 - 1);
            let row = (y + inset + run.row) as usize * self.widths + k as usize;
            let row = &self.rows[row * self.words..][..self.words];
            let width = 1 << k;
            let (mut first, last) = (inset + run.start, inset + run.end - width);
            loop {
                let second = (first + width).min(last);
                self.work += n as u64;
                if merge(&mut self.blocked, row, first, second) {
                    return None;
                }
                if second == last {
                    break;
                }
                first = (second + width).min(last);
            }
        }
        let word = self.blocked.iter().position(|&word| word != u64::MAX)?;
        Some(64 * word as u32 + self.blocked[word].trailing_ones())
    }

    /// Takes the cells of a mask's body, whose lower left cell comes to lie at `corner`.
    pub(super) fn take(&mut self, mask: &Turned, corner: [u32; 2]) {
        let x = corner[0] + self.frame;
        let stride = self.words * self.widths;
        for runs in mask.body.chunk_by(|a, b| a.row == b.row) {
            let row = (corner[1] + self.frame + runs[0].row) as usize;
            let row = &mut self.rows[row * stride..][..stride];
            for run in runs {
                set_bits(&mut row[..self.words], x + run.start, x + run.end);
            }
            let taken = [x + runs[0].start, x + runs[runs.len() - 1].end];
            widen(row, self.words, taken);
        }
        self.top = self.top.max(corner[1] + mask.size[1]);
        self.side = self.side.max(corner[0] + mask.size[0]).max(self.top);
    }
}

/// Derives the wider windows of a row from its cells, of which some between `start` and `end` were taken.
fn widen(row: &mut [u64], words: usize, [start, end]: [u32; 2]) {
    let last = (end / 64) as usize;
    let mut rest = row;
    let mut width = 1;
    while rest.len() > words {
        let (narrow, wide) = rest.split_at_mut(words);
        let first = (start.saturating_sub(2 * width) / 64) as usize;
        let pairs = narrow[first..=last + 1].windows(2);
        for (wide, pair) in wide[first..=last].iter_mut().zip(pairs) {
            *wide = pair[0] | pair[0] >> width | pair[1] << (64 - width);
        }
        (rest, width) = (wide, 2 * width);
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

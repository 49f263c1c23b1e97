//! The cells that are taken, and the search for a free place.
//!
//! All positions of one row are tested together, 64 to a machine word: a run of a mask, of length
//! between 2ᵏ and 2ᵏ⁺¹, is blocked at x when one of two windows of 2ᵏ cells is, and for each k the
//! sheet keeps one bit per window. Runs longer than two of the widest windows take more of them.
use super::bitmap::{Run, set_bits};
use super::spot::{Corner, Spot, Window};
use super::texture::Form;
use super::turned::Turned;

/// Widths of windows at most: up to 64 cells.
const WIDTHS: usize = 7;

/// Words of a row from which on its longest free run is known, so that rows that are full are passed over. Of fewer, looking
/// costs no more than that.
const WIDE: usize = 16;
/// The longest free run of a row in which cells were taken since it was counted.
const UNKNOWN: u32 = u32::MAX;

/// The occupied cells of all pages.
#[derive(Clone)]
pub(super) struct Sheet {
    pub form: Form,
    /// The longer side of what may be used of each page, in cells.
    capacity: u32,
    /// Free cells on each side of it, so that a reach may stick out.
    frame: u32,
    words: usize,
    widths: usize,
    /// Rows of a page with its frame.
    height: usize,
    /// Page after page and row after row, in each for every width 2ᵏ `words` of bits: bit x says that a cell of x..x + 2ᵏ is taken.
    rows: Vec<u64>,
    /// For each row of wide pages its longest run of free cells, or [`UNKNOWN`]; empty of others.
    free: Vec<u32>,
    blocked: Vec<u64>,
    /// The longer side of what is used of a page so far.
    pub side: u32,
    /// Rows of each page used so far.
    pub tops: Vec<u32>,
    /// Words read so far: what the search cost, on any machine.
    pub work: u64,
}

impl Sheet {
    /// Empty pages. No mask's margin may exceed `frame`.
    pub(super) fn new(form: Form, capacity: u32, frame: u32, side: u32) -> Self {
        let [width, height] = form.reach(capacity).map(|cells| cells + 2 * frame);
        let words = width.div_ceil(64) as usize + 2;
        let widths = WIDTHS.min((u32::BITS - width.leading_zeros()) as usize);
        let n_rows = height as usize * form.pages as usize;
        Self {
            form,
            capacity,
            frame,
            words,
            widths,
            height: height as usize,
            rows: vec![0; words * widths * n_rows],
            free: vec![width; if words < WIDE { 0 } else { n_rows }],
            blocked: Vec::new(),
            side,
            tops: vec![0; form.pages as usize],
            work: 0,
        }
    }

    /// Empty again, with another side that may be used, at most that of before.
    pub(super) fn clear(&mut self, capacity: u32) {
        let stride = self.words * self.widths;
        for (page, top) in self.rows.chunks_mut(self.height * stride).zip(&self.tops) {
            let used = (top + self.frame + 1) as usize * stride;
            let end = used.min(page.len());
            page[..end].fill(0);
        }
        self.free.fill(UNKNOWN);
        self.capacity = capacity;
        self.side = 0;
        self.tops.fill(0);
    }

    /// The place within the window that makes the used part of pages grow least, and for which of the masks; of those the lowest on
    /// the first page.
    pub(super) fn find(&mut self, turned: &[Turned], window: Window) -> Option<(usize, Spot)> {
        let mut best = None;
        for page in window.lowest.page..self.form.pages.min(window.highest.page.saturating_add(1)) {
            let mut on_page = window;
            if page > window.lowest.page {
                on_page.lowest = Corner::default();
            }
            self.find_on(page, turned, on_page, &mut best);
            if best.is_some_and(|(side, _)| side == self.side) {
                break;
            }
        }
        best.map(|(_, spot)| spot)
    }

    /// The same on one page, if it is better than what is known.
    fn find_on(
        &mut self,
        page: u32,
        turned: &[Turned],
        Window { lowest, highest }: Window,
        best: &mut Option<(u32, (usize, Spot))>,
    ) {
        let rows = self.form.reach(self.capacity)[1];
        for y in lowest.y..rows.min(highest.y + 1) {
            for (index, mask) in turned.iter().enumerate() {
                let limit = best.map_or(self.capacity, |(side, _)| side - 1);
                let [right, top] = self.form.reach(limit);
                let [width, height] = mask.size;
                if width > right || y + height > top {
                    continue;
                }
                let columns = [lowest.x, highest.x.min(right - width)];
                let corner = Corner { page, x: 0, y };
                if let Some(x) = self.first_free(mask, corner, columns) {
                    let side = self.form.side([x + width, y + height]).max(self.side);
                    let corner = Corner { x, ..corner };
                    *best = Some((side, (index, Spot::new(mask, corner))));
                    if side == self.side {
                        return;
                    }
                }
            }
            let lowest_top = turned.iter().map(|t| self.form.side([0, y + t.size[1]]));
            let lowest_top = lowest_top.min();
            if best.is_some_and(|(side, _)| lowest_top.is_none_or(|top| top >= side)) {
                break;
            }
        }
    }

    /// Smallest free x between two, in the row of a corner.
    fn first_free(
        &mut self,
        mask: &Turned,
        corner: Corner,
        [first, last]: [u32; 2],
    ) -> Option<u32> {
        if first > last || !self.may_hold(mask, corner) {
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
        let base = self.row(corner) - mask.margin as usize;
        for run in &mask.reach {
            let k = (run.end - run.start).ilog2().min(self.widths as u32 - 1);
            let row = (base + run.row as usize) * self.widths + k as usize;
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

    /// Whether each run of a mask is as short as a free one in its row; always of narrow pages.
    fn may_hold(&mut self, mask: &Turned, corner: Corner) -> bool {
        if self.free.is_empty() {
            return true;
        }
        let base = self.row(corner) - mask.margin as usize;
        (mask.reach.iter())
            .all(|run| self.longest_free(base + run.row as usize) >= run.end - run.start)
    }

    /// The longest run of free cells of a row of a wide page, with the frame.
    fn longest_free(&mut self, row: usize) -> u32 {
        if self.free[row] == UNKNOWN {
            let words = &self.rows[row * self.words * self.widths..][..self.words];
            self.work += words.len() as u64;
            self.free[row] = longest_zeros(words);
        }
        self.work += 1;
        self.free[row]
    }

    /// Takes the cells of a mask's body, whose lower left cell comes to lie at `corner`.
    pub(super) fn take(&mut self, mask: &Turned, corner: Corner) {
        let x = corner.x + self.frame;
        let stride = self.words * self.widths;
        let base = self.row(corner);
        for runs in mask.body.chunk_by(|a, b| a.row == b.row) {
            let row = base + runs[0].row as usize;
            if let Some(free) = self.free.get_mut(row) {
                *free = UNKNOWN;
            }
            let row = &mut self.rows[row * stride..][..stride];
            for run in runs {
                set_bits(&mut row[..self.words], x + run.start, x + run.end);
            }
            let taken = [x + runs[0].start, x + runs[runs.len() - 1].end];
            widen(row, self.words, taken);
        }
        let top = corner.y + mask.size[1];
        let side = self.form.side([corner.x + mask.size[0], top]);
        self.side = self.side.max(side);
        let highest = &mut self.tops[corner.page as usize];
        *highest = top.max(*highest);
    }

    /// Takes the cells of a body, whose lower left cell comes to lie at `corner`, also within the frame; not what sticks out of that.
    pub(super) fn cover(&mut self, body: &[Run], page: u32, corner: [i64; 2]) {
        let stride = self.words * self.widths;
        let frame = i64::from(self.frame);
        let width = i64::from(self.form.reach(self.capacity)[0]) + 2 * frame;
        for run in body {
            let row = i64::from(run.row) + corner[1] + frame;
            let ends = [run.start, run.end].map(|x| i64::from(x) + corner[0] + frame);
            let [start, end] = ends.map(|x| x.clamp(0, width) as u32);
            if start < end && (0..self.height as i64).contains(&row) {
                let row = page as usize * self.height + row as usize;
                if let Some(free) = self.free.get_mut(row) {
                    *free = UNKNOWN;
                }
                let row = &mut self.rows[row * stride..][..stride];
                set_bits(&mut row[..self.words], start, end);
                widen(row, self.words, [start, end]);
            }
        }
    }

    /// Where the row of a corner lies among those of all pages.
    fn row(&self, corner: Corner) -> usize {
        corner.page as usize * self.height + (corner.y + self.frame) as usize
    }
}

/// The longest run of zeros among bits.
fn longest_zeros(words: &[u64]) -> u32 {
    let (mut longest, mut open) = (0, 0);
    for &word in words {
        if word == 0 {
            open += u64::BITS;
            continue;
        }
        longest = longest.max(open + word.trailing_zeros());
        let (mut zeros, mut inside) = (!word, 0);
        while zeros != 0 {
            zeros &= zeros << 1;
            inside += 1;
        }
        longest = longest.max(inside);
        open = word.leading_zeros();
    }
    longest.max(open)
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

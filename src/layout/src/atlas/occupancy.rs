//! Occupied cells of pages, and the search for free places.
//!
//! The search tests all positions in a row together, 64 in a machine word. For each width 2ᵏ, the occupancy has one bit per window
//! of 2ᵏ cells, which is set if one of these cells is occupied. A run of cells is free if two windows that cover it are free: a
//! [`Probe`](super::mask::Probe).
use std::array::from_fn;

use super::mask::{CellRun, Turned, WIDTHS, set_bits};
use super::page::Form;

/// Words after the last row: the most that a search reads beyond the end of a row, for columns that do not count.
const BEYOND: usize = 4;
/// The occupied cells of all pages.
#[derive(Clone)]
pub(super) struct Occupancy {
    pub form: Form,
    /// Longer side of the usable part of each page, in cells; at most the value for which the occupancy was created.
    pub capacity: u32,
    /// Cells on each side of that part, so that a reach may extend beyond it.
    frame: u32,
    words: usize,
    /// Rows of a page, including its frame.
    height: usize,
    /// Bits of all pages, row by row. Each row has `words` words for each width 2ᵏ, in which bit x is set if one of the 2ᵏ cells
    /// from x on is occupied.
    rows: Vec<u64>,
    /// Longer side of the used part of the pages so far, in cells.
    pub side: u32,
    /// Number of rows of each page used so far.
    pub tops: Vec<u32>,
    /// Words read so far: the cost of the search, which is the same on every machine.
    pub work: u64,
}

impl Occupancy {
    /// Creates empty pages. No mask's margin may exceed `frame`.
    pub(super) fn new(form: Form, capacity: u32, frame: u32, side: u32) -> Self {
        let [width, height] = form.reach(capacity).map(|cells| cells + 2 * frame);
        let words = width.div_ceil(64) as usize;
        let n_rows = height as usize * form.pages as usize;
        Self {
            form,
            capacity,
            frame,
            words,
            height: height as usize,
            rows: vec![0; words * WIDTHS * n_rows + BEYOND],
            side,
            tops: vec![0; form.pages as usize],
            work: 0,
        }
    }

    /// Returns the longer side of the used part of the pages, in cells.
    pub(super) fn side(&self) -> u32 {
        self.side
    }

    /// Copies the occupied cells and the used part from another occupancy of the same form and size. Copies only the rows that one
    /// of the two uses.
    pub(super) fn restore(&mut self, other: &Self) {
        let stride = self.words * WIDTHS;
        let rows = self.rows.chunks_mut(self.height * stride);
        let pages = rows.zip(other.rows.chunks(self.height * stride));
        for ((page, of_other), tops) in pages.zip(self.tops.iter().zip(&other.tops)) {
            let used = (tops.0.max(tops.1) + self.frame + 1) as usize * stride;
            let used = used.min(page.len());
            page[..used].copy_from_slice(&of_other[..used]);
        }
        self.side = other.side;
        self.tops.copy_from_slice(&other.tops);
    }

    /// Returns the free place within the window at which the used part of the pages grows least, and the index of its mask. Of
    /// several such places, returns the lowest on the first page.
    pub(super) fn find(&mut self, turned: &[Turned], window: Window) -> Option<(usize, Corner)> {
        let mut best = None;
        for page in window.lowest.page..self.form.pages.min(window.end_page) {
            let mut on_page = window;
            if page > window.lowest.page {
                on_page.lowest = Corner::default();
            }
            self.find_on(page, turned, on_page, &mut best);
            if best.is_some_and(|(side, _)| side == self.side) {
                break;
            }
        }
        best.map(|(_, found)| found)
    }

    /// Searches one page, and updates `best` if it finds a better place.
    fn find_on(
        &mut self,
        page: u32,
        turned: &[Turned],
        Window { lowest, far, .. }: Window,
        best: &mut Option<(u32, (usize, Corner))>,
    ) {
        let lowest_height = turned.iter().map(|mask| mask.size[1]).min().unwrap_or(0);
        let within = |reach: [u32; 2]| [0, 1].map(|k| reach[k].min(far[k]));
        let limit = best.map_or(self.capacity, |(side, _)| side - 1);
        let [mut right, mut top] = within(self.form.reach(limit));
        let mut y = lowest.y;
        while y + lowest_height <= top {
            for (index, mask) in turned.iter().enumerate() {
                let [width, height] = mask.size;
                if width > right || y + height > top {
                    continue;
                }
                let columns = [lowest.x, right - width];
                let corner = Corner { page, x: 0, y };
                if let Some(x) = self.first_free(mask, corner, columns) {
                    let side = self.form.side([x + width, y + height]).max(self.side);
                    *best = Some((side, (index, Corner { x, ..corner })));
                    if side == self.side {
                        return;
                    }
                    [right, top] = within(self.form.reach(side - 1));
                }
            }
            y += 1;
        }
    }

    /// Returns the smallest free x between two columns, both included, in the row of `corner`.
    fn first_free(
        &mut self,
        mask: &Turned,
        corner: Corner,
        columns @ [first, last]: [u32; 2],
    ) -> Option<u32> {
        if first > last {
            return None;
        }
        let mut words = first / 64..last / 64 + 1;
        while !words.is_empty() {
            let (free, n) = match words.len() {
                1 => (self.free_among::<1>(mask, corner, words.start, columns), 1),
                2 | 3 => (self.free_among::<2>(mask, corner, words.start, columns), 2),
                _ => (self.free_among::<4>(mask, corner, words.start, columns), 4),
            };
            if free.is_some() {
                return free;
            }
            words.start += n;
        }
        None
    }

    /// Searches like [`first_free`](Self::first_free), among the columns in `N` words from `word` on.
    fn free_among<const N: usize>(
        &mut self,
        mask: &Turned,
        corner: Corner,
        word: u32,
        columns: [u32; 2],
    ) -> Option<u32> {
        let mut blocked: [u64; N] = from_fn(|i| outside(columns, word + i as u32));
        let inset = 64 * word + self.frame - mask.margin;
        let base = (self.row(corner) - mask.margin as usize) * WIDTHS;
        for probe in &mask.probes {
            let row = &self.rows[(base + probe.lane as usize) * self.words..];
            self.work += N as u64;
            for start in probe.starts {
                add_shifted(&mut blocked, row, inset + start);
            }
            if blocked == [u64::MAX; N] {
                return None;
            }
        }
        let free = blocked.iter().position(|&word| word != u64::MAX)? as u32;
        Some(64 * (word + free) + blocked[free as usize].trailing_ones())
    }

    /// Occupies the cells of a mask's body whose lower left cell is at `corner`, and updates the used part.
    pub(super) fn take(&mut self, mask: &Turned, corner: Corner) {
        let Corner { page, x, y } = corner;
        self.cover(&mask.body, page, [i64::from(x), i64::from(y)]);
        let [right, top] = [x + mask.size[0], y + mask.size[1]];
        self.side = self.side.max(self.form.side([right, top]));
        let highest = &mut self.tops[page as usize];
        *highest = top.max(*highest);
    }

    /// Occupies the cells of a body whose lower left cell is at `corner`, including cells in the frame but none beyond it. The used
    /// part stays as it is.
    pub(super) fn cover(&mut self, body: &[CellRun], page: u32, corner: [i64; 2]) {
        let stride = self.words * WIDTHS;
        let frame = i64::from(self.frame);
        let width = i64::from(self.form.reach(self.capacity)[0]) + 2 * frame;
        let column = |x: u32| (i64::from(x) + corner[0] + frame).clamp(0, width) as u32;
        for runs in body.chunk_by(|a, b| a.row == b.row) {
            let row = i64::from(runs[0].row) + corner[1] + frame;
            let taken = [runs[0].start, runs[runs.len() - 1].end].map(column);
            if !(0..self.height as i64).contains(&row) || taken[0] == taken[1] {
                continue;
            }
            let row = page as usize * self.height + row as usize;
            let row = &mut self.rows[row * stride..][..stride];
            for run in runs {
                let [start, end] = [run.start, run.end].map(column);
                if start < end {
                    set_bits(&mut row[..self.words], start, end);
                }
            }
            widen(row, self.words, taken);
        }
    }

    /// Returns the index of the row of a corner among the rows of all pages.
    fn row(&self, corner: Corner) -> usize {
        corner.page as usize * self.height + (corner.y + self.frame) as usize
    }
}

/// Updates the wider windows of a row after cells between `start` and `end` were occupied.
pub(super) fn widen(row: &mut [u64], words: usize, [start, end]: [u32; 2]) {
    let last = ((end - 1) / 64) as usize;
    let after = |k: usize| {
        if last + 1 < words {
            row[k * words + last + 1]
        } else {
            0
        }
    };
    let mut next: [u64; WIDTHS] = from_fn(after);
    // The widest window that contains a cell begins less than 64 cells before it.
    for word in ((start.saturating_sub(63) / 64) as usize..=last).rev() {
        let mut cells = row[word];
        for k in 0..WIDTHS - 1 {
            let wide = cells | cells >> (1 << k) | next[k] << (64 - (1 << k));
            next[k] = cells;
            cells = wide;
            row[(k + 1) * words + word] = wide;
        }
    }
}

/// Sets the bits of `blocked` that are set in the row, which is read from bit `shift` on.
pub(super) fn add_shifted<const N: usize>(blocked: &mut [u64; N], row: &[u64], shift: u32) {
    let (first, shift) = ((shift / 64) as usize, shift % 64);
    let row = &row[first..=first + N];
    for i in 0..N {
        // The double shift avoids a shift by 64 if `shift` is 0.
        blocked[i] |= row[i] >> shift | row[i + 1] << 1 << (63 - shift);
    }
}

/// Returns the bits of a word of a row that lie outside two columns, which themselves are inside.
pub(super) fn outside([first, last]: [u32; 2], word: u32) -> u64 {
    let below = |column: u32| match column.saturating_sub(64 * word) {
        bits @ 0..64 => !(u64::MAX << bits),
        _ => u64::MAX,
    };
    below(first) | !below(last + 1)
}

/// Position of a body's lower left cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Corner {
    pub page: u32,
    /// Column and row.
    pub x: u32,
    pub y: u32,
}

/// Region in which a place is searched. On pages after the first, columns and rows start at 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub lowest: Corner,
    /// First page that does not count.
    pub end_page: u32,
    /// Columns and rows that masks must not reach.
    pub far: [u32; 2],
}

impl Window {
    /// All pages.
    pub(super) const ALL: Self = Self::from(Corner {
        page: 0,
        x: 0,
        y: 0,
    });

    /// Returns the window that extends to the right and up from a corner, and contains all later pages.
    pub(super) const fn from(lowest: Corner) -> Self {
        Self {
            lowest,
            end_page: u32::MAX,
            far: [u32::MAX; 2],
        }
    }
}

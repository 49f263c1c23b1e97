//! Blocks of cells, 64 to a machine word.

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
    pub(super) fn set(&mut self, run: Run) {
        let row = &mut self.bits[run.row as usize * self.words..][..self.words];
        set_bits(row, run.start, run.end);
    }

    /// A quarter turn counter-clockwise: (x, y) goes to (height − 1 − y, x).
    ///
    /// In blocks of 64 by 64 cells: rows are taken from the top down and transposed.
    pub(super) fn quarter_turn(&self) -> Self {
        let mut out = Self::new(self.height, self.width);
        for column in 0..out.words {
            for word in 0..self.words {
                let mut block = [0; 64];
                for (i, row) in (64 * column..self.height as usize).take(64).enumerate() {
                    block[i] = self.bits[(self.height as usize - 1 - row) * self.words + word];
                }
                transpose(&mut block);
                for (i, row) in (64 * word..self.width as usize).take(64).enumerate() {
                    out.bits[row * out.words + column] = block[i];
                }
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

/// Exchanges rows and columns: bit j of word i goes to bit i of word j.
///
/// Halves of the block are exchanged, then halves of each quarter, and so on (Warren, Hacker's Delight, 7-3).
fn transpose(block: &mut [u64; 64]) {
    let (mut size, mut low) = (32, u64::MAX >> 32);
    while size > 0 {
        for i in (0..64).filter(|i| i & size == 0) {
            let swapped = (block[i] >> size ^ block[i + size]) & low;
            block[i] ^= swapped << size;
            block[i + size] ^= swapped;
        }
        size /= 2;
        low ^= low << size;
    }
}

//! Rows of taken cells, 64 to a machine word, and for every width 2ᵏ which windows hold one.

/// Widths of windows: up to 64 cells.
pub(super) const WIDTHS: usize = 7;

/// Derives the wider windows of a row from its cells, of which some between `start` and `end` were taken.
pub(super) fn widen(row: &mut [u64], words: usize, [start, end]: [u32; 2]) {
    let last = (end / 64) as usize;
    let mut next: [u64; WIDTHS] = std::array::from_fn(|k| row[k * words + last + 1]);
    // The widest window that holds a cell begins less than 64 cells before it.
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

/// Adds a row shifted by so many cells, from its first word on.
pub(super) fn add_shifted<const N: usize>(blocked: &mut [u64; N], row: &[u64], shift: u32) {
    let (first, shift) = ((shift / 64) as usize, shift % 64);
    let row = &row[first..=first + N];
    for i in 0..N {
        // The double shift keeps a shift by 0 from becoming one by 64.
        blocked[i] |= row[i] >> shift | row[i + 1] << 1 << (63 - shift);
    }
}

/// The bits of a word of a row that lie outside two columns, both of which are inside.
pub(super) fn outside([first, last]: [u32; 2], word: u32) -> u64 {
    let below = |column: u32| match column.saturating_sub(64 * word) {
        bits @ 0..64 => !(u64::MAX << bits),
        _ => u64::MAX,
    };
    below(first) | !below(last + 1)
}

/// The longest run of zeros among bits.
pub(super) fn longest_zeros(words: &[u64]) -> u32 {
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

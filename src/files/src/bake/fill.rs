//! Texels between charts.

/// Values that can be averaged to fill texels between charts.
pub(super) trait Mean: Copy {
    /// Returns the mean; `None` without values.
    fn mean(values: impl Iterator<Item = Self>) -> Option<Self>;
}

impl Mean for [u8; 4] {
    fn mean(values: impl Iterator<Item = Self>) -> Option<Self> {
        let (mut sum, mut n) = ([0_u32; 4], 0);
        for value in values {
            for (sum, channel) in sum.iter_mut().zip(value) {
                *sum += u32::from(channel);
            }
            n += 1;
        }
        (n > 0).then(|| sum.map(|s| ((s + n / 2) / n) as u8))
    }
}

impl Mean for f32 {
    fn mean(values: impl Iterator<Item = Self>) -> Option<Self> {
        let (sum, n) = values.fold((0.0, 0.0), |(sum, n), value| (sum + value, n + 1.0));
        (n > 0.0).then(|| sum / n)
    }
}

/// Fills the texels without a value from those with one, ring by ring: each gets the mean of its neighbors of earlier
/// rings. A texture without any value becomes `blank`.
pub(super) fn filled<T: Mean>(texels: Vec<Option<T>>, side: usize, blank: T) -> Vec<T> {
    let mut texels = texels;
    let mut ring: Vec<usize> = (0..texels.len())
        .filter(|&texel| texels[texel].is_none() && mean(&texels, side, texel).is_some())
        .collect();
    while !ring.is_empty() {
        let values: Vec<Option<T>> = ring.iter().map(|&t| mean(&texels, side, t)).collect();
        for (&texel, value) in ring.iter().zip(values) {
            texels[texel] = value;
        }
        let mut next: Vec<usize> = ring
            .iter()
            .flat_map(|&texel| around(side, texel))
            .filter(|&texel| texels[texel].is_none())
            .collect();
        next.sort_unstable();
        next.dedup();
        ring = next;
    }
    texels.into_iter().map(|t| t.unwrap_or(blank)).collect()
}

/// Returns the mean of the neighbors that have a value.
fn mean<T: Mean>(texels: &[Option<T>], side: usize, texel: usize) -> Option<T> {
    T::mean(around(side, texel).filter_map(|neighbor| texels[neighbor]))
}

/// Iterates over the up to eight neighbors of a texel.
fn around(side: usize, texel: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (texel % side, texel / side);
    let near = move |c: usize| c.saturating_sub(1)..=(c + 1).min(side - 1);
    near(y)
        .flat_map(move |y| near(x).map(move |x| y * side + x))
        .filter(move |&neighbor| neighbor != texel)
}

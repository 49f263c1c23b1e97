//! Texels between charts.

/// Fills the texels without a value from those with one, ring by ring: each takes the mean of its neighbors of earlier
/// rings. A texture without any value becomes black.
pub(super) fn filled(texels: Vec<Option<[u8; 4]>>, side: usize) -> Vec<[u8; 4]> {
    let mut texels = texels;
    let mut ring: Vec<usize> = (0..texels.len())
        .filter(|&texel| texels[texel].is_none() && mean(&texels, side, texel).is_some())
        .collect();
    while !ring.is_empty() {
        let values: Vec<Option<[u8; 4]>> = ring.iter().map(|&t| mean(&texels, side, t)).collect();
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
    let black = [0, 0, 0, 255];
    texels.into_iter().map(|t| t.unwrap_or(black)).collect()
}

/// The mean of the neighbors that have a value.
fn mean(texels: &[Option<[u8; 4]>], side: usize, texel: usize) -> Option<[u8; 4]> {
    let (mut sum, mut n) = ([0_u32; 4], 0);
    for value in around(side, texel).filter_map(|neighbor| texels[neighbor]) {
        for (sum, channel) in sum.iter_mut().zip(value) {
            *sum += u32::from(channel);
        }
        n += 1;
    }
    (n > 0).then(|| sum.map(|s| ((s + n / 2) / n) as u8))
}

/// The up to eight neighbors of a texel.
fn around(side: usize, texel: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (texel % side, texel / side);
    let near = move |c: usize| c.saturating_sub(1)..=(c + 1).min(side - 1);
    near(y)
        .flat_map(move |y| near(x).map(move |x| y * side + x))
        .filter(move |&neighbor| neighbor != texel)
}

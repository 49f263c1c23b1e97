//! One vertex per position.

use std::collections::HashMap;

/// Distinct positions in the order in which they first appear, and for each input vertex the index of its position.
///
/// Two positions are one when all three coordinates are bit-equal, −0 counting as 0. No tolerance: what is welded here is
/// exactly what is one point in the written file.
pub fn weld(positions: impl ExactSizeIterator<Item = [f64; 3]>) -> (Vec<[f64; 3]>, Vec<u32>) {
    let mut index = HashMap::with_capacity(positions.len());
    let mut distinct = Vec::new();
    let vertex_of = positions
        .map(|p| {
            // Adding zero turns −0 into 0.
            let p = p.map(|x| x + 0.0);
            *index.entry(p.map(f64::to_bits)).or_insert_with(|| {
                distinct.push(p);
                distinct.len() as u32 - 1
            })
        })
        .collect();
    (distinct, vertex_of)
}

//! Welding of equal positions.

use std::collections::HashMap;

/// Returns distinct positions in the order of their first occurrence, and for each input vertex the index of its
/// position.
///
/// Two positions are one if all three coordinates are bit-equal, with −0 counting as 0. There is no tolerance:
/// positions are welded exactly if they are one point in the written file.
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

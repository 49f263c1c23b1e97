//! The border between two sets of faces, as chains of vertices.

use std::collections::BTreeMap;
use unwrapd_maps::cut::Sheet;
use unwrapd_maps::mesh::CUT;

/// Vertices that edges of a border connect, in their order; the first is the last once more if it is a ring.
pub type Chain = Vec<u32>;

/// The border at which the part changes, divided into chains that end where they meet the boundary of the sheet or each other.
pub fn border<T: PartialEq>(sheet: &Sheet, part: &[T]) -> Vec<Chain> {
    let mut at: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (h, &t) in (0u32..).zip(&sheet.twin) {
        if t != CUT && h < t && part[h as usize / 3] != part[t as usize / 3] {
            let [a, b] = sheet.ends(h);
            at.entry(a).or_default().push(b);
            at.entry(b).or_default().push(a);
        }
    }
    let on_boundary = sheet.on_boundary();
    let ends: Vec<u32> = (at.iter())
        .filter(|(v, around)| on_boundary[**v as usize] || around.len() != 2)
        .map(|(&v, _)| v)
        .collect();
    let starts: Vec<u32> = ends.iter().chain(at.keys()).copied().collect();
    let mut chains = Vec::new();
    for start in starts {
        while let Some(next) = at.get_mut(&start).and_then(Vec::pop) {
            chains.push(walked(&mut at, start, next, |v| {
                ends.binary_search(&v).is_ok()
            }));
        }
    }
    chains
}

/// From one vertex over the next to an end, or back; the edges are taken away.
fn walked(
    at: &mut BTreeMap<u32, Vec<u32>>,
    start: u32,
    next: u32,
    is_end: impl Fn(u32) -> bool,
) -> Chain {
    let mut chain = vec![start, next];
    loop {
        let [before, here] = [chain[chain.len() - 2], chain[chain.len() - 1]];
        let Some(around) = at.get_mut(&here) else {
            break;
        };
        if let Some(back) = around.iter().position(|&v| v == before) {
            around.swap_remove(back);
        }
        if here == start || is_end(here) {
            break;
        }
        let Some(next) = around.pop() else {
            break;
        };
        chain.push(next);
    }
    chain
}

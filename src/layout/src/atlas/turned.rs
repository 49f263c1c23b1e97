//! A mask after quarter turns, as the search for a place wants it.

use super::bitmap::Run;
use super::mask::Mask;
use super::probe::Probe;

/// One of the four turned versions of a mask, with what its reach wants free in the order of the test.
pub(super) struct Turned {
    pub turns: u32,
    pub body: Vec<Run>,
    /// Width and height, in cells.
    pub size: [u32; 2],
    pub reach: Vec<Run>,
    pub probes: Vec<Probe>,
    pub margin: u32,
}

impl Turned {
    /// The mask after so many quarter turns.
    pub(super) fn new(mask: Mask, turns: u32) -> Self {
        let turned = (0..turns).fold(mask, |mask, _| mask.quarter_turn());
        Self::of(&turned, turns)
    }

    /// Whether both take the same cells and keep the same ones free.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.size == other.size && self.body == other.body && self.reach == other.reach
    }

    /// The quarter turns that differ: four, or one of a square.
    pub(super) fn all(mask: Mask) -> Vec<Self> {
        let mut masks = vec![mask];
        for turns in 1..4 {
            let turned = masks[turns - 1].quarter_turn();
            if turned == masks[0] {
                break;
            }
            masks.push(turned);
        }
        let turned = masks.into_iter().zip(0..);
        turned.map(|(mask, turns)| Self::of(&mask, turns)).collect()
    }

    fn of(turned: &Mask, turns: u32) -> Self {
        let reach = scattered(turned.reach.runs());
        Self {
            turns,
            probes: Probe::of(&reach),
            reach,
            body: turned.body.runs(),
            size: [turned.body.width, turned.body.height],
            margin: turned.margin,
        }
    }
}

/// The longest run first, then runs far from each other before their neighbors: an occupied place
/// is found out early.
fn scattered(mut runs: Vec<Run>) -> Vec<Run> {
    let bits = usize::BITS - runs.len().leading_zeros();
    let mut keyed: Vec<(usize, Run)> = runs
        .drain(..)
        .enumerate()
        .map(|(i, run)| (i.reverse_bits() >> (usize::BITS - bits.max(1)), run))
        .collect();
    keyed.sort_unstable_by_key(|&(key, _)| key);
    let mut runs: Vec<Run> = keyed.into_iter().map(|(_, run)| run).collect();
    let longest = (0..runs.len()).max_by_key(|&i| (runs[i].end - runs[i].start, usize::MAX - i));
    if let Some(longest) = longest {
        runs.swap(0, longest);
    }
    runs
}

//! The windows of a row that a mask wants free.
use super::bitmap::Run;
use super::row::WIDTHS;

/// Two windows of one width in one row, both of which have to be free.
///
/// A run of length between 2ᵏ and 2ᵏ⁺¹ is free when two windows of 2ᵏ cells are: the first and the last in it. Runs longer than two
/// of the widest windows take several probes.
pub(super) struct Probe {
    /// The row of the mask times [`WIDTHS`], plus k.
    pub lane: u32,
    /// Columns of the mask where the windows begin.
    pub starts: [u32; 2],
}

impl Probe {
    /// Those that tell whether all cells of some runs are free, in the order of the runs.
    pub(super) fn of(runs: &[Run]) -> Vec<Self> {
        let mut probes = Vec::with_capacity(runs.len());
        for run in runs {
            let k = (run.end - run.start).ilog2().min(WIDTHS as u32 - 1);
            let width = 1 << k;
            let (mut first, last) = (run.start, run.end - width);
            loop {
                let second = (first + width).min(last);
                probes.push(Self {
                    lane: run.row * WIDTHS as u32 + k,
                    starts: [first, second],
                });
                if second == last {
                    break;
                }
                first = (second + width).min(last);
            }
        }
        probes
    }
}

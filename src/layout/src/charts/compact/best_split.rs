//! Charts cut into pieces that fill their convex hulls better, so that they leave less of a square empty.

use super::chord::{Chord, chords};
use super::split::Split;
use super::splitter::Splitter;
use crate::charts::MappedChart;
use unwrapd_maps::cut::Sheet;
use unwrapd_method::solver::Control;

/// Seams along chords of which the best counts, and chords at most that are tried for them: near some there is none.
const REFINED: usize = 4;
const TRIED: usize = 32;
/// Seams of a large chart, and how many faces that has at least: there a seam takes long to find, and differs less from its chord.
const REFINED_IF_LARGE: usize = 2;
const LARGE: usize = 100_000;

impl MappedChart {
    /// The seam that makes the chart's parts most compact and small for its length; none if no cut leaves two parts of some size.
    ///
    /// Candidates are straight chords of the map; the best are moved within a narrow band to where a seam costs least, a minimum
    /// cut, which prefers creases. Planes are cut only where the page is too small for a chart that cannot be cut elsewhere. `unit` is the square root of the area on a page. None either once `control` says to end.
    pub fn best_split(&self, unit: f64, control: &dyn Fn() -> Control) -> Option<Split> {
        let goes_on = || control() == Control::Continue;
        if !goes_on() {
            return None;
        }
        let sheet = Sheet::of_disk(&self.chart.disk, &self.chart.positions);
        let splitter = Splitter::new(self, &sheet, unit);
        let best = best_of(&splitter, control).or_else(|| {
            let splitter = splitter.cutting_planes()?;
            best_of(&splitter, control)
        });
        best.filter(|_| goes_on())
    }
}

fn best_of(splitter: &Splitter, control: &dyn Fn() -> Control) -> Option<Split> {
    let mut chords = chords(&splitter.clusters, splitter.crumb, splitter.square);
    let worth = |chord: &Chord| splitter.worth(chord.gain, chord.area, chord.length, 1);
    chords.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
    chords.dedup_by(|a, b| a.is_like(b));
    let tried = chords.iter().take(TRIED);
    let tried = tried.take_while(|_| control() == Control::Continue);
    let refined = if splitter.n_faces() < LARGE {
        REFINED
    } else {
        REFINED_IF_LARGE
    };
    let splits = tried.filter_map(|chord| splitter.split(chord, control));
    splits
        .take(refined)
        .max_by(|a, b| a.worth.total_cmp(&b.worth))
}

//! Charts cut into pieces that fill their convex hulls better, so that they leave less of a square empty.

use super::chord::{Chord, chords};
use super::splitter::{Split, Splitter};
use crate::charts::MappedChart;
use crate::charts::parts::{parted, parts};
use crate::cut::Sheet;
use crate::numerics::vec3::distance;
use crate::solver::Control;

/// Seams along chords of which the best counts, and chords at most that are tried for them: near some there is none.
const REFINED: usize = 4;
const TRIED: usize = 32;

impl MappedChart {
    /// The seam that makes the chart's parts most compact and small for its length; none if no cut leaves two parts of some size.
    ///
    /// Candidates are straight chords of the map; the best are moved within a narrow band to where a seam costs least, a minimum
    /// cut, which prefers creases. `unit` is the square root of the area on a page. None either once `control` says to end.
    pub fn best_split(&self, unit: f64, control: &dyn Fn() -> Control) -> Option<Split> {
        let goes_on = || control() == Control::Continue;
        if !goes_on() {
            return None;
        }
        let disk = &self.chart.disk;
        let mesh = (&*disk.triangles, &*self.chart.positions);
        let labels = vec![0; disk.triangles.len()];
        let sheet = Sheet::divide(mesh, &disk.twins(), &labels, 1).pop()?;
        let splitter = Splitter::new(self, &sheet, unit);
        let mut chords = chords(&splitter.clusters, splitter.crumb, splitter.square);
        let worth = |chord: &Chord| splitter.worth(chord.gain, chord.area, chord.length);
        chords.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
        chords.dedup_by(|a, b| a.is_like(b));
        let tried = chords.iter().take(TRIED).take_while(|_| goes_on());
        let splits = tried.filter_map(|chord| splitter.split(chord, control));
        let best = splits
            .take(REFINED)
            .max_by(|a, b| a.worth.total_cmp(&b.worth));
        best.filter(|_| goes_on())
    }

    /// The two parts, mapped as the whole is, each seen from its front.
    pub fn parted(&self, split: &Split) -> Vec<Self> {
        let twin = parted(&self.chart.disk.twins(), &split.is_piece);
        parts(&self.chart, &twin)
            .into_iter()
            .map(|(chart, faces)| self.restricted(chart, &faces).facing_front())
            .collect()
    }
}

/// Length on the surface of the seams of some charts: the edges at which their boundaries have two sides.
pub fn seam_length(charts: &[MappedChart]) -> f64 {
    let mut lengths: Vec<([[u64; 3]; 2], f64)> = Vec::new();
    for MappedChart { chart, .. } in charts {
        let loops = chart.disk.loops.iter();
        let edges = loops.flat_map(|of| of.iter().zip(of.iter().cycle().skip(1)));
        lengths.extend(edges.map(|(&a, &b)| {
            let [p, q] = [a, b].map(|v| chart.positions[v as usize]);
            let mut ends = [p, q].map(|p| p.map(f64::to_bits));
            ends.sort_unstable();
            (ends, distance(p, q))
        }));
    }
    lengths.sort_unstable_by_key(|&(ends, _)| ends);
    let sides = lengths.chunk_by(|a, b| a.0 == b.0);
    sides.filter(|of| of.len() > 1).map(|of| of[0].1).sum()
}

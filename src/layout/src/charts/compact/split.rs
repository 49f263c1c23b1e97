//! Seams that part charts.

use super::planes::Planes;
use crate::charts::parts::{parted, parts};
use crate::charts::symmetry::counterpart::counterpart;
use crate::charts::symmetry::image::{cut_as_exact_image, cut_as_image};
use crate::charts::{Chart, MappedChart};
use std::cmp::Reverse;
use std::sync::Arc;
use unwrapd_method::numerics::vec3::distance;

/// A seam that parts a chart in two, with its mirror image in a chart that is its own.
#[derive(Clone, Debug)]
pub struct Split {
    /// For each face the part that it belongs to.
    pub(super) part: Vec<u32>,
    /// Length of the seam on the surface; where it crosses a plane it counts several times.
    pub length: f64,
    /// What it does to planes.
    pub(super) planes: Planes,
    /// How much the atlas may be expected to gain from it, for its length.
    pub worth: f64,
}

impl MappedChart {
    /// The parts, mapped as the whole is, each seen from its front.
    pub fn parted(&self, split: &Split) -> Vec<Self> {
        self.parts_of(&parted(&self.chart.disk.twins(), &split.part))
    }

    fn parts_of(&self, twin: &[u32]) -> Vec<Self> {
        parts(&self.chart, twin)
            .into_iter()
            .map(|(chart, faces)| self.restricted(chart, &faces).facing_front())
            .collect()
    }
}

/// The parts of a chart, and of the chart that is its mirror image if there is one, with the places of both, the last first.
pub fn parted_alike(
    charts: &[Arc<MappedChart>],
    place: usize,
    split: &Split,
) -> Vec<(usize, Vec<MappedChart>)> {
    let of = &charts[place];
    let mut parted = vec![(place, of.parted(split))];
    let all: Vec<&Chart> = charts.iter().map(|mapped| &mapped.chart).collect();
    let image = |other: usize| {
        let exactly = (split.planes != Planes::Cut)
            .then(|| cut_as_exact_image(all[other], &of.chart, &split.part));
        (exactly.flatten()).or_else(|| cut_as_image(all[other], &of.chart, &split.part))
    };
    if let Some(other) = counterpart(&all, place)
        && let Some(twin) = image(other)
    {
        parted.push((other, charts[other].parts_of(&twin)));
    }
    parted.sort_by_key(|(place, _)| Reverse(*place));
    parted
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

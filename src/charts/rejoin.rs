//! Parts of a chart joined again.

use super::apart::pushed_apart;
use super::fold::lengths;
use super::mapped::within;
use super::part::{parts_among, twins};
use super::{Chart, MappedChart};
use crate::embed;
use crate::mesh::CUT;
use crate::solver::Watch;
use std::collections::BTreeMap;

/// Parts of a chart at most that are joined again: each costs as much as looking at all of the chart.
const MOST_JOINS: usize = 12;

/// The parts into which a chart was cut where its map overlaps itself, joined where the fold between them is slight: once the deep
/// folds are gone, what else was cut off with them may hold together.
///
/// `pairs` are the faces of the whole that overlap. From the smallest to the largest each part is joined to the one with which it has most border, if all folds of the two, as the
/// whole is mapped, can be pushed apart.
pub fn rejoined(
    whole: &MappedChart,
    cut: Vec<MappedChart>,
    pairs: &[[u32; 2]],
    options: &embed::Options,
    watch: &dyn Watch,
) -> Vec<MappedChart> {
    let mut joints = Joints::new(whole, cut, pairs);
    let mut order: Vec<u32> = joints.parts.keys().copied().collect();
    order.sort_by_key(|label| joints.parts[label].chart.disk.triangles.len());
    order.pop();
    order.truncate(MOST_JOINS);
    for part in order {
        if let Some(neighbor) = joints.neighbor(part) {
            joints.join(part, neighbor, options, watch);
        }
    }
    joints.parts.into_values().collect()
}

/// A chart in parts.
struct Joints<'a> {
    whole: &'a MappedChart,
    twin: Vec<u32>,
    length: Vec<f64>,
    /// The faces that overlap.
    pairs: &'a [[u32; 2]],
    /// For each face its part.
    label: Vec<u32>,
    parts: BTreeMap<u32, MappedChart>,
}

impl<'a> Joints<'a> {
    fn new(whole: &'a MappedChart, cut: Vec<MappedChart>, pairs: &'a [[u32; 2]]) -> Self {
        let of_surface = |corners: &[u32; 3]| corners[0] / 3;
        let faces: BTreeMap<u32, usize> = (whole.chart.corners.iter().map(of_surface))
            .zip(0..)
            .collect();
        let mut label = vec![0; faces.len()];
        for (number, part) in (0..).zip(&cut) {
            for corners in &part.chart.corners {
                label[faces[&of_surface(corners)]] = number;
            }
        }
        Self {
            whole,
            twin: twins(&whole.chart.disk),
            length: lengths(&whole.chart.disk, &whole.chart.positions),
            pairs,
            label,
            parts: (0..).zip(cut).collect(),
        }
    }

    /// The part with which another has the longest border.
    fn neighbor(&self, part: u32) -> Option<u32> {
        let mut border: BTreeMap<u32, f64> = BTreeMap::new();
        for (h, &t) in self.twin.iter().enumerate().filter(|(_, t)| **t != CUT) {
            let (inside, beyond) = (self.label[h / 3], self.label[t as usize / 3]);
            if inside == part && beyond != part {
                *border.entry(beyond).or_default() += self.length[h];
            }
        }
        let longest = border.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
        longest.map(|(label, _)| label)
    }

    /// Joins two parts, if the whole's map of them can be pushed apart.
    fn join(&mut self, a: u32, b: u32, options: &embed::Options, watch: &dyn Watch) {
        let Some((chart, faces)) = self.union(a, b) else {
            return;
        };
        let mut joined = self.whole.restricted(chart, &faces);
        let pairs = within(&faces, self.label.len(), self.pairs);
        let (uv, left) = pushed_apart(&joined.chart, &joined.embedding.uv, pairs, options, watch);
        if !left.is_empty() {
            return;
        }
        joined.embedding.uv = uv;
        for &face in &faces {
            self.label[face as usize] = b;
        }
        self.parts.remove(&a);
        self.parts.insert(b, joined);
    }

    /// The chart of two parts and its faces in the whole.
    fn union(&self, a: u32, b: u32) -> Option<(Chart, Vec<u32>)> {
        let is_in = |f: &u32| [a, b].contains(&self.label[*f as usize]);
        let faces: Vec<u32> = (0..self.label.len() as u32).filter(is_in).collect();
        let mut parts = parts_among(&self.whole.chart, &self.twin, &faces);
        (parts.len() == 1).then(|| parts.swap_remove(0))
    }
}

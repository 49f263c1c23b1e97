//! A surface divided into nets.

use super::metric::Metric;
use super::net::Net;
use std::collections::{BTreeMap, BTreeSet};
use unwrapd_maps::measure::cost::{FIRST_SEAM, PER_CHART};
use unwrapd_maps::mesh::CUT;

/// Share of a square page that charts usually fill if no single chart sets the scale: `pack_square` in the reports of `unwrap`, which is
/// .6 to .8 on most machine parts.
const USUAL_FILL: f64 = 0.75;

/// Nets that together hold every face of a surface once.
pub struct Nets<'a> {
    pub metric: &'a Metric<'a>,
    /// Nets by number; numbers are not used again.
    pub list: BTreeMap<u32, Net>,
    /// For each face the number of its net.
    label: Vec<u32>,
    next: u32,
}

impl<'a> Nets<'a> {
    pub fn new(metric: &'a Metric, nets: Vec<Net>) -> Self {
        let mut all = Self {
            metric,
            list: BTreeMap::new(),
            label: vec![u32::MAX; metric.corners.len()],
            next: 0,
        };
        for net in nets {
            all.add(net);
        }
        all
    }

    /// Adds a net and returns its number; the nets whose faces it takes must have been removed.
    pub fn add(&mut self, net: Net) -> u32 {
        let number = self.next;
        self.next += 1;
        for &face in &net.faces {
            self.label[face as usize] = number;
        }
        self.list.insert(number, net);
        number
    }

    /// Replaces the nets by an earlier state of theirs.
    pub fn restore(&mut self, list: BTreeMap<u32, Net>) {
        for (&number, net) in &list {
            for &face in &net.faces {
                self.label[face as usize] = number;
            }
        }
        self.list = list;
    }

    /// Returns the edges between two nets, in ascending order.
    pub fn contact(&self, a: u32, b: u32) -> Vec<u32> {
        let (a, b) = if self.list[&a].faces.len() <= self.list[&b].faces.len() {
            (a, b)
        } else {
            (b, a)
        };
        let mut edges: Vec<u32> = (self.borders(a))
            .filter(|&(_, other)| other == b)
            .map(|(edge, _)| edge)
            .collect();
        edges.sort_unstable();
        edges
    }

    /// Returns the nets that share an edge with one.
    pub fn neighbors(&self, of: u32) -> BTreeSet<u32> {
        self.borders(of).map(|(_, other)| other).collect()
    }

    /// Returns the edges of a net to others, with the number of the other.
    fn borders(&self, of: u32) -> impl Iterator<Item = (u32, u32)> {
        let halfedges = self.list[&of].faces.iter().flat_map(|&f| 3 * f..3 * f + 3);
        halfedges.filter_map(move |h| {
            let t = self.metric.twin[h as usize];
            let other = (t != CUT).then(|| self.label[t as usize / 3])?;
            (other != of).then(|| (self.metric.edge[h as usize], other))
        })
    }

    /// Returns the total excess.
    pub fn excess(&self) -> f64 {
        self.list.values().map(|net| net.excess).sum()
    }

    /// Returns the total excess by area, not weight.
    pub fn unweighted(&self) -> f64 {
        self.list.values().map(|net| net.unweighted).sum()
    }

    /// Returns the area that is stretched.
    pub fn stretched(&self) -> f64 {
        self.list.values().map(|net| net.stretched).sum()
    }

    /// Estimates the share of a square page that nets of total area 1 fill: the usual share, or less if one long net sets the
    /// scale.
    pub fn fill<'n>(nets: impl Iterator<Item = &'n Net>) -> f64 {
        let largest = nets.map(|net| net.page).fold(0.0, f64::max);
        USUAL_FILL.min(1.0 / largest)
    }

    /// Returns the [cost](unwrapd_maps::measure::cost) of the nets on a square page, for a weight of its fill.
    pub fn cost(&self, fill_weight: f64) -> f64 {
        self.seam_and_charts().ln() - fill_weight * Self::fill(self.list.values())
    }

    /// Returns the cost of `n` nets by the length of their seams, if no single net sets the scale of the page.
    pub fn least_cost(seam: f64, n: usize, fill_weight: f64) -> f64 {
        seam_and_charts(seam, n).ln() - fill_weight * USUAL_FILL
    }

    /// Returns ½ + S + n/10.
    pub fn seam_and_charts(&self) -> f64 {
        seam_and_charts(self.seam(), self.list.len())
    }

    /// Returns the length of the borders between nets and of their slits.
    pub fn seam(&self) -> f64 {
        let is_border = |h: u32| {
            let t = self.metric.twin[h as usize];
            t != CUT && self.label[h as usize / 3] != self.label[t as usize / 3]
        };
        let borders = (0..self.metric.halfedge.len())
            .filter(|&edge| is_border(self.metric.halfedge[edge]))
            .map(|edge| self.metric.length[edge]);
        let slits = self.list.values().map(|net| net.length);
        borders.sum::<f64>() + slits.sum::<f64>()
    }
}

fn seam_and_charts(seam: f64, n: usize) -> f64 {
    FIRST_SEAM + seam + PER_CHART * n as f64
}

//! Charts glued to neighbors.

use super::border::Run;
use super::cost::Cost;
use super::given_back::Giving;
use super::laid::MovedChart;
use crate::charts::mapped::MappedChart;
use crate::charts::unfold::local_minimum::Local;
use crate::charts::unfold::overlaps::overlaps_with;
use crate::charts::unfold::push_apart::all_pushed_apart;
use unwrapd_maps::embed::{self, RestShapes};
use unwrapd_maps::plane::keep_apart;
use unwrapd_method::solver::{Control, Iterate};

/// What minimizing a joint is expected to leave of what laying it costs, at the least. Of 2,972 joints of a sponge that kept the
/// bound 46 had been laid for more, of 6,846 that did not 5,940.
const SETTLED: f64 = 0.1;

/// The least distance that the border of a joint keeps from itself, as a part of its extent: rounding would close what is narrower.
const APART: f64 = 1e-6;

/// The part of a chart's faces, about, that an iteration around a seam takes as long as.
const AROUND_SEAM: usize = 8;

impl Giving<'_> {
    /// Glues a chart to a neighbor, if they can be kept from overlapping within the bound.
    pub(super) fn join(&mut self, number: u32, laid: MovedChart, run: &Run) -> bool {
        let neighbor = &self.charts[&run.neighbor];
        let n_faces = |map: &MappedChart| map.chart.disk.triangles.len();
        let n_glued = n_faces(neighbor) + n_faces(&self.charts[&number]);
        let added = self.added(number, &laid.map);
        if n_glued > self.left || SETTLED * added > self.spare() {
            return false;
        }
        self.left -= n_glued;
        self.observer.worked(n_glued);
        let n_before = n_faces(neighbor) as u32;
        let Some(joint) = laid.glued(neighbor) else {
            return false;
        };
        let new: Vec<u32> = (n_before..n_faces(&joint) as u32).collect();
        let Some(joint) = self.pushed_apart(joint, &new) else {
            return false;
        };
        let rest = joint.rest_shapes();
        let joint = self.settled(joint, &rest, run);
        let cost = Cost::of(&joint, &rest, self.bound);
        let joint = joint.facing_front();
        if !self.allows(&cost, [number, run.neighbor])
            || !keep_apart(&joint.chart.disk.boundary_in(&joint.embedding.uv), APART)
        {
            return false;
        }
        self.charts.remove(&number);
        self.costs.remove(&number);
        self.grounds.remove(&number);
        self.grounds.remove(&run.neighbor);
        self.borders.place(run.neighbor, &joint.chart);
        self.costs.insert(run.neighbor, cost);
        self.charts.insert(run.neighbor, joint);
        true
    }

    fn allows(&self, cost: &Cost, instead_of: [u32; 2]) -> bool {
        let others = self.costs.iter().filter(|(n, _)| !instead_of.contains(n));
        let (excess, stretched) = others.fold((cost.excess, cost.stretched), |sum, (_, cost)| {
            (sum.0 + cost.excess, sum.1 + cost.stretched)
        });
        excess <= self.most.excess && stretched <= self.most.stretched
    }

    /// The excess that a chart has more as it is laid.
    fn added(&self, number: u32, laid: &MappedChart) -> f64 {
        let cost = Cost::of(laid, &laid.rest_shapes(), self.bound);
        cost.excess - self.costs[&number].excess
    }

    /// The excess that all may have more.
    fn spare(&self) -> f64 {
        let costs = self.costs.values();
        self.most.excess - costs.map(|cost| cost.excess).sum::<f64>()
    }

    /// A map of which only these faces may overlap others, with these pushed out of them, if that can be done.
    fn pushed_apart(&self, mut map: MappedChart, these: &[u32]) -> Option<MappedChart> {
        let pairs = overlaps_with(&map.chart.disk, &map.embedding.uv, these);
        let uv = &map.embedding.uv;
        let watch = |_: &Iterate| self.iterated(&map);
        map.embedding.uv = all_pushed_apart(&map.chart, uv, &pairs, self.options, &watch)?;
        Some(map)
    }

    /// An iteration around a seam of a chart is done; whether to go on.
    fn iterated(&self, map: &MappedChart) -> Control {
        self.observer
            .worked(map.chart.disk.triangles.len() / AROUND_SEAM);
        self.observer.control()
    }

    /// Minimized around the seam, if that leaves no overlap.
    fn settled(&self, map: MappedChart, rest: &RestShapes, run: &Run) -> MappedChart {
        let watch = |_: &Iterate| self.iterated(&map);
        let local = Local::new(&map.chart, rest, self.options, &watch);
        let mut uv = local.in_unit(&map.embedding.uv);
        let seam = run.vertices.iter().map(|&[_, v]| v);
        let moved = local.minimize(&mut uv, seam, &[]);
        let mut settled = map.clone();
        settled.embedding.uv = local.in_mesh_unit(&uv);
        if !embed::is_positive(&map.chart.disk.triangles, &settled.embedding.uv) {
            return map;
        }
        self.pushed_apart(settled, &moved).unwrap_or(map)
    }
}

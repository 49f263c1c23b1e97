//! Small charts given back to their neighbors.

use super::border::{Borders, Run, parts_of_runs};
use super::cost::Cost;
use super::laid::Laid;
use super::occupied::Ground;
use crate::charts::bound::quality::Bound;
use crate::charts::mapped::MappedChart;
use crate::charts::observer::Observer;
use crate::charts::unfold::local_minimum::Local;
use crate::charts::unfold::overlaps::overlaps_with;
use crate::charts::unfold::push_apart::pushed_apart;
use crate::embed::{self, RestShapes};
use crate::mesh::Surface;
use crate::plane::keep_apart;
use crate::solver::{Control, Iterate};
use std::collections::{BTreeMap, BTreeSet};

/// Pairs of faces that overlap, at most, where a chart is laid that might be pushed apart from its neighbor.
pub(super) const MOST_PAIRS: usize = 100;

/// The same in a crowd: so many over the number of charts, and at least so many. A seam is less of all seams there, and of 1,500
/// pushes with more than eight pairs on a Menger sponge 14 succeed.
const PAIRS_OF_ALL: usize = 800;
const LEAST_PAIRS: usize = 8;

/// Places at most from which a chart is pushed apart.
const MOST_PUSHED: usize = 4;

/// What minimizing a joint is expected to leave of what laying it costs, at the least. Of 2,972 joints of a sponge that kept the
/// bound 46 had been laid for more, of 6,846 that did not 5,940.
const SETTLED: f64 = 0.1;

/// The least distance that the border of a joint keeps from itself, as a part of its extent: rounding would close what is narrower.
const APART: f64 = 1e-6;

/// Faces that are glued at most, as a multiple of all: gluing costs as much as looking at both charts.
const MOST_GLUED: usize = 25;

/// The part of a chart's faces, about, that an iteration around a seam takes as long as.
const AROUND_SEAM: usize = 8;

/// Charts laid back on neighbors, along edges that both have, where that leaves no overlap and keeps the bound.
///
/// From the smallest on, each is moved rigidly to where a part of its border fits best to a neighbor's, long parts first, and glued
/// there if it covers nothing. Where it covers nothing but slivers it is pushed apart. The map is minimized around the new seam.
pub fn given_back(
    surface: &Surface,
    charts: Vec<MappedChart>,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    some_given_back(surface, charts, &|_| true, bound, options, observer)
}

/// The same where only those of which `is_given` holds are laid on others.
pub fn some_given_back(
    surface: &Surface,
    charts: Vec<MappedChart>,
    is_given: &dyn Fn(&MappedChart) -> bool,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    if charts.len() < 2 {
        return charts;
    }
    let mut giving = Giving::new(surface, charts, bound, options, observer);
    giving.is_given = is_given;
    // What covers nothing costs nothing of the bound: it comes first.
    while giving.pass(0) || giving.pass(MOST_PUSHED) {}
    giving.charts.into_values().collect()
}

/// Where a chart was laid on a neighbor: its number and its faces, the neighbor's, the first halfedge of the run and its edges.
/// With more faces either is another chart.
type Place = [u32; 6];

pub(super) struct Giving<'a> {
    pub(super) borders: Borders<'a>,
    pub(super) charts: BTreeMap<u32, MappedChart>,
    pub(super) costs: BTreeMap<u32, Cost>,
    /// What all may cost.
    most: Cost,
    bound: &'a Bound,
    /// Whether a chart may be laid on another.
    is_given: &'a dyn Fn(&MappedChart) -> bool,
    /// The faces of charts on which others were laid.
    pub(super) grounds: BTreeMap<u32, Ground>,
    /// Those that were pushed, once for each.
    were_pushed: BTreeSet<u32>,
    /// Where charts were laid in vain.
    in_vain: BTreeSet<Place>,
    /// Faces that may still be glued.
    left: usize,
    options: &'a embed::Options,
    observer: &'a dyn Observer,
}

impl<'a> Giving<'a> {
    fn new(
        surface: &'a Surface,
        charts: Vec<MappedChart>,
        bound: &'a Bound,
        options: &'a embed::Options,
        observer: &'a dyn Observer,
    ) -> Self {
        let charts: BTreeMap<u32, MappedChart> = (0..).zip(charts).collect();
        let cost = |map: &MappedChart| Cost::of(map, &map.rest_shapes(), bound);
        let costs = charts.iter().map(|(&n, map)| (n, cost(map)));
        let costs: BTreeMap<u32, Cost> = costs.collect();
        let sum = |of: fn(&Cost) -> f64| costs.values().map(of).sum::<f64>();
        let area = sum(|cost| cost.area);
        Self {
            borders: Borders::new(surface, charts.iter().map(|(&n, map)| (n, &map.chart))),
            most: Cost {
                area,
                excess: sum(|cost| cost.excess).max(bound.budget() * area),
                stretched: sum(|cost| cost.stretched).max(Bound::stretched_budget() * area),
            },
            charts,
            costs,
            bound,
            is_given: &|_| true,
            grounds: BTreeMap::new(),
            were_pushed: BTreeSet::new(),
            in_vain: BTreeSet::new(),
            left: MOST_GLUED * surface.triangles.len(),
            options,
            observer,
        }
    }

    /// Tries to give back each chart but the largest, the smallest first, from so many places at most with a push; false if none was.
    fn pass(&mut self, most_pushed: usize) -> bool {
        let size = |(&number, cost): (&u32, &Cost)| (cost.area.to_bits(), number);
        let mut queue: BTreeSet<(u64, u32)> = self.costs.iter().map(size).collect();
        let n = queue.len();
        while queue.len() > 1
            && self.observer.control() == Control::Continue
            && let Some((_, number)) = queue.pop_first()
        {
            // With its mirror image another may have been given back.
            if self
                .charts
                .get(&number)
                .is_none_or(|map| !(self.is_given)(map))
            {
                continue;
            }
            if let Some(neighbor) = self.give_back(number, most_pushed) {
                queue.retain(|&(_, other)| other != neighbor);
                queue.insert(size((&neighbor, &self.costs[&neighbor])));
            }
        }
        self.charts.len() < n
    }

    /// Gives a chart back to a neighbor, which is returned.
    fn give_back(&mut self, number: u32, most_pushed: usize) -> Option<u32> {
        let runs = self.borders.runs(number, &self.charts);
        let map = &self.charts[&number];
        self.observer.worked(map.chart.disk.triangles.len());
        let most_pairs = (PAIRS_OF_ALL / self.charts.len()).clamp(LEAST_PAIRS, MOST_PAIRS);
        let mut pushed: Vec<(usize, Run)> = Vec::new();
        for run in parts_of_runs(&runs, &map.embedding.uv) {
            if self.observer.control() == Control::Finish {
                return None;
            }
            let place = self.place(number, &run);
            if self.in_vain.contains(&place) {
                continue;
            }
            let neighbor = &self.charts[&run.neighbor];
            if let Some(laid) = Laid::new(&self.charts[&number], neighbor, &run) {
                let ground = self.grounds.entry(run.neighbor);
                let ground = ground.or_insert_with(|| Ground::new(neighbor));
                match laid.n_overlaps(ground, most_pairs) {
                    0 if self.join_alike(number, laid, &run) => return Some(run.neighbor),
                    n if n > 0 && n <= most_pairs => {
                        pushed.push((n, run));
                        continue;
                    }
                    _ => {}
                }
            }
            self.in_vain.insert(place);
        }
        if most_pushed == 0 || !self.were_pushed.insert(number) {
            return None;
        }
        pushed.sort_by_key(|(n, _)| *n);
        pushed.truncate(most_pushed);
        for (_, run) in pushed {
            let neighbor = &self.charts[&run.neighbor];
            if self.observer.control() == Control::Continue
                && let Some(laid) = Laid::new(&self.charts[&number], neighbor, &run)
                && self.join_alike(number, laid, &run)
            {
                return Some(run.neighbor);
            }
        }
        None
    }

    fn place(&self, number: u32, run: &Run) -> Place {
        let faces = |number: u32| self.charts[&number].chart.disk.triangles.len() as u32;
        [
            number,
            faces(number),
            run.neighbor,
            faces(run.neighbor),
            run.halfedges[0],
            run.halfedges.len() as u32,
        ]
    }

    /// Glues a chart to a neighbor, if they can be kept from overlapping within the bound.
    pub(super) fn join(&mut self, number: u32, laid: Laid, run: &Run) -> bool {
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
        let (uv, left) = pushed_apart(&map.chart, uv, pairs, self.options, &watch);
        map.embedding.uv = uv;
        left.is_empty().then_some(map)
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

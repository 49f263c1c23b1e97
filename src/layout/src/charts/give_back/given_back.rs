//! Small charts given back to their neighbors.

use super::border::{ChartBorders, Run, parts_of_runs};
use super::cost::Cost;
use super::laid::MovedChart;
use super::occupied::Ground;
use crate::charts::bound::quality::Bound;
use crate::charts::mapped::MappedChart;
use crate::charts::observer::Observer;
use std::collections::{BTreeMap, BTreeSet};
use unwrapd_maps::embed;
use unwrapd_maps::mesh::Surface;
use unwrapd_method::solver::Control;

/// Pairs of faces that overlap, at most, where a chart is laid that might be pushed apart from its neighbor.
pub(super) const MOST_PAIRS: usize = 100;

/// The same in a crowd: so many over the number of charts, and at least so many. A seam is less of all seams there, and of 1,500
/// pushes with more than eight pairs on a Menger sponge 14 succeed.
const PAIRS_OF_ALL: usize = 800;
const LEAST_PAIRS: usize = 8;

/// Places at most from which a chart is pushed apart.
const MOST_PUSHED: usize = 4;

/// Faces that are glued at most, as a multiple of all: gluing costs as much as looking at both charts.
const MOST_GLUED: usize = 25;

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
    if charts.len() < 2 {
        return charts;
    }
    let mut giving = Giving::new(surface, charts, bound, options, observer);
    // What covers nothing costs nothing of the bound: it comes first.
    while giving.pass(0) || giving.pass(MOST_PUSHED) {}
    giving.charts.into_values().collect()
}

/// Where a chart was laid on a neighbor: its number and its faces, the neighbor's, the first halfedge of the run and its edges.
/// With more faces either is another chart.
type GluingPlace = [u32; 6];

pub(super) struct Giving<'a> {
    pub(super) borders: ChartBorders<'a>,
    pub(super) charts: BTreeMap<u32, MappedChart>,
    pub(super) costs: BTreeMap<u32, Cost>,
    /// What all may cost.
    pub(super) most: Cost,
    pub(super) bound: &'a Bound,
    /// The faces of charts on which others were laid.
    pub(super) grounds: BTreeMap<u32, Ground>,
    /// Those that were pushed, once for each.
    were_pushed: BTreeSet<u32>,
    /// Where charts were laid in vain.
    in_vain: BTreeSet<GluingPlace>,
    /// Faces that may still be glued.
    pub(super) left: usize,
    pub(super) options: &'a embed::Options,
    pub(super) observer: &'a dyn Observer,
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
            borders: ChartBorders::new(surface, charts.iter().map(|(&n, map)| (n, &map.chart))),
            most: Cost {
                area,
                excess: sum(|cost| cost.excess).max(bound.budget() * area),
                stretched: sum(|cost| cost.stretched).max(Bound::stretched_budget() * area),
            },
            charts,
            costs,
            bound,
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
            if !self.charts.contains_key(&number) {
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
            if let Some(laid) = MovedChart::new(&self.charts[&number], neighbor, &run) {
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
                && let Some(laid) = MovedChart::new(&self.charts[&number], neighbor, &run)
                && self.join_alike(number, laid, &run)
            {
                return Some(run.neighbor);
            }
        }
        None
    }

    fn place(&self, number: u32, run: &Run) -> GluingPlace {
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
}

//! The other start: components, each slit open until the maps keep the bound.
//!
//! A component that is opened to a disk is slit further, each time along the path where one sparse solve predicts the most relief
//! for its length (`prediction`). The slits are planned one by one, and the bound says how many of them are made: the excess of the
//! last map over its prediction tells what to expect of the next. All components share one budget. Where a map overlaps itself, the
//! component is parted; the search glues the parts again where that pays.

use super::cut_mesh::CutMesh;
use super::effort::SearchEffort;
use super::metric::Metric;
use super::net::{Net, chart, weighted};
use super::nets::Nets;
use super::opening::{Slit, best, first_slit, paths, slits_along};
use super::prediction::{Grounded, Prediction};
use super::sets::union;
use super::state::Search;
use crate::charts::{Chart, MappedChart, Watching, overlaps, pushed_apart};
use rayon::prelude::*;
use unwrapd_maps::cut::{self, Branches, Neighbors};
use unwrapd_maps::embed;
use unwrapd_maps::mesh::{CUT, Surface, UnionFind};
use unwrapd_method::numerics::ties::tied;

/// Pairs of vertices far apart between which a closed component may be opened. With one, ln(1/2 + S + n/10) of a cow is higher by .05, a
/// toy with non-manifold edges has no map, and the sum over 26 machine parts and game assets is lower by .08 (`cargo bench -p
/// unwrapd-layout --bench search`).
const FAR_APART: usize = 4;
/// Excess of a map over its prediction before one is known. Measured on 14 meshes: 0.2 to 0.6.
const USUAL_RATIO: f64 = 0.34;
/// Maps of a component at most. One to seven were needed on 36 meshes.
const MOST_ROUNDS: i32 = 8;
/// Budget that a round aims at, over that of the round before: where maps keep falling short, less is aimed at. Not tuned.
const PROMISE: f64 = 0.95;
/// Share of the budget that may be left unspent; with more, slits are taken back. Not tuned.
const UNSPENT: f64 = 0.3;

/// A component, with slits that are planned one by one.
struct Slitting<'a> {
    mesh: &'a CutMesh<'a>,
    neighbors: Neighbors,
    prediction: Prediction<'a>,
    /// Slits that open it to a disk.
    opening: &'a [u32],
    /// Predicted excess without further slits.
    unslit: f64,
    /// Further slits, in the order in which they were planned.
    plan: Vec<Slit>,
    /// Number of slits of the plan that are made.
    n_made: usize,
    /// Excess of the last map over its prediction.
    ratio: f64,
    /// The last map; `None` if the slits have changed since.
    map: Option<Mapped>,
}

/// Map of a component with some slits, which may overlap itself.
struct Mapped {
    map: MappedChart,
    excess: f64,
}

impl<'a> Slitting<'a> {
    /// Creates a component without slits; `None` if it is no disk.
    fn new(mesh: &'a CutMesh<'a>, opening: &'a [u32]) -> Option<Self> {
        let prediction = Prediction::new(mesh)?;
        Some(Self {
            neighbors: Neighbors::new(&mesh.sheet),
            unslit: prediction.excess(),
            prediction,
            mesh,
            opening,
            plan: Vec::new(),
            n_made: 0,
            ratio: USUAL_RATIO,
            map: None,
        })
    }

    /// Returns the next slit, the one that relieves most for its length; `None` where nothing is distorted.
    ///
    /// A slit may be predicted to relieve nothing: where most of a component shrinks alike, some of it has to be opened first.
    fn next_slit(&mut self, effort: &mut SearchEffort) -> Option<&Slit> {
        if self.n_made == self.plan.len() {
            let (slit, grounded) = self.best_slit(effort)?;
            self.prediction.accept(grounded);
            self.plan.push(slit);
        }
        Some(&self.plan[self.n_made])
    }

    fn best_slit(&mut self, effort: &mut SearchEffort) -> Option<(Slit, Grounded)> {
        let paths = paths(self.mesh, &self.neighbors, &self.prediction);
        // Saddles at its end count as relieved: what overlaps there is parted later.
        let relieved = |path: &[u32]| {
            let ends = path.iter().flat_map(|&h| self.mesh.sheet.ends(h));
            ends.collect()
        };
        let prediction = &mut self.prediction;
        best(slits_along(paths, self.mesh, prediction, relieved, effort))
    }

    /// Returns the slits that are made, with those that open the component.
    fn slits(&self) -> Vec<u32> {
        let made = self.plan[..self.n_made].iter();
        made.fold(self.opening.to_vec(), |slits, slit| {
            union(&slits, &slit.edges)
        })
    }

    /// Returns the excess that is predicted with the first `n` slits of the plan.
    fn predicted(&self, n: usize) -> f64 {
        n.checked_sub(1)
            .map_or(self.unslit, |last| self.plan[last].excess)
    }

    /// Returns the excess of the map, or the expected one.
    fn excess(&self) -> f64 {
        match &self.map {
            Some(mapped) => mapped.excess,
            None => self.ratio * self.predicted(self.n_made),
        }
    }
}

impl Search<'_> {
    /// Starts from the components of the surface; returns `None` if one of them has no map, or the slits alone cost `most`.
    pub fn start_from_components(&mut self, most: f64) -> Option<()> {
        let metric = self.nets.metric;
        let components = components(metric);
        let ways: Vec<Vec<Vec<u32>>> = (components.iter())
            .map(|faces| ways_to_open(metric, faces))
            .collect();
        let meshes: Vec<Vec<CutMesh>> = (components.iter().zip(&ways))
            .map(|(faces, ways)| {
                (ways.iter().map(|slits| CutMesh::new(metric, faces, slits))).collect()
            })
            .collect();
        let mut slittings = Vec::new();
        for (meshes, ways) in meshes.iter().zip(&ways) {
            let ways = meshes.iter().zip(ways);
            let ways = ways.filter_map(|(mesh, slits)| Slitting::new(mesh, slits));
            slittings.push(self.shortest(ways.collect())?);
        }
        self.slit_under_bound(&mut slittings, most)?;
        let maps = slittings.into_iter().filter_map(|slitting| slitting.map);
        let nets = maps.flat_map(|mapped| self.parted(mapped.map));
        self.nets = Nets::new(metric, nets.collect());
        Some(())
    }

    /// Returns the way to open a component to a disk that promises to keep the bound with the shortest slits; `None` if there is none.
    ///
    /// It has the least length of slits times the excess that they leave: longer slits are not worse if they leave less.
    fn shortest<'a>(&mut self, mut ways: Vec<Slitting<'a>>) -> Option<Slitting<'a>> {
        if ways.len() < 2 {
            return ways.pop();
        }
        let metric = self.nets.metric;
        let faces = ways[0].mesh.faces.iter();
        let weight: f64 = faces.map(|&face| metric.weight[face as usize]).sum();
        let budget = self.budget * weight / metric.weight.iter().sum::<f64>();
        let mut best: Option<(f64, Slitting)> = None;
        for slitting in ways {
            let mut slitting = [slitting];
            self.slit_until(&mut slitting, budget);
            let [slitting] = slitting;
            let price = tied(metric.length_of(&slitting.slits()) * slitting.excess());
            if best.as_ref().is_none_or(|(least, _)| price < *least) {
                best = Some((price, slitting));
            }
        }
        best.map(|(_, slitting)| slitting)
    }

    /// Slits components until their maps keep the bound, as far as slits help; returns `None` if that costs `most`.
    fn slit_under_bound(&mut self, slittings: &mut [Slitting], most: f64) -> Option<()> {
        let mut wanted = self.budget;
        for round in 0..MOST_ROUNDS {
            self.slit_until(slittings, wanted);
            let slits = slittings
                .iter()
                .map(|it| self.nets.metric.length_of(&it.slits()));
            if Nets::least_cost(slits.sum(), slittings.len(), self.fill_weight) >= most {
                return None;
            }
            self.map_all(slittings)?;
            let excess = excess_of(slittings);
            if excess <= self.budget || self.must_end() {
                break;
            }
            // Half of the way: slits relieve more than is expected of them.
            let promised = self.budget * PROMISE.powi(round);
            wanted = (excess * promised).sqrt().min(2.0 * promised);
        }
        if self.budget - excess_of(slittings) > UNSPENT * self.budget && !self.must_end() {
            self.take_back(slittings)?;
        }
        Some(())
    }

    /// Plans slits where they relieve most for their length, until no more than some excess is expected.
    fn slit_until(&mut self, slittings: &mut [Slitting], wanted: f64) {
        while excess_of(slittings) > wanted && !self.must_end() {
            let mut best: Option<([f64; 2], usize)> = None;
            for (place, slitting) in slittings.iter_mut().enumerate() {
                let (ratio, excess) = (slitting.ratio, slitting.excess());
                if let Some(slit) = slitting.next_slit(&mut self.counts.effort) {
                    let rate = [ratio * slit.rate, excess];
                    if best.is_none_or(|(most, _)| rate > most) {
                        best = Some((rate, place));
                    }
                }
            }
            let Some((_, place)) = best else { return };
            let slitting = &mut slittings[place];
            slitting.n_made += 1;
            slitting.map = None;
            self.observer.worked(slitting.mesh.faces.len());
        }
    }

    /// Maps the components whose slits have changed.
    fn map_all(&mut self, slittings: &mut [Slitting]) -> Option<()> {
        for slitting in slittings.iter_mut().filter(|it| it.map.is_none()) {
            let mapped = self.mapped(slitting)?;
            let predicted = slitting.predicted(slitting.n_made);
            slitting.ratio = mapped.excess / predicted.max(f64::MIN_POSITIVE);
            slitting.map = Some(mapped);
        }
        Some(())
    }

    /// Maps a component with its slits; returns `None` if the map has flips.
    fn mapped(&mut self, slitting: &Slitting) -> Option<Mapped> {
        let (metric, observer) = (self.nets.metric, self.observer);
        let begin = observer.elapsed();
        let mesh = CutMesh::new(metric, slitting.mesh.faces, &slitting.slits());
        let chart = chart(&mesh)?;
        self.counts.maps += 1;
        self.counts.effort.mapped_faces += mesh.faces.len();
        let options = weighted(self.options, metric, mesh.faces);
        let watching = Watching {
            chart: &chart,
            observer,
        };
        let embedding = embed::parameterize(&chart.disk, &chart.positions, &options, &watching);
        if !embed::is_positive(&chart.disk.triangles, &embedding.uv) {
            return None;
        }
        let map = MappedChart {
            chart,
            embedding,
            seconds: observer.elapsed().saturating_sub(begin).as_secs_f64(),
        };
        Some(Mapped {
            excess: Net::of_chart(metric, &map).excess,
            map,
        })
    }

    /// Takes back the slits that the bound can do without, if the maps are as good as expected then.
    fn take_back(&mut self, slittings: &mut [Slitting]) -> Option<()> {
        let made: Vec<usize> = slittings.iter().map(|slitting| slitting.n_made).collect();
        let mut before = Vec::new();
        unslit_until(slittings, self.budget, &mut before);
        self.map_all(slittings)?;
        if excess_of(slittings) > self.budget {
            for (place, map) in before {
                slittings[place].n_made = made[place];
                slittings[place].map = Some(map);
            }
        }
        Some(())
    }

    /// Parts a map where it overlaps itself and cannot be pushed apart.
    fn parted(&self, mut map: MappedChart) -> Vec<Net> {
        let (metric, observer) = (self.nets.metric, self.observer);
        let faces: Vec<u32> = (map.chart.corners.iter())
            .map(|corners| corners[0] / 3)
            .collect();
        let options = weighted(self.options, metric, &faces);
        let watching = Watching {
            chart: &map.chart,
            observer,
        };
        let pairs = overlaps(&map.chart.disk, &map.embedding.uv);
        let (uv, pairs) = pushed_apart(&map.chart, &map.embedding.uv, pairs, &options, &watching);
        map.embedding.uv = uv;
        let parts = map.parted_until_free(pairs, &|| observer.control());
        parts
            .iter()
            .map(|part| Net::of_chart(metric, part))
            .collect()
    }
}

/// Opens each component to a disk, possibly with holes, by slits to `n_cones` cone singularities: one after the other, the vertex at
/// which the predicted scale of the map differs most, or a hole that does not lie flat, whichever relieves more for the length of its
/// slit. The slit that opens a closed component of genus 0 has two cones at its ends.
///
/// There are fewer cones where nothing is left to relieve. Returns `None` if a component cannot be opened.
///
/// The choice by the metric is that of Ben-Chen et al. 2008, *Conformal flattening by curvature prescription and metric scaling*. Test:
/// `search::more_cones_lower_the_distortion`.
pub fn charts_at_cones(surface: &Surface, n_cones: usize) -> Option<Vec<Chart>> {
    let metric = Metric::new(surface);
    let charts = components(&metric)
        .into_par_iter()
        .map(|faces| chart_at_cones(&metric, &faces, n_cones));
    charts.collect()
}

fn chart_at_cones(metric: &Metric, faces: &[u32], n_cones: usize) -> Option<Chart> {
    let is_sphere = CutMesh::new(metric, faces, &[]).is_sphere();
    let n_slits = n_cones.saturating_sub(if is_sphere { 2 } else { 0 });
    let mut best: Option<(f64, Vec<u32>)> = None;
    for opening in ways_to_open(metric, faces) {
        let mesh = CutMesh::new(metric, faces, &opening);
        let Some(mut slitting) = Slitting::new(&mesh, &opening) else {
            continue;
        };
        let mut effort = SearchEffort::UNBOUNDED;
        while slitting.n_made < n_slits && slitting.next_slit(&mut effort).is_some() {
            slitting.n_made += 1;
        }
        let excess = tied(slitting.predicted(slitting.n_made));
        if best.as_ref().is_none_or(|(least, _)| excess < *least) {
            best = Some((excess, slitting.slits()));
        }
    }
    chart(&CutMesh::new(metric, faces, &best?.1))
}

/// Returns the faces of each component, in ascending order.
fn components(metric: &Metric) -> Vec<Vec<u32>> {
    let mut sets = UnionFind::new(metric.corners.len());
    for (h, &t) in (0u32..).zip(&metric.twin).filter(|(_, t)| **t != CUT) {
        sets.unite(h / 3, t / 3);
    }
    let (labels, n) = sets.labels();
    let mut components = vec![Vec::new(); n];
    for (face, &label) in (0u32..).zip(&labels) {
        components[label as usize].push(face);
    }
    components
}

/// Returns ways to open a component to a disk, possibly with holes: several for a closed one of genus 0, between vertices far apart and
/// from its sharpest vertex.
fn ways_to_open(metric: &Metric, faces: &[u32]) -> Vec<Vec<u32>> {
    let mesh = CutMesh::new(metric, faces, &[]);
    let mut ways = cut::ways_to_open(&mesh.sheet, Branches::None, FAR_APART);
    if mesh.is_sphere() {
        ways.extend(first_slit(&mesh));
    }
    ways.iter().map(|slits| mesh.edges(slits)).collect()
}

fn excess_of(slittings: &[Slitting]) -> f64 {
    slittings.iter().map(Slitting::excess).sum()
}

/// Takes slits back, the one that relieves least for its length first, as long as no more than some excess is expected. Moves the maps
/// of their components, with their places, to `before`.
fn unslit_until(slittings: &mut [Slitting], wanted: f64, before: &mut Vec<(usize, Mapped)>) {
    loop {
        let all = excess_of(slittings);
        let mut least: Option<(f64, usize)> = None;
        for (place, slitting) in slittings.iter().enumerate() {
            let Some(last) = slitting.n_made.checked_sub(1) else {
                continue;
            };
            let after = all - slitting.excess() + slitting.ratio * slitting.predicted(last);
            let rate = slitting.ratio * slitting.plan[last].rate;
            if after <= wanted && least.is_none_or(|(least, _)| rate < least) {
                least = Some((rate, place));
            }
        }
        let Some((_, place)) = least else { return };
        let slitting = &mut slittings[place];
        before.extend(slitting.map.take().map(|map| (place, map)));
        slitting.n_made -= 1;
    }
}

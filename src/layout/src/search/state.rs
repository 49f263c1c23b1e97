//! The search: glue, give slits back, and let distortion get cheaper.

use super::net::Net;
use super::nets::Nets;
use super::opening::Opening;
use super::sets::union;
use crate::charts::Observer;
use std::collections::HashMap;
use unwrapd_maps::embed;
use unwrapd_maps::measure::cost::PER_CHART;

/// A surface in nets, and what the search knows.
pub struct Search<'a> {
    pub nets: Nets<'a>,
    /// Excess that the nets may have together.
    pub budget: f64,
    /// Length of seam that a chart costs.
    pub per_chart: f64,
    pub options: &'a embed::Options,
    pub observer: &'a dyn Observer,
    /// Maps by their faces and slits, `None` where there is none: each is looked for once.
    known: HashMap<(Vec<u32>, Vec<u32>), Option<Net>>,
    pub counts: Counts,
}

/// Work of a search.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Unions whose openings were predicted.
    pub unions: usize,
    /// Maps.
    pub maps: usize,
    /// Faces of all maps.
    pub mapped_faces: usize,
    /// Faces of all predictions.
    pub predicted_faces: usize,
    /// Maps that flipped or overlapped.
    pub failed: usize,
    /// Unions made.
    pub glued: usize,
    /// Nets opened in a cheaper way.
    pub reopened: usize,
    /// Unions that would have broken the bound.
    pub refused: usize,
}

impl<'a> Search<'a> {
    /// Creates a search that starts from some nets; `budget` is the mean excess that is allowed.
    pub fn new(
        nets: Nets<'a>,
        budget: f64,
        options: &'a embed::Options,
        observer: &'a dyn Observer,
    ) -> Self {
        Self {
            nets,
            budget,
            per_chart: PER_CHART,
            options,
            observer,
            known: HashMap::new(),
            counts: Counts::default(),
        }
    }

    /// Runs the moves at falling prices of the excess, and keeps the cheapest of the states after each.
    pub fn run(&mut self, prices: &[f64]) {
        let mut cheapest = (self.cost(), self.nets.list.clone());
        for &lambda in prices {
            self.glue(lambda);
            self.give_back(lambda);
            let cost = self.cost();
            if cost < cheapest.0 {
                cheapest = (cost, self.nets.list.clone());
            }
        }
        self.nets.list = cheapest.1;
    }

    /// Returns the length of the seams and what the charts cost beside them.
    fn cost(&self) -> f64 {
        self.nets.seam() + self.per_chart * self.nets.list.len() as f64
    }

    /// Maps an opening of some faces, or returns what is known of it.
    pub fn map(&mut self, faces: &[u32], opening: &Opening) -> Option<Net> {
        let (metric, options, observer) = (self.nets.metric, self.options, self.observer);
        let map = || Net::map(metric, faces, opening, options, observer);
        self.known_or(faces, opening, map)
    }

    /// Maps an opening of the union of two nets, or returns what is known of it.
    pub fn map_union(&mut self, nets: [u32; 2], opening: &Opening) -> Option<Net> {
        let [a, b] = nets.map(|net| self.nets.list[&net].clone());
        let (metric, options, observer) = (self.nets.metric, self.options, self.observer);
        let contact = self.nets.contact(nets[0], nets[1]);
        let map = || Net::of_union(metric, [&a, &b], &contact, opening, options, observer);
        self.known_or(&union(&a.faces, &b.faces), opening, map)
    }

    fn known_or(
        &mut self,
        faces: &[u32],
        opening: &Opening,
        map: impl FnOnce() -> Option<Net>,
    ) -> Option<Net> {
        let key = (faces.to_vec(), opening.slits.clone());
        if let Some(net) = self.known.get(&key) {
            return net.clone();
        }
        self.counts.maps += 1;
        self.counts.mapped_faces += faces.len();
        let net = map();
        self.counts.failed += usize::from(net.is_none());
        self.known.insert(key, net.clone());
        net
    }
}

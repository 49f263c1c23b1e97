//! State of the search, and its passes at falling prices of distortion.

use super::effort::SearchEffort;
use super::laid_together::Laid;
use super::metric::Metric;
use super::net::Net;
use super::nets::Nets;
use super::opening::{Opening, Plans};
use super::sets::union;
use super::{LOOSE, Terms};
use crate::charts::{Bound, MappedChart, MirrorPlane, Observer};
use std::collections::HashMap;
use unwrapd_maps::embed;
use unwrapd_method::solver::Control;

/// Share of the effort that may be spent without a move that pays. Seams and charts of 17 machine parts and game assets cost .3 % more
/// than without this end (`cargo bench -p unwrapd-layout --bench search`); organic surfaces, on which few moves pay, take less time.
const PATIENCE: f64 = 0.2;

/// Least share of the effort that is spent on moves, even where the bound is spent. When the cutters were replaced, the sum of the
/// [costs](Search::cost) of 15 organic surfaces without symmetry was 14.24 with 0, 13.96 with .3 and 13.85 with all of it, in 9.9, 11.2 and
/// 15.2 seconds.
const SHARE: f64 = 0.3;

/// A surface in nets, and what the search knows.
pub struct Search<'a> {
    pub nets: Nets<'a>,
    /// Excess that the nets may have together.
    pub budget: f64,
    /// Weight of the fill of a square page beside the cost of the seams.
    pub fill_weight: f64,
    /// Plane in which the surface is its own mirror image.
    pub mirror: Option<MirrorPlane>,
    /// The most effort at the present price.
    most: f64,
    /// Effort that may be spent without a move.
    patience: f64,
    pub options: &'a embed::Options,
    pub observer: &'a dyn Observer,
    /// Plans of slits.
    pub plans: Plans<'a>,
    /// Maps by their faces and slits, `None` where there is none: each is looked for once.
    known: HashMap<(Vec<u32>, Vec<u32>), Option<Net>>,
    pub counts: Counts,
}

/// Work of a search.
#[derive(Clone, Copy, Debug)]
pub struct Counts {
    /// Faces mapped and predicted.
    pub effort: SearchEffort,
    /// Moves whose openings were predicted.
    pub predicted: usize,
    /// Maps.
    pub maps: usize,
    /// Maps that flipped or overlapped.
    pub failed: usize,
    /// Unions that were not mapped, since their parts collide.
    pub collided: usize,
    /// Unions made.
    pub glued: usize,
    /// Nets opened in a cheaper way.
    pub reopened: usize,
    /// Maps that would have broken the bound.
    pub refused: usize,
}

impl Counts {
    /// Creates counts of nothing, with the most that may be done.
    pub fn new(effort: SearchEffort) -> Self {
        Self {
            effort,
            predicted: 0,
            maps: 0,
            failed: 0,
            collided: 0,
            glued: 0,
            reopened: 0,
            refused: 0,
        }
    }
}

impl<'a> Search<'a> {
    /// Creates a search without nets; `budget` is the mean excess that is allowed.
    pub fn new(
        metric: &'a Metric<'a>,
        budget: f64,
        terms: &Terms,
        options: &'a embed::Options,
        observer: &'a dyn Observer,
    ) -> Self {
        Self {
            nets: Nets::new(metric, Vec::new()),
            budget,
            fill_weight: terms.fill_weight,
            mirror: None,
            most: terms.effort.most,
            patience: f64::INFINITY,
            options,
            observer,
            plans: Plans::new(metric),
            known: HashMap::new(),
            counts: Counts::new(terms.effort),
        }
    }

    /// Creates a search of a part of the surface, or a simplification of it, as large in its own units as the surface is here.
    pub fn of_part<'b>(&self, metric: &'b Metric<'b>, observer: &'b dyn Observer) -> Search<'b>
    where
        'a: 'b,
    {
        let n_faces = metric.corners.len();
        let terms = Terms {
            effort: SearchEffort::for_surface(n_faces, n_faces),
            fill_weight: self.fill_weight,
        };
        let search = Search::new(metric, self.budget, &terms, self.options, observer);
        Search {
            mirror: self.mirror,
            ..search
        }
    }

    /// Takes the nets out of the search.
    pub fn take_nets(&mut self) -> Nets<'a> {
        let none = Nets::new(self.nets.metric, Vec::new());
        std::mem::replace(&mut self.nets, none)
    }

    /// Glues nets and gives slits back with the effort that is left, as far as the bound is not spent; with all of it if it is broken.
    pub fn spend_rest(&mut self) {
        let unspent = 1.0 - self.nets.excess() / self.budget.max(f64::MIN_POSITIVE);
        let share = if self.is_broken() {
            1.0
        } else {
            SHARE.max(unspent)
        };
        let most = self.counts.effort.spent() + self.counts.effort.left().share(share).most;
        self.run(&LOOSE, most);
    }

    /// Makes the moves at falling prices of the excess, and keeps the cheapest of the states after each. Each price may take an equal
    /// part of the effort up to `most`, and what the earlier ones left; it ends when no move pays for [`PATIENCE`] of the effort.
    pub fn run(&mut self, prices: &[f64], most: f64) {
        let mut cheapest = (self.cost(), self.nets.list.clone());
        let begin = self.counts.effort.spent();
        let left = most - begin;
        self.patience = PATIENCE * left;
        for (k, &lambda) in (1..).zip(prices) {
            self.most = begin + left * f64::from(k) / prices.len() as f64;
            self.go_on();
            self.make_moves(lambda);
            let cost = self.cost();
            if cost < cheapest.0 {
                cheapest = (cost, self.nets.list.clone());
            }
        }
        self.nets.restore(cheapest.1);
        self.counts.effort.most = most;
    }

    /// Allows further effort, as a move has just paid.
    pub fn go_on(&mut self) {
        let effort = &mut self.counts.effort;
        effort.most = (effort.spent() + self.patience).min(self.most);
    }

    /// Returns the nets as charts.
    pub fn charts(&self) -> Vec<MappedChart> {
        let nets = self.nets.list.values();
        nets.filter_map(|net| net.mapped_chart(self.nets.metric))
            .collect()
    }

    /// Returns whether the nets have more excess than they may have, or more of them is stretched.
    pub fn is_broken(&self) -> bool {
        self.beyond(self.nets.excess()) > 0.0
    }

    /// Returns an excess beyond the bound, and the area beyond that which may be stretched.
    fn beyond(&self, excess: f64) -> f64 {
        let stretched = self.nets.stretched() - Bound::stretched_budget();
        (excess - self.budget).max(0.0) + stretched.max(0.0)
    }

    /// Returns by how much the nets are beyond the bound, and their [cost](unwrapd_maps::measure::cost) on a square page. States are
    /// compared by the first, then by the second.
    pub fn cost(&self) -> [f64; 2] {
        let beyond = self.beyond(self.nets.excess());
        [beyond, self.nets.cost(self.fill_weight)]
    }

    /// Like [`Self::cost`], where panels count no more than other parts: nets that keep the bound itself are not beyond it.
    pub fn cost_unweighted(&self) -> [f64; 2] {
        let beyond = self.beyond(self.nets.unweighted());
        [beyond, self.nets.cost(self.fill_weight)]
    }

    /// Returns the length of seam that costs as much as the fill that is lost if a net replaces others.
    pub fn fill_lost(&self, nets: &[u32], by: &Net) -> f64 {
        let others = self
            .nets
            .list
            .iter()
            .filter(|(number, _)| !nets.contains(number));
        let after = Nets::fill(others.map(|(_, net)| net).chain([by]));
        let lost = Nets::fill(self.nets.list.values()) - after;
        self.fill_weight * lost * self.nets.seam_and_charts()
    }

    /// Returns whether the search has to end: no effort is left, or it was told to finish.
    pub fn must_end(&self) -> bool {
        self.counts.effort.is_spent() || self.observer.control() == Control::Finish
    }

    /// Maps an opening of some faces, or returns what is known of it.
    pub fn map(&mut self, faces: &[u32], opening: &Opening) -> Option<Net> {
        let (metric, options, observer) = (self.nets.metric, self.options, self.observer);
        let map = || Net::map(metric, faces, opening, options, observer);
        self.known_or(faces, opening, map)
    }

    /// Maps an opening of the union of two nets, or returns what is known of it. Nets that collide, or that need no map, count as a
    /// prediction.
    pub fn map_union(&mut self, nets: [u32; 2], opening: &Opening) -> Option<Net> {
        let [a, b] = nets.map(|net| &self.nets.list[&net]);
        let (metric, options, observer) = (self.nets.metric, self.options, self.observer);
        let faces = union(&a.faces, &b.faces);
        let contact = self.nets.contact(nets[0], nets[1]);
        let start = match Laid::new(metric, [a, b], &contact, opening) {
            Laid::Collides => {
                self.counts.collided += 1;
                self.counts.effort.predicted_faces += faces.len();
                return None;
            }
            Laid::Best(net) => {
                self.counts.effort.predicted_faces += faces.len();
                return Some(*net);
            }
            Laid::Start(start) => start,
        };
        let map = || Net::of_union(metric, &faces, start, opening, options, observer);
        self.known_or(&faces, opening, map)
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
        self.counts.effort.mapped_faces += faces.len();
        let begin = self.observer.elapsed();
        let mut net = map();
        if let Some(net) = &mut net {
            net.seconds = (self.observer.elapsed().saturating_sub(begin)).as_secs_f64();
        }
        self.counts.failed += usize::from(net.is_none());
        self.known.insert(key, net.clone());
        net
    }
}

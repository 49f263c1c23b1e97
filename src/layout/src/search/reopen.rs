//! Slits given back.

use super::net::Net;
use super::opening::{MAPPED, Ways};
use super::sets::{branching, chains, difference, halves};
use super::state::Search;
use unwrapd_method::solver::Control;

/// Least gain of a change, so that rounding makes none.
const GAIN: f64 = 1e-6;

impl Search<'_> {
    /// Opens each net afresh, and without one of its slits or half of it, as long as that is cheaper and keeps the bound.
    pub fn give_back(&mut self, lambda: f64) {
        let numbers: Vec<u32> = self.nets.list.keys().copied().collect();
        for number in numbers {
            while !self.nets.list[&number].slits.is_empty()
                && self.observer.control() != Control::Finish
                && let Some(net) = self.cheaper(number, lambda)
            {
                self.counts.reopened += 1;
                self.nets.list.insert(number, net);
            }
        }
    }

    /// Returns a cheaper net of the same faces, if there is one that keeps the bound.
    fn cheaper(&mut self, number: u32, lambda: f64) -> Option<Net> {
        let old = &self.nets.list[&number];
        let (before, price, faces) = (old.excess, old.price(lambda), old.faces.clone());
        let metric = self.nets.metric;
        let breaks = branching(metric, &old.slits);
        let mut starts = vec![Vec::new()];
        for chain in chains(metric, &old.slits, |v| breaks.binary_search(&v).is_ok()) {
            starts.push(difference(&old.slits, &chain));
            let halves = halves(metric, &chain).into_iter().flatten();
            starts.extend(halves.map(|half| difference(&old.slits, &half)));
        }
        let mut ways = Ways::new(metric, starts);
        let mut best: Option<Net> = None;
        for _ in 0..MAPPED {
            let bar = best.as_ref().map_or(price, |net| net.price(lambda));
            ways.cheapest(metric, &faces, lambda, bar - GAIN);
            self.counts.predicted_faces += ways.predicted_faces();
            let Some(way) = ways.take() else {
                break;
            };
            if let Some(net) = self.map(&faces, &way)
                && net.price(lambda) < bar - GAIN
                && self.nets.excess() - before + net.excess <= self.budget
            {
                best = Some(net);
            }
        }
        best
    }
}

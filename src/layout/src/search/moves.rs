//! Nets opened in another way, best first: two neighbors glued, or one net with fewer slits.

use super::cut_mesh::CutMesh;
use super::net::Net;
use super::opening::{GAIN, MAPPED, Ways};
use super::sets::{chains, difference, halves, unbranched, union};
use super::state::Search;
use crate::charts::Bound;
use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};
use std::sync::Arc;
use unwrapd_maps::measure::cost::PER_CHART;

/// Least defect of a vertex, in radians, at which a contact is divided into stretches that may be hinges: ten times the fold
/// within a facet.
const SHARP: f64 = 0.01;
/// Number of stretches of a contact that are tried as the only hinge, the longest ones. Taken from a prototype, not tuned.
const HINGES: usize = 3;

/// A move: one net, or two neighbors, whose faces may be opened in another way.
struct Move {
    /// The most that it may gain, as far as it is known, for each face.
    gain: f64,
    /// Numbers of the nets, in ascending order.
    nets: Vec<u32>,
    faces: Arc<[u32]>,
    /// Length of the border between them.
    contact: f64,
    stage: Stage,
}

/// Progress of the search for an opening.
enum Stage {
    /// Only the nets are known.
    Met,
    /// Openings are predicted, and the best of them mapped.
    Predicted {
        /// Ways that are left to be mapped.
        ways: Ways,
        /// Number of ways that may still be mapped.
        n_left: usize,
        /// The cheapest map so far, with its price.
        best: Option<(f64, Box<Net>)>,
    },
}

impl PartialEq for Move {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Move {}

impl PartialOrd for Move {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Move {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_gain = self.gain.total_cmp(&other.gain);
        by_gain.then_with(|| other.nets.cmp(&self.nets))
    }
}

impl Search<'_> {
    /// Makes moves, best first, until none pays or the effort is spent. A move that would break the bound is refused.
    ///
    /// The best move gains the most per face, since work grows with the faces. A move waits by the most that it could gain, then
    /// by its predicted gain, finally by that of its map; most never leave the first stage.
    pub fn make_moves(&mut self, lambda: f64) {
        let mut heap = BinaryHeap::new();
        let numbers: Vec<u32> = self.nets.list.keys().copied().collect();
        for number in numbers {
            self.push_moves(number, number + 1, lambda, &mut heap);
        }
        while let Some(mut it) = heap.pop() {
            let is_left = it.nets.iter().all(|net| self.nets.list.contains_key(net));
            if !is_left || (it.nets.len() == 1 && !self.may_reopen(it.nets[0])) {
                continue;
            }
            let must_end = self.must_end();
            match &mut it.stage {
                Stage::Met if must_end => continue,
                Stage::Met => {
                    self.counts.predicted += 1;
                    it.stage = Stage::Predicted {
                        ways: Ways::new(self.nets.metric, self.starts(&it)),
                        n_left: MAPPED,
                        best: None,
                    };
                }
                Stage::Predicted { ways, n_left, best } => {
                    if must_end {
                        // Only what is mapped already can still be made.
                        *ways = Ways::new(self.nets.metric, []);
                    }
                    let Some(way) = ways.take() else {
                        // No way that is left promises more than the best map.
                        if let Some((_, net)) = best.take() {
                            self.make(&it.nets, *net, lambda, &mut heap);
                        }
                        continue;
                    };
                    *n_left -= 1;
                    let net = match it.nets[..] {
                        [a, b] => self.map_union([a, b], &way),
                        _ => self.map(&it.faces, &way),
                    };
                    let bar = best.as_ref().map_or(f64::INFINITY, |(price, _)| *price);
                    if let Some(net) = net
                        && self.keeps_bound(&it.nets, &net)
                    {
                        let price = net.price(lambda) + self.fill_lost(&it.nets, &net);
                        if price < bar {
                            *best = Some((price, Box::new(net)));
                        }
                    }
                }
            }
            self.requeue(it, lambda, &mut heap);
        }
    }

    /// Adds the moves of a net: to open it in another way, and to glue it to each neighbor whose number is at least `first`.
    fn push_moves(&self, net: u32, first: u32, lambda: f64, heap: &mut BinaryHeap<Move>) {
        if self.may_reopen(net) {
            heap.push(self.proposed(vec![net], lambda));
        }
        for &other in self.nets.neighbors(net).range(first..) {
            heap.push(self.proposed(vec![net.min(other), net.max(other)], lambda));
        }
    }

    /// Returns whether a net may be opened in another way: one without slits only if the bound is broken.
    fn may_reopen(&self, net: u32) -> bool {
        !self.nets.list[&net].slits.is_empty() || self.is_broken()
    }

    /// Creates a move, with the gain that may be expected of it at best: one net has neither slits nor distortion, and two save their
    /// border and one chart. Two that save slits as well wait longer than they should.
    fn proposed(&self, nets: Vec<u32>, lambda: f64) -> Move {
        let (contact, most) = match nets[..] {
            [a, b] => {
                let contact = self.nets.metric.length_of(&self.nets.contact(a, b));
                (contact, contact + PER_CHART)
            }
            _ => (0.0, self.price_of(&nets, 0.0, lambda)),
        };
        let each = nets.iter().map(|net| &self.nets.list[net]);
        let faces = each.fold(Vec::new(), |faces, net| union(&faces, &net.faces));
        Move {
            gain: most / faces.len() as f64,
            nets,
            faces: faces.into(),
            contact,
            stage: Stage::Met,
        }
    }

    /// Returns the price of some nets as they are, without what one chart costs.
    fn price_of(&self, nets: &[u32], contact: f64, lambda: f64) -> f64 {
        let each = nets.iter().map(|net| self.nets.list[net].price(lambda));
        each.sum::<f64>() + contact + PER_CHART * (nets.len() - 1) as f64
    }

    /// Puts a move back by the price of its best way or map, unless it gains nothing.
    fn requeue(&mut self, mut it: Move, lambda: f64, heap: &mut BinaryHeap<Move>) {
        let before = self.price_of(&it.nets, it.contact, lambda);
        let Stage::Predicted { ways, n_left, best } = &mut it.stage else {
            return;
        };
        let most = before - GAIN;
        let bar = best.as_ref().map_or(most, |(price, _)| price.min(most));
        let way = match n_left {
            0 => None,
            _ => ways.cheapest(
                &mut self.plans,
                &it.faces,
                lambda,
                bar,
                &mut self.counts.effort,
            ),
        };
        let price = if let Some(way) = way {
            way.price(lambda)
        } else {
            *ways = Ways::new(self.nets.metric, []);
            best.as_ref().map_or(before, |(price, _)| *price)
        };
        if price < before - GAIN {
            it.gain = (before - price) / it.faces.len() as f64;
            heap.push(it);
        }
    }

    /// Replaces nets by one of the same faces, if that keeps the bound, and adds its moves.
    fn make(&mut self, nets: &[u32], net: Net, lambda: f64, heap: &mut BinaryHeap<Move>) {
        if !self.keeps_bound(nets, &net) {
            return;
        }
        match nets.len() {
            1 => self.counts.reopened += 1,
            _ => self.counts.glued += 1,
        }
        for net in nets {
            self.nets.list.remove(net);
        }
        let number = self.nets.add(net);
        self.go_on();
        self.push_moves(number, 0, lambda, heap);
    }

    /// Returns whether the bound is kept if a net replaces others, or what is beyond it does not grow; counts refusals.
    fn keeps_bound(&mut self, nets: &[u32], by: &Net) -> bool {
        let is_kept_of = |of: fn(&Net) -> f64, all: f64, most: f64| {
            let replaced: f64 = nets.iter().map(|net| of(&self.nets.list[net])).sum();
            of(by) <= replaced || all - replaced + of(by) <= most
        };
        let stretched = Bound::stretched_budget();
        let is_kept = is_kept_of(|net| net.excess, self.nets.excess(), self.budget)
            && is_kept_of(|net| net.unweighted, self.nets.unweighted(), self.budget)
            && is_kept_of(|net| net.stretched, self.nets.stretched(), stretched);
        self.counts.refused += usize::from(!is_kept);
        is_kept
    }

    /// Returns the slits to start from. For one net: none, and its own without one of them or half of it. For two: those of both, those
    /// that do not end at the contact, and those of both with all of the contact but one stretch of it, a hinge.
    fn starts(&self, it: &Move) -> Vec<Vec<u32>> {
        match it.nets[..] {
            [a, b] => self.starts_of_union([a, b], &it.faces),
            _ => self.starts_of_net(it.nets[0]),
        }
    }

    fn starts_of_net(&self, net: u32) -> Vec<Vec<u32>> {
        let (metric, slits) = (self.nets.metric, &self.nets.list[&net].slits);
        let mut starts = vec![Vec::new()];
        for chain in unbranched(metric, slits) {
            starts.push(difference(slits, &chain));
            let halves = halves(metric, &chain).into_iter().flatten();
            starts.extend(halves.map(|half| difference(slits, &half)));
        }
        starts
    }

    fn starts_of_union(&self, nets: [u32; 2], faces: &[u32]) -> Vec<Vec<u32>> {
        let metric = self.nets.metric;
        let [a, b] = nets.map(|net| &self.nets.list[&net]);
        let contact = self.nets.contact(nets[0], nets[1]);
        let carried = union(&a.slits, &b.slits);
        let mesh = CutMesh::new(metric, faces, &carried);
        let defect = |v: usize| (2.0 * std::f64::consts::PI - mesh.angle[v]).abs();
        let sharp: BTreeSet<u32> = (0..mesh.welded.len())
            .filter(|&v| mesh.is_inner[v] && defect(v) > SHARP)
            .map(|v| mesh.welded[v])
            .collect();
        let mut stretches = chains(metric, &contact, |v| sharp.contains(&v));
        let ends = contact.iter().flat_map(|&edge| metric.ends_of_edge(edge));
        let at_contact: BTreeSet<u32> = ends.collect();
        let ends_there = |chain: &Vec<u32>| {
            let mut ends = chain.iter().flat_map(|&edge| metric.ends_of_edge(edge));
            ends.any(|v| at_contact.contains(&v))
        };
        let there = unbranched(metric, &carried).into_iter().filter(ends_there);
        let away = there.fold(carried.clone(), |away, chain| difference(&away, &chain));
        let mut starts = vec![carried.clone(), away];
        if stretches.len() > 1 {
            stretches.sort_by(|a, b| metric.length_of(b).total_cmp(&metric.length_of(a)));
            starts.extend(stretches.iter().take(HINGES).map(|hinge| {
                let others = difference(&contact, hinge);
                union(&carried, &others)
            }));
        }
        starts
    }
}

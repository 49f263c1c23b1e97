//! Neighbors glued to one net, best first.

use super::cut_mesh::CutMesh;
use super::net::Net;
use super::opening::{MAPPED, Ways};
use super::sets::{chains, difference, union};
use super::state::Search;
use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};
use unwrapd_method::solver::Control;

/// Least defect of a vertex, in radians, at which a contact is divided into stretches that may be hinges: ten times the fold
/// within a facet.
const SHARP: f64 = 0.01;
/// Number of stretches of a contact that are tried as the only hinge, the longest ones. Taken from a prototype, not tuned.
const HINGES: usize = 3;

/// A pair of nets that may be glued.
struct Pair {
    /// The most that gluing may gain, as far as it is known.
    gain: f64,
    nets: [u32; 2],
    /// Length of the border between them.
    contact: f64,
    stage: Stage,
}

/// Progress of the search for a union.
enum Stage {
    /// Only the contact is known.
    Met,
    /// Openings are predicted, and the best of them mapped.
    Predicted {
        /// Ways that are left to be mapped.
        ways: Ways,
        /// Number of ways that may still be mapped.
        n_left: usize,
        /// The cheapest map so far.
        best: Option<Net>,
    },
}

impl PartialEq for Pair {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Pair {}

impl PartialOrd for Pair {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Pair {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_gain = self.gain.total_cmp(&other.gain);
        by_gain.then_with(|| other.nets.cmp(&self.nets))
    }
}

impl Search<'_> {
    /// Glues neighbors, best first, until no union pays. A union that would break the bound is refused.
    ///
    /// A pair waits by the most that it could gain, then by its predicted gain, at last by that of its map; most pairs
    /// never leave the first stage.
    pub fn glue(&mut self, lambda: f64) {
        let mut heap = BinaryHeap::new();
        let numbers: Vec<u32> = self.nets.list.keys().copied().collect();
        for a in numbers {
            for b in self.nets.neighbors(a).range(a + 1..) {
                heap.push(self.pair(a, *b, lambda));
            }
        }
        while let Some(mut pair) = heap.pop() {
            if self.observer.control() == Control::Finish {
                return;
            }
            if !pair.nets.iter().all(|net| self.nets.list.contains_key(net)) {
                continue;
            }
            match &mut pair.stage {
                Stage::Met => {
                    self.counts.unions += 1;
                    let ways = Ways::new(self.nets.metric, self.starts(&pair));
                    pair.stage = Stage::Predicted {
                        ways,
                        n_left: MAPPED,
                        best: None,
                    };
                }
                Stage::Predicted { ways, n_left, best } => {
                    let Some(way) = ways.take() else {
                        // No way that is left promises more than the best map.
                        if let Some(net) = best.take() {
                            self.unite(pair.nets, net, lambda, &mut heap);
                        }
                        continue;
                    };
                    *n_left -= 1;
                    if let Some(net) = self.map_union(pair.nets, &way)
                        && best
                            .as_ref()
                            .is_none_or(|old| net.price(lambda) < old.price(lambda))
                    {
                        *best = Some(net);
                    }
                }
            }
            self.requeue(pair, lambda, &mut heap);
        }
    }

    /// Puts a pair back by the price of its best way or map, unless it gains nothing.
    fn requeue(&mut self, mut pair: Pair, lambda: f64, heap: &mut BinaryHeap<Pair>) {
        let [a, b] = pair.nets.map(|net| &self.nets.list[&net]);
        let apart = pair.contact + self.per_chart + a.price(lambda) + b.price(lambda);
        let Stage::Predicted { ways, n_left, best } = &mut pair.stage else {
            return;
        };
        let bar = best.as_ref().map_or(apart, |net| net.price(lambda));
        let faces = union(&a.faces, &b.faces);
        let way = match n_left {
            0 => None,
            _ => ways.cheapest(self.nets.metric, &faces, lambda, bar),
        };
        let price = way.map(|way| way.price(lambda));
        self.counts.predicted_faces += ways.predicted_faces();
        let price = price.unwrap_or_else(|| {
            *ways = Ways::new(self.nets.metric, []);
            bar
        });
        if price < apart {
            pair.gain = apart - price;
            heap.push(pair);
        }
    }

    /// Replaces two nets by their union, if that keeps the bound, and adds its pairs.
    fn unite(&mut self, [a, b]: [u32; 2], net: Net, lambda: f64, heap: &mut BinaryHeap<Pair>) {
        let parts = self.nets.list[&a].excess + self.nets.list[&b].excess;
        if self.nets.excess() - parts + net.excess > self.budget {
            self.counts.refused += 1;
            return;
        }
        self.counts.glued += 1;
        self.nets.list.remove(&a);
        self.nets.list.remove(&b);
        let union = self.nets.add(net);
        for other in self.nets.neighbors(union) {
            heap.push(self.pair(union, other, lambda));
        }
    }

    /// Creates a pair of neighbors. Its gain is an upper bound: a union has neither slits nor distortion at best.
    fn pair(&self, a: u32, b: u32, lambda: f64) -> Pair {
        let nets = [a.min(b), a.max(b)];
        let contact = self.nets.metric.length_of(&self.nets.contact(a, b));
        let [first, second] = nets.map(|net| self.nets.list[&net].price(lambda));
        Pair {
            gain: contact + self.per_chart + first + second,
            nets,
            contact,
            stage: Stage::Met,
        }
    }

    /// Returns the slits of a union to start from: none, those of both parts, and those with all of the contact but one stretch
    /// of it, a hinge.
    fn starts(&self, pair: &Pair) -> Vec<Vec<u32>> {
        let metric = self.nets.metric;
        let [a, b] = pair.nets.map(|net| &self.nets.list[&net]);
        let faces = union(&a.faces, &b.faces);
        let contact = self.nets.contact(pair.nets[0], pair.nets[1]);
        let carried = union(&a.slits, &b.slits);
        let mesh = CutMesh::new(metric, &faces, &carried);
        let defect = |v: usize| (2.0 * std::f64::consts::PI - mesh.angle[v]).abs();
        let sharp: BTreeSet<u32> = (0..mesh.welded.len())
            .filter(|&v| mesh.is_inner[v] && defect(v) > SHARP)
            .map(|v| mesh.welded[v])
            .collect();
        let mut stretches = chains(metric, &contact, |v| sharp.contains(&v));
        let mut starts = vec![Vec::new(), carried.clone()];
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

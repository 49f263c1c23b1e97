//! Facets merged to charts.

use super::cone::{Cone, Normals};
use std::cmp::{Ordering, Reverse};
use std::collections::{BTreeMap, BinaryHeap};
use unwrapd_maps::mesh::UnionFind;

/// Regions of a surface that are merged pair by pair.
pub struct Regions {
    sets: UnionFind,
    normals: Vec<Normals>,
    /// For each representative its neighbors, with the length of the common border and the ticket of the queued merge.
    borders: Vec<BTreeMap<u32, SharedBorder>>,
}

#[derive(Clone, Copy, Debug)]
struct SharedBorder {
    length: f64,
    ticket: u32,
}

/// Which merges are allowed.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// What the union must fit into.
    pub cone: Cone,
    /// One of the two must be at most this large.
    pub smaller_area: f64,
}

/// A possible merge, the cheapest first.
struct Candidate {
    cost: f64,
    pair: (u32, u32),
    ticket: u32,
}

impl Regions {
    /// One region per label, with the borders `(label, label, length)` between them.
    pub fn new(normals: Vec<Normals>, borders: impl IntoIterator<Item = (u32, u32, f64)>) -> Self {
        let mut maps = vec![BTreeMap::new(); normals.len()];
        for (a, b, length) in borders {
            for (from, to) in [(a, b), (b, a)] {
                let none = SharedBorder {
                    length: 0.0,
                    ticket: 0,
                };
                maps[from as usize].entry(to).or_insert(none).length += length;
            }
        }
        Self {
            sets: UnionFind::new(normals.len()),
            normals,
            borders: maps,
        }
    }

    /// Merges neighbors as long as the limits allow, where the least spread of normals is paid for the most border.
    ///
    /// Costs only rise in general, so a queued cost is a lower bound: it is computed anew when it comes up, and queued again
    /// if it has risen.
    pub fn merge(&mut self, limits: &Limits) {
        let mut queue = BinaryHeap::new();
        let mut tickets = 0;
        for a in 0..self.normals.len() as u32 {
            let later: Vec<u32> = self.borders[a as usize]
                .range(a + 1..)
                .map(|b| *b.0)
                .collect();
            for b in later {
                self.enqueue(limits, &mut queue, &mut tickets, a, b);
            }
        }
        while let Some(Reverse(candidate)) = queue.pop() {
            let (a, b) = candidate.pair;
            let (a, b) = (self.sets.find(a), self.sets.find(b));
            let queued = self.borders[a as usize].get(&b);
            if queued.is_none_or(|border| border.ticket != candidate.ticket) {
                continue;
            }
            match self.cost(limits, a, b) {
                Some(cost) if cost > candidate.cost * (1.0 + 1e-9) + 1e-300 => {
                    self.enqueue(limits, &mut queue, &mut tickets, a, b);
                }
                Some(_) => {
                    for c in self.unite(a, b) {
                        let merged = self.sets.find(a);
                        self.enqueue(limits, &mut queue, &mut tickets, merged, c);
                    }
                }
                None => {}
            }
        }
    }

    /// For each label given to [`new`](Self::new) its region.
    pub fn labels(&mut self) -> Vec<u32> {
        self.sets.labels().0
    }

    fn enqueue(
        &mut self,
        limits: &Limits,
        queue: &mut BinaryHeap<Reverse<Candidate>>,
        tickets: &mut u32,
        a: u32,
        b: u32,
    ) {
        let Some(cost) = self.cost(limits, a, b) else {
            return;
        };
        *tickets += 1;
        for (from, to) in [(a, b), (b, a)] {
            if let Some(border) = self.borders[from as usize].get_mut(&to) {
                border.ticket = *tickets;
            }
        }
        queue.push(Reverse(Candidate {
            cost,
            pair: (a, b),
            ticket: *tickets,
        }));
    }

    /// The rise in spread per length of border saved; none if the limits forbid the merge.
    fn cost(&self, limits: &Limits, a: u32, b: u32) -> Option<f64> {
        let (a_normals, b_normals) = (&self.normals[a as usize], &self.normals[b as usize]);
        let smaller = a_normals.area.min(b_normals.area);
        if smaller > limits.smaller_area || !a_normals.fit(b_normals, limits.cone) {
            return None;
        }
        let mut sum = a_normals.sum;
        for (s, x) in sum.iter_mut().zip(b_normals.sum) {
            *s += x;
        }
        let merged = a_normals.area + b_normals.area - unwrapd_method::numerics::vec3::norm(sum);
        let rise = (merged - a_normals.spread() - b_normals.spread()).max(0.0);
        let border = self.borders[a as usize].get(&b)?;
        Some(rise / border.length.max(f64::MIN_POSITIVE))
    }

    /// Unites two regions; returns the neighbors both had.
    fn unite(&mut self, a: u32, b: u32) -> Vec<u32> {
        self.sets.unite(a, b);
        let (kept, gone) = (a.min(b), a.max(b));
        let normals = std::mem::take(&mut self.normals[gone as usize]);
        self.normals[kept as usize].merge(&normals);
        let mut from = std::mem::take(&mut self.borders[gone as usize]);
        let mut into = std::mem::take(&mut self.borders[kept as usize]);
        from.remove(&kept);
        into.remove(&gone);
        if from.len() > into.len() {
            std::mem::swap(&mut from, &mut into);
        }
        let mut common = Vec::new();
        for (c, border) in from {
            match into.get_mut(&c) {
                Some(both) => {
                    both.length += border.length;
                    common.push(c);
                }
                None => {
                    into.insert(c, border);
                }
            }
        }
        for (&c, &border) in &into {
            let map = &mut self.borders[c as usize];
            map.remove(&gone);
            map.insert(kept, border);
        }
        self.borders[kept as usize] = into;
        common
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let key = |c: &Self| (c.pair, c.ticket);
        self.cost
            .total_cmp(&other.cost)
            .then_with(|| key(self).cmp(&key(other)))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

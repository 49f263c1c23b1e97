//! Sets of edges and faces, as ascending lists.

use super::metric::Metric;
use std::collections::BTreeMap;
use unwrapd_maps::mesh::UnionFind;

/// Groups edges, given in ascending order, that hang together at vertices other than `is_break`; returns the groups by
/// their first edge, each in ascending order.
pub fn chains(metric: &Metric, edges: &[u32], is_break: impl Fn(u32) -> bool) -> Vec<Vec<u32>> {
    let mut sets = UnionFind::new(edges.len());
    let mut at: BTreeMap<u32, u32> = BTreeMap::new();
    for (place, &edge) in (0..).zip(edges) {
        for v in metric
            .ends_of_edge(edge)
            .into_iter()
            .filter(|&v| !is_break(v))
        {
            let first = *at.entry(v).or_insert(place);
            sets.unite(first, place);
        }
    }
    let (label, n) = sets.labels();
    let mut groups = vec![Vec::new(); n];
    for (&edge, &label) in edges.iter().zip(&label) {
        groups[label as usize].push(edge);
    }
    groups
}

/// Divides edges, given in ascending order, into chains between the vertices at which more than two of them meet.
pub fn unbranched(metric: &Metric, edges: &[u32]) -> Vec<Vec<u32>> {
    let breaks = branching(metric, edges);
    chains(metric, edges, |v| breaks.binary_search(&v).is_ok())
}

/// Returns the vertices at which more than two of some edges meet.
fn branching(metric: &Metric, edges: &[u32]) -> Vec<u32> {
    let mut ends: Vec<u32> = (edges.iter())
        .flat_map(|&edge| metric.ends_of_edge(edge))
        .collect();
    ends.sort_unstable();
    let meets = ends.chunk_by(|a, b| a == b).filter(|of| of.len() > 2);
    meets.map(|of| of[0]).collect()
}

/// Returns the two halves of a chain by the number of edges, each in ascending order; `None` for a loop or a single edge.
pub fn halves(metric: &Metric, chain: &[u32]) -> Option<[Vec<u32>; 2]> {
    let mut at: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for &edge in chain {
        for v in metric.ends_of_edge(edge) {
            at.entry(v).or_default().push(edge);
        }
    }
    let mut vertex = *at.iter().find(|(_, edges)| edges.len() == 1)?.0;
    let mut order: Vec<u32> = Vec::with_capacity(chain.len());
    while let Some(&edge) = at[&vertex].iter().find(|edge| order.last() != Some(edge)) {
        order.push(edge);
        let [a, b] = metric.ends_of_edge(edge);
        vertex = if a == vertex { b } else { a };
        if order.len() == chain.len() {
            break;
        }
    }
    if order.len() < 2 {
        return None;
    }
    let (first, last) = order.split_at(order.len() / 2);
    Some([first, last].map(|half| {
        let mut half = half.to_vec();
        half.sort_unstable();
        half
    }))
}

/// Returns the members of both lists.
pub fn union(a: &[u32], b: &[u32]) -> Vec<u32> {
    let mut all = [a, b].concat();
    all.sort_unstable();
    all.dedup();
    all
}

/// Returns the members of the first list that are not in the second.
pub fn difference(a: &[u32], b: &[u32]) -> Vec<u32> {
    let is_left = |x: &&u32| b.binary_search(x).is_err();
    a.iter().filter(is_left).copied().collect()
}

//! Slices of a body between one of its handles and the nearest other one.

use std::collections::HashMap;

use super::body::Body;
use super::problem::Problem;

/// Vertices whose path between the two handles is longer than the shortest by this factor belong to limbs beside it.
const DETOUR: f64 = 1.5;

/// Difference below which places along the path, as shares of it, count as equal: the layers of a grid are not divided.
const SAME: f64 = 1e-9;

/// Slices of a body between two of its handles, in order.
pub(super) struct Slices {
    /// Vertices of each slice; the first and the last are those of the handles.
    pub slices: Vec<Vec<u32>>,
    /// Vertex of the other handle that is nearest to the first.
    pub end: u32,
}

impl Problem {
    /// Cuts the body from these held vertices to the nearest ones held by another handle into slices as thin as `least`
    /// vertices per slice allow, by distances along edges at rest from both ends. Returns `None` if no others are held,
    /// or no edges lead to them.
    pub(super) fn slices(&self, first: &[u32], least: usize) -> Option<Slices> {
        let handles = self.stations.last()?;
        let grouped = handles.vertices.iter().zip(&handles.groups);
        let mut group_of: HashMap<u32, u32> = grouped.map(|(&v, &group)| (v, group)).collect();
        for v in first {
            group_of.remove(v);
        }
        let from_first = self.body.distances(first);
        let away = |v: u32| from_first[v as usize];
        let nearest = |a: &u32, b: &u32| away(*a).total_cmp(&away(*b)).then(a.cmp(b));
        let end = group_of.keys().copied().min_by(nearest)?;
        if !away(end).is_finite() {
            return None;
        }
        let is_with_end = |v: &&u32| group_of.get(v) == group_of.get(&end);
        let last: Vec<u32> = handles
            .vertices
            .iter()
            .filter(is_with_end)
            .copied()
            .collect();
        let from_last = self.body.distances(&last);
        let mut between = Vec::new();
        for (v, (a, b)) in (0..).zip(from_first.iter().zip(&from_last)) {
            if *a > 0.0 && *b > 0.0 && a + b <= DETOUR * away(end) {
                between.push((a / (a + b), v));
            }
        }
        between.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
        let mut slices = vec![first.to_vec()];
        slices.extend(sliced(&between, least));
        slices.push(last);
        Some(Slices { slices, end })
    }
}

/// Splits vertices in the order of their places into slices of at least `least` vertices, keeping equal places
/// together; the remainder joins the last slice.
fn sliced(places: &[(f64, u32)], least: usize) -> Vec<Vec<u32>> {
    let (mut slices, mut slice) = (Vec::<Vec<u32>>::new(), Vec::new());
    let mut last = f64::NEG_INFINITY;
    for &(place, v) in places {
        if slice.len() >= least && place > last + SAME {
            slices.push(std::mem::take(&mut slice));
        }
        slice.push(v);
        last = place;
    }
    match slices.last_mut() {
        Some(last) if slice.len() < least => last.extend(slice),
        _ => slices.push(slice),
    }
    slices
}

impl Body {
    /// Returns the distance of every vertex from these along edges at rest; infinite if there is no path. Sweeps over
    /// the elements until nothing changes.
    fn distances(&self, from: &[u32]) -> Vec<f64> {
        let dim = self.dim();
        let length = |a: u32, b: u32| {
            let [a, b] = [a, b].map(|v| &self.rest[dim * v as usize..dim * (v as usize + 1)]);
            a.iter()
                .zip(b)
                .map(|(a, b)| (a - b) * (a - b))
                .sum::<f64>()
                .sqrt()
        };
        let mut distance = vec![f64::INFINITY; self.n_vertices()];
        for &v in from {
            distance[v as usize] = 0.0;
        }
        let corners = self.corners();
        let mut has_changed = true;
        while std::mem::take(&mut has_changed) {
            for element in &corners {
                for &a in *element {
                    for &b in *element {
                        let by_a = distance[a as usize] + length(a, b);
                        if by_a < distance[b as usize] {
                            distance[b as usize] = by_a;
                            has_changed = true;
                        }
                    }
                }
            }
        }
        distance
    }
}

//! Shortest paths along edges.

use super::Sheet;
use crate::mesh::{CUT, next};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Distances along edges from a set of vertices, and the paths back.
pub struct Distances {
    /// Distance of each vertex; infinite if there is no path.
    pub distance: Vec<f64>,
    /// For each vertex the halfedge by which the shortest path arrives, [`CUT`] at the sources.
    pub arrival: Vec<u32>,
}

/// Halfedges that touch each vertex, for walks from vertex to vertex.
pub struct Neighbors {
    starts: Vec<u32>,
    halfedges: Vec<u32>,
}

impl Neighbors {
    /// Collects both ends of every edge of a sheet.
    pub fn new(sheet: &Sheet) -> Self {
        let mut starts = vec![0u32; sheet.positions.len() + 1];
        for h in sheet.edges() {
            for v in sheet.ends(h) {
                starts[v as usize + 1] += 1;
            }
        }
        for v in 1..starts.len() {
            starts[v] += starts[v - 1];
        }
        let mut cursor = starts.clone();
        let mut halfedges = vec![0; starts[starts.len() - 1] as usize];
        for h in sheet.edges() {
            for v in sheet.ends(h) {
                halfedges[cursor[v as usize] as usize] = h;
                cursor[v as usize] += 1;
            }
        }
        Self { starts, halfedges }
    }

    /// Returns one halfedge of each edge at a vertex.
    pub fn of(&self, vertex: u32) -> &[u32] {
        let range = self.starts[vertex as usize]..self.starts[vertex as usize + 1];
        &self.halfedges[range.start as usize..range.end as usize]
    }
}

/// Runs Dijkstra's algorithm from all sources at once; `length` of an edge must not be negative. Ties go to the lower
/// vertex.
pub fn distances(
    sheet: &Sheet,
    neighbors: &Neighbors,
    sources: impl IntoIterator<Item = u32>,
    length: impl Fn(u32) -> f64,
) -> Distances {
    distances_until(sheet, neighbors, sources, length, |_| false).0
}

/// Computes distances until the nearest vertex with `is_goal` is reached; returns them and that vertex, if any.
pub fn distances_until(
    sheet: &Sheet,
    neighbors: &Neighbors,
    sources: impl IntoIterator<Item = u32>,
    length: impl Fn(u32) -> f64,
    is_goal: impl Fn(u32) -> bool,
) -> (Distances, Option<u32>) {
    let n = sheet.positions.len();
    let mut distance = vec![f64::INFINITY; n];
    let mut arrival = vec![CUT; n];
    let mut queue = BinaryHeap::new();
    // Start from all sources at once.
    for vertex in sources {
        distance[vertex as usize] = 0.0;
        queue.push(QueueEntry { key: 0.0, vertex });
    }
    while let Some(QueueEntry { key, vertex }) = queue.pop() {
        // Skip an entry that a shorter path has replaced.
        if key > distance[vertex as usize] {
            continue;
        }
        if is_goal(vertex) {
            return (Distances { distance, arrival }, Some(vertex));
        }
        for &h in neighbors.of(vertex) {
            let far = opposite_end(sheet, h, vertex);
            let key = key + length(h);
            if key < distance[far as usize] {
                distance[far as usize] = key;
                arrival[far as usize] = h;
                queue.push(QueueEntry { key, vertex: far });
            }
        }
    }
    (Distances { distance, arrival }, None)
}

impl Distances {
    /// Iterates over the edges of the shortest path from a vertex back to the nearest source.
    pub fn path<'a>(&'a self, sheet: &'a Sheet, from: u32) -> impl Iterator<Item = u32> + 'a {
        let mut vertex = from;
        std::iter::from_fn(move || {
            let h = self.arrival[vertex as usize];
            if h == CUT {
                return None;
            }
            vertex = opposite_end(sheet, h, vertex);
            Some(h)
        })
    }

    /// Returns the reachable vertex farthest from the sources, the first of equals, and its distance.
    pub fn farthest(&self) -> (u32, f64) {
        let mut best = (0, 0.0);
        for (v, &d) in (0u32..).zip(&self.distance) {
            if d.is_finite() && d > best.1 {
                best = (v, d);
            }
        }
        best
    }
}

/// Returns the end of an edge that is not `vertex`.
pub fn opposite_end(sheet: &Sheet, h: u32, vertex: u32) -> u32 {
    let start = sheet.vertex[h as usize];
    if start == vertex {
        sheet.vertex[next(h) as usize]
    } else {
        start
    }
}

/// A vertex in the queue, ordered by distance, then by index.
struct QueueEntry {
    key: f64,
    vertex: u32,
}

impl Ord for QueueEntry {
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .key
            .total_cmp(&self.key)
            .then(other.vertex.cmp(&self.vertex))
    }
}

impl PartialOrd for QueueEntry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for QueueEntry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for QueueEntry {}

//! The cheapest seam between two sets of faces.

use crate::mesh::CUT;
use std::collections::VecDeque;

/// Which faces stay with the sources when a minimum cut parts them from the sinks.
///
/// The graph is dual to a surface: `twin[h]` is the halfedge across the edge of halfedge `h` of face `h / 3`, or [`CUT`], and
/// `capacity[h]`, equal on both sides, what cutting it costs. No face may be both source and sink. Of all minimum cuts the one
/// nearest to the sources. Every part on either side contains a source or a sink.
///
/// From: Dinic 1970. Flow goes along shortest ways until none is left; capacities are integers, so it ends, exactly.
pub fn min_cut(twin: &[u32], capacity: &[u64], sources: &[u32], sinks: &[u32]) -> Vec<bool> {
    let mut is_sink = vec![false; twin.len() / 3];
    for &face in sinks {
        is_sink[face as usize] = true;
    }
    let mut flow = Flow {
        twin,
        left: capacity.to_vec(),
        is_sink,
    };
    loop {
        let (level, arrived) = flow.levels(sources);
        if !arrived {
            return level.iter().map(|&l| l != UNREACHED).collect();
        }
        flow.fill(sources, &level);
    }
}

/// The level of a face that no flow can reach any more.
const UNREACHED: u32 = u32::MAX;

struct Flow<'a> {
    twin: &'a [u32],
    /// For each halfedge how much more may flow over it out of its face.
    left: Vec<u64>,
    is_sink: Vec<bool>,
}

impl Flow<'_> {
    /// For each face the number of edges from the sources over which more may flow; and whether a sink can be reached.
    fn levels(&self, sources: &[u32]) -> (Vec<u32>, bool) {
        let mut level = vec![UNREACHED; self.is_sink.len()];
        let mut queue = VecDeque::new();
        for &face in sources {
            level[face as usize] = 0;
            queue.push_back(face);
        }
        let mut arrived = false;
        while let Some(face) = queue.pop_front() {
            if self.is_sink[face as usize] {
                arrived = true;
                continue;
            }
            for h in 3 * face..3 * face + 3 {
                let t = self.twin[h as usize];
                if t != CUT && self.left[h as usize] > 0 && level[t as usize / 3] == UNREACHED {
                    level[t as usize / 3] = level[face as usize] + 1;
                    queue.push_back(t / 3);
                }
            }
        }
        (level, arrived)
    }

    /// Sends flow along ways that rise by one level per edge until every one of them is full.
    fn fill(&mut self, sources: &[u32], level: &[u32]) {
        let mut turn = vec![0_u8; level.len()];
        let mut way: Vec<u32> = Vec::new();
        for &source in sources {
            let mut face = source;
            loop {
                if self.is_sink[face as usize] {
                    let kept = self.send(&way);
                    face = way[kept] / 3;
                    way.truncate(kept);
                } else if turn[face as usize] < 3 {
                    let h = 3 * face + u32::from(turn[face as usize]);
                    let t = self.twin[h as usize];
                    let rises = t != CUT
                        && self.left[h as usize] > 0
                        && level[t as usize / 3] == level[face as usize] + 1;
                    if rises {
                        way.push(h);
                        face = t / 3;
                    } else {
                        turn[face as usize] += 1;
                    }
                } else if let Some(h) = way.pop() {
                    face = h / 3;
                    turn[face as usize] += 1;
                } else {
                    break;
                }
            }
        }
    }

    /// Fills a way to a sink; returns how many of its edges come before the first full one.
    fn send(&mut self, way: &[u32]) -> usize {
        let amount = way.iter().map(|&h| self.left[h as usize]).min();
        for &h in way {
            self.left[h as usize] -= amount.unwrap_or(0);
            self.left[self.twin[h as usize] as usize] += amount.unwrap_or(0);
        }
        let full = way.iter().position(|&h| self.left[h as usize] == 0);
        full.unwrap_or(0)
    }
}

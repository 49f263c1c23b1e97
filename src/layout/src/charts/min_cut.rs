//! The cheapest seam between two sets of faces.

use std::collections::VecDeque;
use unwrapd_maps::mesh::CUT;
use unwrapd_method::solver::Control;

/// Ways filled between two questions whether to go on. On small charts nobody is asked; the ways across a
/// hundred thousand faces take about a millisecond each.
const WAYS_PER_QUESTION: u32 = 256;

/// Which faces stay with the sources when a minimum cut parts them from the sinks.
///
/// The graph is dual to a surface: `twin[h]` is the halfedge across the edge of halfedge `h` of face `h / 3`, or [`CUT`], and
/// `capacity[h]`, equal on both sides, what cutting it costs. No face may be both source and sink. Of all minimum cuts the one
/// nearest to the sources. Every part on either side contains a source or a sink.
///
/// From: Boykov and Kolmogorov 2004. Trees grow from the sources and from the sinks, flow goes along a way where they meet, and
/// what it leaves without a root is adopted by a neighbor of the same tree; capacities are integers, so it ends, exactly. On a
/// mesh, where ways are long, this reads far less than looking for all shortest ways anew.
///
/// `control` is asked now and then. After [`Control::Finish`] the faces of neither tree join the nearest: the
/// seam between the trees parts the sources from the sinks as well, but is not the cheapest.
pub fn min_cut(
    twin: &[u32],
    capacity: &[u64],
    sources: &[u32],
    sinks: &[u32],
    control: &dyn Fn() -> Control,
) -> Vec<bool> {
    let mut flow = Flow::new(twin, capacity);
    let mut ways = 0_u32;
    for (faces, tree) in [(sources, Tree::Sources), (sinks, Tree::Sinks)] {
        for &face in faces {
            flow.plant(face, tree, ROOT);
        }
    }
    while let Some(&face) = flow.growing.front() {
        match flow.grow(face) {
            Some(meeting) => {
                flow.send(meeting);
                flow.adopt();
                ways += 1;
                if ways.is_multiple_of(WAYS_PER_QUESTION) && control() == Control::Finish {
                    flow.divide_rest();
                    break;
                }
            }
            None => {
                flow.growing.pop_front();
            }
        }
    }
    flow.tree.iter().map(|&t| t == Tree::Sources).collect()
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tree {
    None,
    Sources,
    Sinks,
}

/// The way to the parent of a source or sink.
const ROOT: u32 = u32::MAX;
/// The way to the parent of a face that has none.
const ORPHAN: u32 = u32::MAX - 1;

struct Flow<'a> {
    twin: &'a [u32],
    /// For each halfedge how much more may flow over it out of its face.
    left: Vec<u64>,
    tree: Vec<Tree>,
    /// For each face of a tree its halfedge toward its parent, [`ROOT`] or [`ORPHAN`].
    parent: Vec<u32>,
    /// Edges to the root, as of the round of adoption `known`.
    depth: Vec<u32>,
    known: Vec<u32>,
    round: u32,
    /// Faces whose neighbors may still join their tree.
    growing: VecDeque<u32>,
    orphans: Vec<u32>,
}

impl<'a> Flow<'a> {
    fn new(twin: &'a [u32], capacity: &[u64]) -> Self {
        let n = twin.len() / 3;
        Self {
            twin,
            left: capacity.to_vec(),
            tree: vec![Tree::None; n],
            parent: vec![ORPHAN; n],
            depth: vec![0; n],
            known: vec![0; n],
            round: 0,
            growing: VecDeque::new(),
            orphans: Vec::new(),
        }
    }

    fn plant(&mut self, face: u32, tree: Tree, parent: u32) {
        self.tree[face as usize] = tree;
        self.parent[face as usize] = parent;
        self.growing.push_back(face);
    }

    /// The halfedges of a face with those across them.
    fn across(&self, face: u32) -> impl Iterator<Item = (u32, u32)> + use<'a> {
        let twin = self.twin;
        (3 * face..3 * face + 3)
            .map(move |h| (h, twin[h as usize]))
            .filter(|&(_, t)| t != CUT)
    }

    /// Whether flow may go on from the face of `h` over `h` away from a source, or come back over it from a sink.
    fn may_flow(&self, tree: Tree, h: u32) -> bool {
        let along = match tree {
            Tree::Sources => h,
            Tree::None | Tree::Sinks => self.twin[h as usize],
        };
        self.left[along as usize] > 0
    }

    /// Adds the free neighbors of a face to its tree; where it touches the other tree, the halfedge from there on.
    fn grow(&mut self, face: u32) -> Option<u32> {
        let tree = self.tree[face as usize];
        if tree == Tree::None {
            return None;
        }
        for (h, t) in self.across(face) {
            if !self.may_flow(tree, h) {
                continue;
            }
            match self.tree[t as usize / 3] {
                Tree::None => self.plant(t / 3, tree, t),
                other if other == tree => {}
                _ => return Some(if tree == Tree::Sources { h } else { t }),
            }
        }
        None
    }

    /// Gives every free face to the tree that reaches it first.
    fn divide_rest(&mut self) {
        self.growing = (0..self.tree.len() as u32)
            .filter(|&face| self.tree[face as usize] != Tree::None)
            .collect();
        while let Some(face) = self.growing.pop_front() {
            for (_, t) in self.across(face) {
                if self.tree[t as usize / 3] == Tree::None {
                    self.plant(t / 3, self.tree[face as usize], t);
                }
            }
        }
    }

    /// Fills the way from a source to a sink that crosses from tree to tree over `meeting`.
    fn send(&mut self, meeting: u32) {
        let mut way = vec![meeting];
        for (end, tree) in [
            (meeting, Tree::Sources),
            (self.twin[meeting as usize], Tree::Sinks),
        ] {
            let mut h = self.parent[end as usize / 3];
            while h != ROOT {
                let t = self.twin[h as usize];
                way.push(if tree == Tree::Sources { t } else { h });
                h = self.parent[t as usize / 3];
            }
        }
        let amount = way.iter().map(|&h| self.left[h as usize]).min();
        let amount = amount.unwrap_or(0);
        for h in way {
            let t = self.twin[h as usize];
            self.left[h as usize] -= amount;
            self.left[t as usize] += amount;
            if self.left[h as usize] == 0 && h != meeting {
                let child = match self.tree[h as usize / 3] {
                    Tree::Sources => t / 3,
                    Tree::None | Tree::Sinks => h / 3,
                };
                self.parent[child as usize] = ORPHAN;
                self.orphans.push(child);
            }
        }
    }

    /// Finds the orphans new parents; what has none is free again.
    fn adopt(&mut self) {
        self.round += 1;
        while let Some(face) = self.orphans.pop() {
            let tree = self.tree[face as usize];
            let mut nearest = (u32::MAX, ORPHAN);
            for (h, t) in self.across(face) {
                if self.tree[t as usize / 3] == tree && self.may_flow(tree, t) {
                    let depth = self.depth_of(t / 3).unwrap_or(u32::MAX);
                    nearest = nearest.min((depth, h));
                }
            }
            if nearest.0 < u32::MAX {
                self.parent[face as usize] = nearest.1;
                self.depth[face as usize] = nearest.0 + 1;
                self.known[face as usize] = self.round;
                continue;
            }
            for (_, t) in self.across(face) {
                let neighbor = t as usize / 3;
                if self.tree[neighbor] != tree {
                    continue;
                }
                if self.may_flow(tree, t) {
                    self.growing.push_back(t / 3);
                }
                if self.parent[neighbor] == t {
                    self.parent[neighbor] = ORPHAN;
                    self.orphans.push(t / 3);
                }
            }
            self.tree[face as usize] = Tree::None;
        }
    }

    /// Edges from a face to the root of its tree; `None` below an orphan.
    fn depth_of(&mut self, face: u32) -> Option<u32> {
        let mut way = Vec::new();
        let mut at = face as usize;
        let mut depth = loop {
            if self.known[at] == self.round {
                break self.depth[at];
            }
            match self.parent[at] {
                ORPHAN => return None,
                ROOT => break 0,
                h => {
                    way.push(at);
                    at = self.twin[h as usize] as usize / 3;
                }
            }
        };
        for at in way.into_iter().rev() {
            depth += 1;
            self.depth[at] = depth;
            self.known[at] = self.round;
        }
        Some(depth)
    }
}

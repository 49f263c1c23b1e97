//! A triangulated disk that can be coarsened.

/// Opposite of a halfedge at the boundary.
const NONE: u32 = u32::MAX;

/// Triangles glued along opposite halfedges; halfedge `3t + k` goes from corner k of triangle t to corner k + 1.
///
/// Invariant: a connected disk with one boundary loop and at least one triangle. Vertices keep their numbers; a
/// collapsed vertex has no triangles.
pub(super) struct Triangulation {
    corners: Vec<u32>,
    opposite: Vec<u32>,
    /// For each vertex a halfedge that leaves it, at the boundary the one without an opposite; NONE once collapsed.
    leaving: Vec<u32>,
    alive: Vec<bool>,
    /// For each vertex whether it is at the boundary. Such a vertex moves only along the boundary, and inner vertices
    /// never get there.
    at_boundary: Vec<bool>,
    n_triangles: usize,
    /// Workspace for the link condition: the last stamp of each vertex.
    stamps: Vec<u32>,
    stamp: u32,
}

/// The neighbors of a vertex, counter-clockwise.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Ring {
    pub vertices: Vec<u32>,
    /// Halfedges from the vertex that start its triangles, in the same order.
    pub halfedges: Vec<u32>,
    /// `true` if the ring goes all around, `false` if it goes from boundary edge to boundary edge.
    pub closed: bool,
}

impl Ring {
    /// Iterates over neighbors that follow each other: together with the vertex they form its triangles.
    pub fn pairs(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        pairs(&self.vertices, self.closed)
    }
}

/// Iterates over successive vertices of a ring.
pub(super) fn pairs(ring: &[u32], closed: bool) -> impl Iterator<Item = [u32; 2]> + '_ {
    let n = ring.len();
    (0..n - usize::from(!closed)).map(move |i| [ring[i], ring[(i + 1) % n]])
}

impl Triangulation {
    /// Creates the triangulation from triangles that form a disk with one boundary loop.
    pub fn new(n_vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let corners: Vec<u32> = triangles.iter().flatten().copied().collect();
        let mut triangulation = Self {
            opposite: vec![NONE; corners.len()],
            leaving: vec![NONE; n_vertices],
            alive: vec![true; triangles.len()],
            at_boundary: vec![false; n_vertices],
            n_triangles: triangles.len(),
            stamps: vec![0; n_vertices],
            stamp: 0,
            corners,
        };
        // Glue the edges that two triangles share.
        let mut edges: Vec<(u32, u32, u32)> = (0..triangulation.corners.len() as u32)
            .map(|h| {
                let (a, b) = (triangulation.origin(h), triangulation.origin(next(h)));
                (a.min(b), a.max(b), h)
            })
            .collect();
        edges.sort_unstable();
        for pair in edges.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
            if let [(.., g), (.., h)] = *pair {
                triangulation.glue(g, h);
            }
        }
        // Choose a halfedge that leaves each vertex; at the boundary the one without an opposite.
        for h in 0..triangulation.corners.len() as u32 {
            let v = triangulation.origin(h) as usize;
            if triangulation.leaving[v] == NONE || triangulation.opposite[h as usize] == NONE {
                triangulation.leaving[v] = h;
            }
            triangulation.at_boundary[v] |= triangulation.opposite[h as usize] == NONE;
        }
        triangulation
    }

    /// Returns the remaining vertices, in increasing order.
    pub fn vertices(&self) -> Vec<u32> {
        let left = self.leaving.iter().enumerate();
        left.filter(|(_, h)| **h != NONE)
            .map(|(v, _)| v as u32)
            .collect()
    }

    /// Iterates over the remaining triangles, with their numbers in the original list.
    pub fn triangles(&self) -> impl Iterator<Item = (usize, [u32; 3])> + '_ {
        let all = self.corners.chunks_exact(3).enumerate();
        all.filter(|(t, _)| self.alive[*t])
            .map(|(t, c)| (t, [c[0], c[1], c[2]]))
    }

    fn origin(&self, halfedge: u32) -> u32 {
        self.corners[halfedge as usize]
    }

    /// Makes two halfedges opposite; a halfedge glued to NONE is at the boundary.
    fn glue(&mut self, g: u32, h: u32) {
        if g != NONE {
            self.opposite[g as usize] = h;
        }
        if h != NONE {
            self.opposite[h as usize] = g;
        }
    }

    /// Collects the neighbors of `v`, starting at the boundary if it has one.
    pub fn ring(&self, v: u32, ring: &mut Ring) {
        ring.vertices.clear();
        ring.halfedges.clear();
        for h in self.halfedges_around(v) {
            ring.vertices.push(self.origin(next(h)));
            ring.halfedges.push(h);
        }
        let incoming = next(next(ring.halfedges[ring.halfedges.len() - 1]));
        ring.closed = self.opposite[incoming as usize] != NONE;
        if !ring.closed {
            ring.vertices.push(self.origin(incoming));
        }
    }

    /// Returns whether the vertex with this ring may be moved onto its neighbor number `at`. The result must be a disk
    /// again: the two have no common neighbors except those of the triangles at their edge, a boundary vertex moves
    /// along the boundary, and a triangle remains.
    pub fn can_collapse(&mut self, ring: &Ring, at: usize) -> bool {
        let last = ring.vertices.len() - 1;
        if !ring.closed && (at != 0 && at != last || self.n_triangles == 1) {
            return false;
        }
        self.stamp += 1;
        for (i, &neighbor) in ring.vertices.iter().enumerate() {
            let apart = i.abs_diff(at);
            if apart > 1 && !(ring.closed && apart == last) {
                self.stamps[neighbor as usize] = self.stamp;
            }
        }
        !self.has_stamped_neighbor(ring.vertices[at])
    }

    /// Returns whether more than `n` triangles are at `v`, without counting further.
    pub fn has_more_triangles(&self, v: u32, n: usize) -> bool {
        self.halfedges_around(v).nth(n).is_some()
    }

    /// Iterates over the halfedges that leave `v`, counter-clockwise.
    fn halfedges_around(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.leaving[v as usize];
        std::iter::successors(Some(first), move |&h| {
            let across = self.opposite[next(next(h)) as usize];
            (across != NONE && across != first).then_some(across)
        })
    }

    fn has_stamped_neighbor(&self, v: u32) -> bool {
        let stamped = |h| self.stamps[self.origin(h) as usize] == self.stamp;
        self.halfedges_around(v)
            .any(|h| stamped(next(h)) || stamped(next(next(h))))
    }

    /// Moves `v`, whose ring is given, onto its neighbor number `at`, where [`can_collapse`](Self::can_collapse)
    /// allows.
    ///
    /// The triangles on both sides of their edge are removed; the two other sides of each become one edge.
    pub fn collapse(&mut self, v: u32, ring: &Ring, at: usize) {
        for &h in &ring.halfedges {
            self.corners[h as usize] = ring.vertices[at];
        }
        let n = ring.halfedges.len();
        let before = if ring.closed {
            Some((at + n - 1) % n)
        } else {
            at.checked_sub(1)
        };
        if let Some(h) = before.map(|i| ring.halfedges[i]) {
            self.remove(h, next(h));
        }
        if let Some(&h) = ring.halfedges.get(at) {
            self.remove(next(h), next(next(h)));
        }
        self.leaving[v as usize] = NONE;
        let last = ring.vertices.len() - 1;
        for i in [(at + last) % (last + 1), at, (at + 1) % (last + 1)] {
            self.turn_to_boundary(ring.vertices[i]);
        }
    }

    /// Removes the triangle between two sides that become one.
    fn remove(&mut self, side: u32, other: u32) {
        let (g, h) = (self.opposite[side as usize], self.opposite[other as usize]);
        self.glue(g, h);
        for outer in [g, h].into_iter().filter(|&outer| outer != NONE) {
            for leaving in [outer, next(outer)] {
                let v = self.origin(leaving) as usize;
                // The one without an opposite is found again only where it goes.
                if !self.at_boundary[v] || self.leaving[v] / 3 == side / 3 {
                    self.leaving[v] = leaving;
                }
            }
        }
        self.alive[side as usize / 3] = false;
        self.n_triangles -= 1;
    }

    /// Makes `v` leave by the halfedge without an opposite, if it is at the boundary.
    fn turn_to_boundary(&mut self, v: u32) {
        if !self.at_boundary[v as usize] {
            return;
        }
        let first = self.leaving[v as usize];
        let mut h = first;
        loop {
            let across = self.opposite[h as usize];
            if across == NONE {
                self.leaving[v as usize] = h;
                return;
            }
            h = next(across);
            if h == first {
                return;
            }
        }
    }
}

fn next(halfedge: u32) -> u32 {
    if halfedge % 3 == 2 {
        halfedge - 2
    } else {
        halfedge + 1
    }
}

//! Choice of vertices to collapse and their target neighbors.

use super::triangulation::{Ring, Triangulation};
use super::tutte::ClosedDisk;
use crate::mesh::{Disk, UsedVertices};
use std::collections::HashSet;
use unwrapd_method::numerics::vec3::{add_scaled, area_vector, dot, norm, sub};

/// A vertex that was moved onto a neighbor, with the data to undo that.
#[derive(Clone, Copy, Debug)]
pub(super) struct Collapse {
    pub vertex: u32,
    /// Start of its ring at that time in [`Collapses::rings`].
    start: u32,
    end: u32,
    pub closed: bool,
    /// Place of the neighbor in the ring.
    pub at: u32,
}

/// Collapses, in the order in which they were made.
#[derive(Clone, Debug, Default)]
pub(super) struct Collapses {
    pub list: Vec<Collapse>,
    rings: Vec<u32>,
}

/// Care of a decimation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Care {
    /// Triangles keep a good shape and holes stay: the coarse mesh is a fair approximation of the fine one.
    Shape,
    /// Only the topology counts: any disk gets down to a few triangles.
    Topology,
}

/// Least quality of a new triangle, unless there was a worse one; 1 is equilateral. Higher values keep better shapes
/// but end the decimation earlier.
const LEAST_QUALITY: f64 = 0.08;

/// Most neighbors that two vertices may have together for one to be collapsed onto the other, which will then have four
/// fewer: rings stay cheap and their kernels wide.
const MOST_NEIGHBORS: usize = 20;

impl Collapses {
    /// Returns the neighbors of a collapsed vertex, counter-clockwise.
    pub fn ring(&self, collapse: &Collapse) -> &[u32] {
        &self.rings[collapse.start as usize..collapse.end as usize]
    }

    fn push(&mut self, vertex: u32, ring: &Ring, at: usize) {
        let start = self.rings.len() as u32;
        self.rings.extend_from_slice(&ring.vertices);
        self.list.push(Collapse {
            vertex,
            start,
            end: self.rings.len() as u32,
            closed: ring.closed,
            at: at as u32,
        });
    }
}

/// Coarsens a triangulation pass by pass.
pub(super) struct Decimation<'a> {
    pub triangulation: Triangulation,
    positions: &'a [[f64; 3]],
    /// Number of real triangles; those after them in the original list fill holes.
    n_real: usize,
    locked: Vec<bool>,
}

impl<'a> Decimation<'a> {
    pub fn new(positions: &'a [[f64; 3]], triangles: &[[u32; 3]], n_real: usize) -> Self {
        Self {
            triangulation: Triangulation::new(positions.len(), triangles),
            positions,
            n_real,
            locked: vec![false; positions.len()],
        }
    }

    /// Collapses vertices until `goal` are left or none can be collapsed; those with the flattest and smallest
    /// surroundings go first.
    ///
    /// In each pass no two collapses touch, so that removals are spread evenly.
    pub fn coarsen(&mut self, goal: usize, care: Care) -> Collapses {
        let mut collapses = Collapses::default();
        let mut left = self.triangulation.vertices();
        while left.len() > goal {
            let n_before = collapses.list.len();
            self.pass(&left, left.len() - goal, care, &mut collapses);
            let n_collapsed = collapses.list.len() - n_before;
            // A pass that gains a hundredth is not worth its time, unless the last few must go.
            if n_collapsed * 100 < left.len() && (care == Care::Shape || n_collapsed == 0) {
                break;
            }
            left = self.triangulation.vertices();
        }
        collapses
    }

    fn pass(&mut self, left: &[u32], surplus: usize, care: Care, collapses: &mut Collapses) {
        let mut ring = Ring::default();
        // Order the vertices by the shape that is lost without them.
        let mut order: Vec<(f64, u32)> = Vec::with_capacity(left.len());
        for &v in left {
            self.locked[v as usize] = false;
            self.triangulation.ring(v, &mut ring);
            order.push((self.cost(v, &ring), v));
        }
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut surplus = surplus;
        // Collapse the cheapest ones, and lock their rings until the next pass.
        for (_, v) in order {
            if surplus == 0 {
                return;
            }
            if self.locked[v as usize] {
                continue;
            }
            self.triangulation.ring(v, &mut ring);
            let Some(at) = self.target(v, &ring, care) else {
                continue;
            };
            self.triangulation.collapse(v, &ring, at);
            collapses.push(v, &ring, at);
            for &neighbor in &ring.vertices {
                self.locked[neighbor as usize] = true;
            }
            surplus -= 1;
        }
    }

    fn at(&self, v: u32) -> [f64; 3] {
        self.positions[v as usize]
    }

    /// Returns the loss of shape without `v`: area times non-flatness (1 − |Σ N|/Σ|N|), plus the area cut off at a bent
    /// boundary. A hundredth of the area itself decides among flat ones.
    fn cost(&self, v: u32, ring: &Ring) -> f64 {
        let center = self.at(v);
        let (mut sum, mut area) = ([0.0; 3], 0.0);
        for [a, b] in ring.pairs() {
            let normal = area_vector(center, self.at(a), self.at(b));
            sum = add_scaled(sum, 1.0, normal);
            area += norm(normal);
        }
        let bend = match (ring.vertices.first(), ring.vertices.last()) {
            (Some(&a), Some(&b)) if !ring.closed => {
                norm(area_vector(center, self.at(a), self.at(b)))
            }
            _ => 0.0,
        };
        area - norm(sum) + bend + 0.01 * area
    }

    /// Returns the place of the neighbor with the best worst triangle, among those onto which `v` may be collapsed.
    fn target(&mut self, v: u32, ring: &Ring, care: Care) -> Option<usize> {
        let present = (ring.pairs())
            .map(|[a, b]| self.quality(v, a, b))
            .fold(1.0, f64::min);
        let least = match care {
            Care::Shape => LEAST_QUALITY.min(present),
            Care::Topology => 0.0,
        };
        let most = MOST_NEIGHBORS.saturating_sub(ring.halfedges.len());
        if care == Care::Shape && most == 0 {
            return None;
        }
        let mut candidates: Vec<(f64, usize)> = (0..ring.vertices.len())
            .filter(|&at| care == Care::Topology || self.keeps_holes(ring, at))
            .map(|at| (self.quality_after(ring, at), at))
            .filter(|&(quality, _)| quality >= least)
            .collect();
        candidates.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        (candidates.into_iter().map(|(_, at)| at)).find(|&at| {
            let target = ring.vertices[at];
            let is_crowded =
                care == Care::Shape && self.triangulation.has_more_triangles(target, most);
            !is_crowded && self.triangulation.can_collapse(ring, at)
        })
    }

    /// Returns whether a collapse keeps holes: a hole's apex stays, and the vertices of its loop move only along the
    /// loop.
    fn keeps_holes(&self, ring: &Ring, at: usize) -> bool {
        let is_virtual = |h: &u32| *h as usize / 3 >= self.n_real;
        let n_virtual = ring.halfedges.iter().filter(|h| is_virtual(h)).count();
        if n_virtual == 0 || n_virtual == ring.halfedges.len() {
            return n_virtual == 0;
        }
        let n = ring.halfedges.len();
        let before = if ring.closed {
            Some((at + n - 1) % n)
        } else {
            at.checked_sub(1)
        };
        let side = |i: Option<usize>| i.and_then(|i| ring.halfedges.get(i)).map(is_virtual);
        side(before) != side(Some(at))
    }

    /// Returns the worst quality of a triangle after the middle of the ring has moved onto neighbor number `at`.
    fn quality_after(&self, ring: &Ring, at: usize) -> f64 {
        let target = ring.vertices[at];
        (ring.pairs())
            .filter(|pair| !pair.contains(&target))
            .map(|[a, b]| self.quality(target, a, b))
            .fold(1.0, f64::min)
    }

    /// Returns 4√3 · area / Σ edge²: 1 for an equilateral triangle, 0 for one without area.
    fn quality(&self, a: u32, b: u32, c: u32) -> f64 {
        let [a, b, c] = [a, b, c].map(|v| self.at(v));
        let squares: f64 = [(a, b), (b, c), (c, a)]
            .map(|(p, q)| dot(sub(p, q), sub(p, q)))
            .iter()
            .sum();
        let doubled_area = norm(area_vector(a, b, c));
        2.0 * 3_f64.sqrt() * doubled_area / squares.max(f64::MIN_POSITIVE)
    }
}

// A simplified disk, and the transfer of seams back to the original.

/// A disk with fewer vertices than the one it was made from.
pub struct Simplification {
    /// The simplified disk, with the same number of holes.
    pub disk: Disk,
    /// For each of its vertices the one of the finer disk.
    pub vertices: Vec<u32>,
    collapses: Collapses,
    /// For each vertex of the finer disk whether it is on the boundary.
    is_on_boundary: Vec<bool>,
}

impl Simplification {
    /// Simplifies a disk to about `n_vertices` vertices, or more where its shape would suffer. Returns `None` if the
    /// result is not a disk.
    pub fn new(disk: &Disk, positions: &[[f64; 3]], n_vertices: usize) -> Option<Self> {
        let closed = ClosedDisk::new(disk, positions);
        let mut decimation = Decimation::new(&closed.positions, &closed.triangles, closed.n_real);
        let collapses = decimation.coarsen(n_vertices, Care::Shape);
        let triangles = decimation
            .triangulation
            .triangles()
            .filter(|&(t, _): &(usize, [u32; 3])| t < closed.n_real);
        let mut triangles: Vec<[u32; 3]> = triangles.map(|(_, triangle)| triangle).collect();
        let vertices = UsedVertices::new(triangles.iter().flatten().copied());
        vertices.renumber(triangles.as_flattened_mut());
        let mut is_on_boundary = vec![false; closed.positions.len()];
        for &v in disk.loops.iter().flatten() {
            is_on_boundary[v as usize] = true;
        }
        Some(Self {
            disk: Disk::new(vertices.count(), triangles).ok()?,
            vertices: vertices.into_vec(),
            collapses,
            is_on_boundary,
        })
    }

    /// Transfers seams to the finer disk: returns the interior edges that divide it as these interior edges divide the
    /// simplified disk, each as its two vertices in increasing order.
    ///
    /// The collapsed vertices are put back one by one: edges of the neighbor that lie across such a vertex then end at
    /// the vertex.
    pub fn carried_back(&self, seams: &[[u32; 2]]) -> HashSet<[u32; 2]> {
        let mut carried = Carried {
            edges: HashSet::new(),
            n_at: vec![0; self.is_on_boundary.len()],
            is_on_boundary: &self.is_on_boundary,
        };
        for seam in seams {
            let [a, b] = seam.map(|v| self.vertices[v as usize]);
            carried.insert(a, b);
        }
        for collapse in self.collapses.list.iter().rev() {
            carried.put_back(collapse, self.collapses.ring(collapse));
        }
        carried.edges
    }
}

/// Seams while vertices are put back.
struct Carried<'a> {
    edges: HashSet<[u32; 2]>,
    /// For each vertex the number of seam edges at it.
    n_at: Vec<u32>,
    is_on_boundary: &'a [bool],
}

impl Carried<'_> {
    fn insert(&mut self, a: u32, b: u32) {
        if self.edges.insert([a.min(b), a.max(b)]) {
            self.n_at[a as usize] += 1;
            self.n_at[b as usize] += 1;
        }
    }

    fn remove(&mut self, a: u32, b: u32) -> bool {
        let is_there = self.edges.remove(&[a.min(b), a.max(b)]);
        if is_there {
            self.n_at[a as usize] -= 1;
            self.n_at[b as usize] -= 1;
        }
        is_there
    }

    /// Puts a vertex back between the neighbor onto which it was collapsed and the others of its ring.
    fn put_back(&mut self, collapse: &Collapse, ring: &[u32]) {
        let (vertex, at) = (collapse.vertex, collapse.at as usize);
        let onto = ring[at];
        if self.n_at[onto as usize] == 0 {
            return;
        }
        let is_beside = |i: usize| {
            let apart = i.abs_diff(at);
            apart <= 1 || collapse.closed && apart == ring.len() - 1
        };
        let across = (0..ring.len()).filter(|&i| !is_beside(i));
        let moved: Vec<u32> = across
            .map(|i| ring[i])
            .filter(|&other| self.remove(onto, other))
            .collect();
        for &other in &moved {
            self.insert(vertex, other);
        }
        // A seam that ended at the neighbor still does, and seams that met there still do; where all of these lay across the vertex,
        // they meet at the vertex now. What is on the boundary went along it.
        let goes_on = self.n_at[onto as usize] > 0 || self.is_on_boundary[onto as usize];
        let is_inside = !self.is_on_boundary[vertex as usize];
        if is_inside && !moved.is_empty() && (goes_on || moved.len() == 1) {
            self.insert(vertex, onto);
        }
    }
}

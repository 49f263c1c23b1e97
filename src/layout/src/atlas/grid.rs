//! One chart rounded to the grid, with every triangle positive where that is possible.
//!
//! Rounding alone is right for all but a few triangles. Where it is not, the vertices of the
//! triangle try the grid points around (the ring's kernel, searched exhaustively); what is left is
//! too narrow for the grid and is opened by [`relax`] in ever larger neighborhoods, then rounded
//! again. Borders nearer than a grid step, as the sides of a thin slit are, may cross once they are rounded; their
//! vertices try the grid points around, too, until no triangles overlap. A chart that has flipped or degenerate triangles as given, as authored UVs and maps without a barrier have, and one that
//! cannot be repaired keep their shape: they are rounded and nothing else, and the certificate counts what has no area.
use rayon::prelude::*;
use std::collections::BTreeSet;

use super::outline::{Outline, boundary};
use super::relax::{neighborhood, relax};
use super::{ChartMap, doubled_area};
use unwrapd_maps::mesh::{CornerUvs, VertexFaces};
use unwrapd_maps::plane::{
    BoxIndex, Segment, interiors_intersect, search_budget, segment_distance,
};
use unwrapd_method::numerics::bounds::{bounds_of, widened};
use unwrapd_method::numerics::predicates::orient2d_sign;

/// A chart on the grid, its bounding rectangle's lower left corner near the origin.
#[derive(Clone, Debug)]
pub(super) struct Snapped {
    pub grid: Vec<[i32; 2]>,
    /// Vertices that are not where rounding alone would put them.
    pub moved: usize,
    /// The largest distance between a vertex and its exact position, in grid units.
    pub largest_move: f64,
}

/// Grid points tried around the exact position: this many columns and rows to each side.
const REACH: i32 = 2;
/// Neighborhoods tried; each has twice as many rings as the one before.
const ROUNDS: u32 = 12;
/// Grid units between parts of a border that rounding may bring together: each point moves by up to 1/√2.
const NEAR: f64 = 1.5;
/// Passes over the triangles that overlap along near borders. Each moves only what makes fewer of them overlap; the number bounds the
/// time of a crowd.
const PASSES: usize = 16;

/// The treatment of triangles without area after rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Repair {
    /// Moves vertices to open them, where possible.
    Open,
    /// Leaves them: every vertex goes to the nearest grid point.
    Nothing,
}

/// The chart at `unit` grid units per mesh unit.
pub(super) fn snapped(map: &ChartMap, outline: &Outline, unit: f64, repair: Repair) -> Snapped {
    let exact = |v: usize| outline.place(map.uv[v]).map(|x| x * unit);
    let rounded: Vec<[i32; 2]> = (0..map.uv.len()).map(|v| round(exact(v))).collect();
    let mut snap = Snap {
        triangles: map.triangles,
        grid: rounded.clone(),
        rings: VertexFaces::default(),
    };
    let all: Vec<u32> = (0..map.triangles.len() as u32).collect();
    if repair == Repair::Open {
        let bad = snap.without_area(&all);
        let near = near_vertices(map, outline, unit);
        if !(bad.is_empty() && near.is_empty()) && is_positive(map) {
            snap.rings = VertexFaces::new(map.uv.len(), map.triangles);
            let is_repaired = bad.is_empty() || snap.repair(map, outline, unit, bad).is_some();
            if is_repaired && snap.without_area(&all).is_empty() {
                snap.open_slits(&near, |v| exact(v as usize));
            } else {
                snap.grid.clone_from(&rounded);
            }
        }
    }
    let distance = |v: usize| {
        let [x, y] = exact(v);
        (x - f64::from(snap.grid[v][0])).hypot(y - f64::from(snap.grid[v][1]))
    };
    Snapped {
        moved: rounded
            .iter()
            .zip(&snap.grid)
            .filter(|(a, b)| a != b)
            .count(),
        largest_move: (0..map.uv.len()).map(distance).fold(0.0, f64::max),
        grid: snap.grid,
    }
}

/// Whether every triangle is positive as given.
fn is_positive(map: &ChartMap) -> bool {
    map.triangles.iter().all(|t| {
        let [a, b, c] = t.map(|v| map.uv[v as usize]);
        orient2d_sign(a, b, c) > 0
    })
}

fn round(p: [f64; 2]) -> [i32; 2] {
    p.map(|x| x.round() as i32)
}

/// Returns the vertices of the border that lie nearer than [`NEAR`] to a part of it that they do not belong to, in increasing order.
/// O(n log n) in the edges of the border.
pub(super) fn near_vertices(map: &ChartMap, outline: &Outline, unit: f64) -> Vec<u32> {
    let edges: Vec<Segment> = outline
        .edges()
        .map(|edge| edge.map(|p| p.map(|x| x * unit)))
        .collect();
    let boxes: Vec<_> = edges
        .iter()
        .map(|edge| widened(bounds_of(edge), NEAR / 2.0))
        .collect();
    let mut near = BTreeSet::new();
    BoxIndex::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
        if are_near(edges[i as usize], edges[j as usize]) {
            near.extend([i, j]);
        }
    });
    if near.is_empty() {
        return Vec::new();
    }
    let border = boundary(map);
    let vertices: BTreeSet<u32> = near
        .iter()
        .flat_map(|&edge| border[edge as usize])
        .collect();
    vertices.into_iter().collect()
}

/// Returns true if two edges of a border may cross once they are rounded. Edges that meet at a vertex may if an end of one lies near
/// the other.
fn are_near(a: Segment, b: Segment) -> bool {
    let apart =
        |ends: Segment, other: Segment| ends.into_iter().filter(move |p| !other.contains(p));
    let from_ends = |ends: Segment, other: Segment| {
        apart(ends, other).any(|end| segment_distance([end; 2], other) < NEAR)
    };
    let is_joined = a.iter().any(|p| b.contains(p));
    if is_joined {
        from_ends(a, b) || from_ends(b, a)
    } else {
        segment_distance(a, b) < NEAR
    }
}

/// A chart on the way to the grid.
struct Snap<'a> {
    triangles: &'a [[u32; 3]],
    grid: Vec<[i32; 2]>,
    rings: VertexFaces,
}

impl Snap<'_> {
    fn repair(
        &mut self,
        map: &ChartMap,
        outline: &Outline,
        unit: f64,
        mut bad: Vec<u32>,
    ) -> Option<()> {
        let mut plane = map.uv.to_vec();
        for round_of in 0..=ROUNDS {
            let exact = |v: u32| outline.place(plane[v as usize]).map(|x| x * unit);
            self.nudge(&mut bad, exact);
            if bad.is_empty() {
                return Some(());
            }
            let patch = neighborhood(self.triangles, &self.rings, &bad, 1 << round_of);
            let cell = 1.0 / unit;
            let free = relax(self.triangles, &self.rings, &patch, &[], cell, &mut plane);
            for v in free {
                self.grid[v as usize] = round(outline.place(plane[v as usize]).map(|x| x * unit));
            }
            bad = self.without_area(&patch);
        }
        None
    }

    fn without_area(&self, among: &[u32]) -> Vec<u32> {
        among
            .par_iter()
            .copied()
            .filter(|&t| !self.is_positive(t))
            .collect()
    }

    fn is_positive(&self, t: u32) -> bool {
        doubled_area(self.cells(t)) > 0
    }

    /// The corners of a triangle on the grid.
    fn cells(&self, t: u32) -> [[i32; 2]; 3] {
        self.triangles[t as usize].map(|v| self.grid[v as usize])
    }

    /// Like [`cells`](Self::cells), as coordinates, which are exact.
    fn corners(&self, t: u32) -> CornerUvs {
        self.cells(t).map(|p| p.map(f64::from))
    }

    /// Moves vertices of bad triangles to grid points near their exact position, as long as that
    /// makes fewer triangles bad.
    fn nudge(&mut self, bad: &mut Vec<u32>, exact: impl Fn(u32) -> [f64; 2]) {
        loop {
            let mut touched = Vec::new();
            for &t in &*bad {
                for v in self.triangles[t as usize] {
                    let defects = |snap: &Self| [snap.bad_in_ring(v), 0];
                    if !self.is_positive(t) && self.nudge_vertex(v, exact(v), defects) {
                        touched.push(v);
                    }
                }
            }
            // A move may repair two triangles and spoil a third.
            bad.extend(touched.iter().flat_map(|&v| self.rings.of(v)));
            bad.sort_unstable();
            bad.dedup();
            bad.retain(|&t| !self.is_positive(t));
            if touched.is_empty() || bad.is_empty() {
                return;
            }
        }
    }

    /// Moves a vertex to the grid point around its exact position with the fewest defects, of those to the nearest; only if it has fewer
    /// there. Returns whether it moved.
    fn nudge_vertex(
        &mut self,
        v: u32,
        exact: [f64; 2],
        defects: impl Fn(&Self) -> [usize; 2],
    ) -> bool {
        let before = self.grid[v as usize];
        let key = |defects: [usize; 2], p: [i32; 2]| {
            (
                defects,
                (f64::from(p[0]) - exact[0]).hypot(f64::from(p[1]) - exact[1]),
            )
        };
        let count = defects(self);
        let mut best = (key(count, before), before);
        let [x, y] = round(exact);
        for i in -REACH..=REACH {
            for j in -REACH..=REACH {
                self.grid[v as usize] = [x + i, y + j];
                let candidate = key(defects(self), [x + i, y + j]);
                if candidate < best.0 {
                    best = (candidate, [x + i, y + j]);
                }
            }
        }
        let improved = best.0.0 < count;
        self.grid[v as usize] = if improved { best.1 } else { before };
        improved
    }

    /// The number of triangles at a vertex without area.
    fn bad_in_ring(&self, v: u32) -> usize {
        self.rings
            .of(v)
            .iter()
            .filter(|&&t| !self.is_positive(t))
            .count()
    }

    /// Moves vertices of triangles that overlap to grid points near their exact position, as long as fewer pairs overlap and no triangle
    /// loses its area. `near` is what [`near_vertices`] returns.
    fn open_slits(&mut self, near: &[u32], exact: impl Fn(u32) -> [f64; 2]) {
        let along = Along::new(self, near);
        for _ in 0..PASSES {
            let mut is_any_moved = false;
            for v in along.overlapping(self) {
                is_any_moved |= self.nudge_vertex(v, exact(v), |snap| along.defects(snap, v));
            }
            if !is_any_moved {
                return;
            }
        }
    }
}

/// The triangles along near borders.
struct Along {
    triangles: Vec<u32>,
    /// Their boxes on the grid, as wide as their corners may move.
    index: BoxIndex,
}

impl Along {
    fn new(snap: &Snap, near: &[u32]) -> Self {
        let mut triangles: Vec<u32> = (near.iter())
            .flat_map(|&v| snap.rings.of(v))
            .copied()
            .collect();
        triangles.sort_unstable();
        triangles.dedup();
        let margin = f64::from(2 * REACH);
        let boxes: Vec<_> = (triangles.iter())
            .map(|&t| widened(bounds_of(&snap.corners(t)), margin))
            .collect();
        Self {
            index: BoxIndex::new(&boxes),
            triangles,
        }
    }

    /// The vertices of triangles that overlap, in increasing order.
    fn overlapping(&self, snap: &Snap) -> BTreeSet<u32> {
        let mut vertices = BTreeSet::new();
        for &t in &self.triangles {
            self.visit_overlaps(snap, t, |other| {
                vertices.extend([t, other].iter().flat_map(|&f| snap.triangles[f as usize]));
            });
        }
        vertices
    }

    /// Triangles at a vertex without area, then pairs of one at it and another that overlap.
    fn defects(&self, snap: &Snap, v: u32) -> [usize; 2] {
        let mut n_pairs = 0;
        for &t in snap.rings.of(v) {
            self.visit_overlaps(snap, t, |_| n_pairs += 1);
        }
        [snap.bad_in_ring(v), n_pairs]
    }

    /// Visits the triangles that overlap one on the grid, decided exactly.
    fn visit_overlaps(&self, snap: &Snap, t: u32, mut visit: impl FnMut(u32)) {
        if !snap.is_positive(t) {
            return;
        }
        let corners = snap.corners(t);
        self.index.meeting(&bounds_of(&corners), |i| {
            let other = self.triangles[i as usize];
            if other != t
                && snap.is_positive(other)
                && interiors_intersect(&corners, &snap.corners(other))
            {
                visit(other);
            }
        });
    }
}

/// Texels by which two charts may come nearer: each point moves by at most one to each side and up or down.
pub(super) const ROOM_TEXELS: u32 = 3;

/// A chart widened to the next borders of texels of so many steps on all sides. One of which a triangle would lose its area to
/// rounding is only shifted, so that it ends at texels on two sides.
pub(super) fn aligned(map: &ChartMap, grid: Vec<[i32; 2]>, texel: i32) -> Vec<[i32; 2]> {
    if map.triangles.is_empty() {
        return grid;
    }
    let axes = [0, 1].map(|axis| Axis::new(&grid, axis, texel));
    let widened: Vec<[i32; 2]> = with_each(&grid, |axis, x| axes[axis].widened(x));
    if is_positive_on_grid(map, &widened) || !is_positive_on_grid(map, &grid) {
        widened
    } else {
        with_each(&grid, |axis, x| axes[axis].shifted(x))
    }
}

fn with_each(grid: &[[i32; 2]], to: impl Fn(usize, i32) -> i32) -> Vec<[i32; 2]> {
    grid.iter().map(|[x, y]| [to(0, *x), to(1, *y)]).collect()
}

fn is_positive_on_grid(map: &ChartMap, grid: &[[i32; 2]]) -> bool {
    let area = |t: &[u32; 3]| doubled_area(t.map(|v| grid[v as usize]));
    map.triangles.iter().all(|t| area(t) > 0)
}

/// The extent of a chart along an axis, and that of the texels that it touches.
struct Axis {
    low: i32,
    length: i64,
    texels_low: i32,
    texels_length: i64,
}

impl Axis {
    fn new(grid: &[[i32; 2]], axis: usize, texel: i32) -> Self {
        let of = || grid.iter().map(|point| point[axis]);
        let (low, high) = (of().min().unwrap_or(0), of().max().unwrap_or(0));
        let texels_low = low.div_euclid(texel) * texel;
        let texels_high = -(-high).div_euclid(texel) * texel;
        Self {
            low,
            length: i64::from(high - low),
            texels_low,
            texels_length: i64::from(texels_high - texels_low),
        }
    }

    fn widened(&self, x: i32) -> i32 {
        let along = i64::from(x - self.low) * self.texels_length;
        self.texels_low + ((2 * along + self.length) / (2 * self.length.max(1))) as i32
    }

    fn shifted(&self, x: i32) -> i32 {
        x - self.low + self.texels_low
    }
}

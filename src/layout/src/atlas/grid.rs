//! Rounds a chart to the grid, with every triangle positive where that is possible.
//!
//! Rounding alone is right for all but a few triangles. Where it is not, the vertices of the triangle try all grid points around
//! their position. Triangles that remain are too narrow for the grid: [`relax`] opens them in ever larger neighborhoods, and they
//! are rounded again. Borders nearer than a grid step, such as the sides of a thin slit, may cross once they are rounded. Their
//! vertices also try the grid points around, until no triangles overlap.
//!
//! Two kinds of charts keep their shape and are only rounded: charts with flipped or degenerate triangles as given, which authored
//! UVs and maps without a barrier may have, and charts that cannot be repaired. The certificate counts their triangles without
//! area.
use rayon::prelude::*;
use std::collections::BTreeSet;

use super::outline::{Outline, boundary};
use super::problem::ChartMap;
use super::relax::{neighborhood, relax};
use unwrapd_maps::mesh::{CornerUvs, VertexFaces};
use unwrapd_maps::plane::{
    BoxIndex, Segment, interiors_intersect, search_budget, segment_distance,
};
use unwrapd_method::numerics::bounds::{bounds_of, widened};
use unwrapd_method::numerics::predicates::orient2d_sign;

/// Chart on the grid, with the lower left corner of its bounding rectangle near the origin.
#[derive(Clone, Debug)]
pub(super) struct Snapped {
    pub grid: Vec<[i32; 2]>,
    /// Number of vertices that are not where rounding alone would put them.
    pub moved: usize,
    /// Largest distance between a vertex and its exact position, in grid units.
    pub largest_move: f64,
}

impl Snapped {
    /// Returns the distance by which vertices move, in grid units, once the chart is shifted by a rounded distance.
    pub(super) fn needed(&self) -> f64 {
        self.largest_move + 2.0
    }
}

/// Number of columns and rows of grid points, to each side of the exact position, that are tried.
const REACH: i32 = 2;
/// Number of neighborhoods tried; each has twice as many rings as the one before.
const ROUNDS: u32 = 12;
/// Distance in grid units below which rounding may make parts of a border cross: each point moves by up to 1/√2.
const NEAR: f64 = 1.5;
/// Maximum number of passes over the triangles that overlap along near borders. A pass only makes moves that reduce the number of
/// overlaps. The limit bounds the time where many triangles overlap.
const PASSES: usize = 16;

/// Treatment of triangles without area after rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Repair {
    /// Moves vertices to open them, where possible.
    Open,
    /// Leaves them: every vertex goes to the nearest grid point.
    Nothing,
}

/// Rounds a chart to the grid at `unit` grid units per mesh unit.
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

/// Returns whether every triangle is positive as given.
fn is_positive(map: &ChartMap) -> bool {
    map.triangles.iter().all(|t| {
        let [a, b, c] = t.map(|v| map.uv[v as usize]);
        orient2d_sign(a, b, c) > 0
    })
}

fn round(p: [f64; 2]) -> [i32; 2] {
    p.map(|x| x.round() as i32)
}

/// Returns the vertices of the border edges that may cross other border edges once they are rounded, in increasing order.
///
/// Time: O(n log n) in the edges of the border.
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

/// Returns `true` if two edges of a border may cross once they are rounded. Edges that meet at a vertex may cross if an end of one
/// lies near the other.
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

/// Chart that is being rounded to the grid.
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
        for attempt in 0..=ROUNDS {
            let exact = |v: u32| outline.place(plane[v as usize]).map(|x| x * unit);
            self.nudge(&mut bad, exact);
            if bad.is_empty() {
                return Some(());
            }
            if attempt < ROUNDS {
                let patch = neighborhood(self.triangles, &self.rings, &bad, 1 << attempt);
                let cell = 1.0 / unit;
                let free = relax(self.triangles, &self.rings, &patch, &[], cell, &mut plane);
                for v in free {
                    self.grid[v as usize] =
                        round(outline.place(plane[v as usize]).map(|x| x * unit));
                }
                bad = self.without_area(&patch);
            }
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

    /// Returns the corners of a triangle on the grid.
    fn cells(&self, t: u32) -> [[i32; 2]; 3] {
        self.triangles[t as usize].map(|v| self.grid[v as usize])
    }

    /// Returns the corners like [`cells`](Self::cells), but as floating-point coordinates, which are exact.
    fn corners(&self, t: u32) -> CornerUvs {
        self.cells(t).map(|p| p.map(f64::from))
    }

    /// Moves vertices of bad triangles to grid points near their exact position, as long as this makes fewer triangles bad.
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

    /// Moves a vertex to the grid point around its exact position with the fewest defects, and to the nearest of several such
    /// points. Moves it only if this reduces the defects. Returns whether it moved.
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

    /// Returns the number of triangles at a vertex that are not positive on the grid.
    fn bad_in_ring(&self, v: u32) -> usize {
        self.rings
            .of(v)
            .iter()
            .filter(|&&t| !self.is_positive(t))
            .count()
    }

    /// Moves vertices of overlapping triangles to grid points near their exact position, as long as fewer pairs overlap and no
    /// triangle loses its area. `near` is the result of [`near_vertices`].
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

/// Triangles along near borders.
struct Along {
    triangles: Vec<u32>,
    /// Boxes of the triangles on the grid, widened by the distance that corners may move.
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

    /// Returns the vertices of overlapping triangles, in increasing order.
    fn overlapping(&self, snap: &Snap) -> BTreeSet<u32> {
        let mut vertices = BTreeSet::new();
        for &t in &self.triangles {
            self.visit_overlaps(snap, t, |other| {
                vertices.extend([t, other].iter().flat_map(|&f| snap.triangles[f as usize]));
            });
        }
        vertices
    }

    /// Returns the number of triangles without area at a vertex, and the number of overlaps of its triangles with others.
    fn defects(&self, snap: &Snap, v: u32) -> [usize; 2] {
        let mut n_pairs = 0;
        for &t in snap.rings.of(v) {
            self.visit_overlaps(snap, t, |_| n_pairs += 1);
        }
        [snap.bad_in_ring(v), n_pairs]
    }

    /// Visits the triangles that overlap a given one on the grid, decided exactly. Ignores triangles without area.
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

/// Widens a chart to the next texel borders on all sides; `texel` is in grid steps. A chart with a triangle that would lose its
/// area to rounding is only shifted, so that it ends at texel borders on two sides.
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

/// Extent of a chart along an axis, and the extent of the texels that it touches, in grid steps.
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

/// Returns twice the signed area of a grid triangle, exact.
pub(super) fn doubled_area([a, b, c]: [[i32; 2]; 3]) -> i64 {
    let [ax, ay] = a.map(i64::from);
    let [bx, by] = b.map(i64::from);
    let [cx, cy] = c.map(i64::from);
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

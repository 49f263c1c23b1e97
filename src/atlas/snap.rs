//! One chart rounded to the grid, with every triangle positive where that is possible.
//!
//! Rounding alone is right for all but a few triangles. Where it is not, the vertices of the
//! triangle try the grid points around (the ring's kernel, searched exhaustively); what is left is
//! too narrow for the grid and is opened by [`relax`] in ever larger neighborhoods, then rounded
//! again. A chart that has flipped or degenerate triangles as given, as authored UVs and maps without a barrier have, and one that
//! cannot be repaired keep their shape: they are rounded and nothing else, and the certificate counts what has no area.
use rayon::prelude::*;

use super::relax::{neighborhood, relax};
use super::{ChartMap, doubled_area, outline::Outline};
use crate::mesh::VertexFaces;
use crate::numerics::predicates::orient2d_sign;

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
    let bad = snap.without_area(&all);
    if repair == Repair::Open && !bad.is_empty() && is_positive(map) {
        snap.rings = VertexFaces::new(map.uv.len(), map.triangles);
        let is_repaired = snap.repair(map, outline, unit, bad).is_some();
        if !is_repaired || !snap.without_area(&all).is_empty() {
            snap.grid.clone_from(&rounded);
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
        doubled_area(self.triangles[t as usize].map(|v| self.grid[v as usize])) > 0
    }

    /// Moves vertices of bad triangles to grid points near their exact position, as long as that
    /// makes fewer triangles bad.
    fn nudge(&mut self, bad: &mut Vec<u32>, exact: impl Fn(u32) -> [f64; 2]) {
        loop {
            let mut touched = Vec::new();
            for &t in &*bad {
                for v in self.triangles[t as usize] {
                    if !self.is_positive(t) && self.nudge_vertex(v, exact(v)) {
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

    fn nudge_vertex(&mut self, v: u32, exact: [f64; 2]) -> bool {
        let before = self.grid[v as usize];
        let key = |bad: usize, p: [i32; 2]| {
            (
                bad,
                (f64::from(p[0]) - exact[0]).hypot(f64::from(p[1]) - exact[1]),
            )
        };
        let count = self.bad_in_ring(v);
        let mut best = (key(count, before), before);
        let [x, y] = round(exact);
        for i in -REACH..=REACH {
            for j in -REACH..=REACH {
                self.grid[v as usize] = [x + i, y + j];
                let candidate = key(self.bad_in_ring(v), [x + i, y + j]);
                if candidate < best.0 {
                    best = (candidate, [x + i, y + j]);
                }
            }
        }
        let improved = best.0.0 < count;
        self.grid[v as usize] = if improved { best.1 } else { before };
        improved
    }

    fn bad_in_ring(&self, v: u32) -> usize {
        self.rings
            .of(v)
            .iter()
            .filter(|&&t| !self.is_positive(t))
            .count()
    }
}

//! Opens triangles that are too narrow for the grid.
//!
//! Every triangle of a patch gets a rest shape: its own shape, or, if its smallest height is below a few grid cells, one opened to
//! that height. The symmetric Dirichlet energy of the maps from the rest shapes to the plane then pushes small triangles open and
//! holds the others; each triangle has the same weight, however small. The energy is minimized by the solver of the library, whose
//! iterates are all strictly positive and whose energy decreases. Vertices whose ring leaves the patch stay where they are.
use std::collections::HashSet;

use super::outline::boundary;
use super::problem::ChartMap;
use unwrapd_maps::mesh::{UsedVertices, VertexFaces};
use unwrapd_maps::plane::{BoxIndex, search_budget};
use unwrapd_method::barrier::NoBarrier;
use unwrapd_method::energy::{RestShape, SymmetricDirichlet, Triangles};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of, widened};
use unwrapd_method::numerics::vec2::{dot, doubled_area, sub};
use unwrapd_method::solver::{Control, Iterate, Objective, Settings, minimize};

/// Smallest height of a rest shape, in grid cells. A triangle whose heights are √2 stays positive when its corners are rounded, as
/// each moves by at most √½. The rest compensates for the resistance of the neighbors.
const REST_HEIGHT: f64 = 4.0;
/// Share of its rest area from which on a triangle counts as open: heights of 2.4 cells.
const ENOUGH: f64 = 0.6;
/// Smallest height of an open triangle, in grid cells.
pub(super) const ENOUGH_CELLS: f64 = ENOUGH * REST_HEIGHT;
/// Maximum number of steps. Opening a triangle takes one for each factor of about 1.4 in its area.
const MAX_ITERATIONS: usize = 400;
/// Maximum number of triangles times steps, for large patches; at least 8 steps are made.
const WORK: usize = 4_000_000;

/// Moves vertices of the patch until its triangles and the gaps are wide enough for a grid with cells of size `cell`, or the limit
/// of steps is reached. Returns the vertices that were free to move. Gaps are triangles that a chart leaves free between its edges
/// and vertices. `patch` is sorted. `plane` must be strictly positive on the patch and the gaps.
pub(super) fn relax(
    triangles: &[[u32; 3]],
    rings: &VertexFaces,
    patch: &[u32],
    gaps: &[[u32; 3]],
    cell: f64,
    plane: &mut [[f64; 2]],
) -> Vec<u32> {
    let of_patch = patch.iter().map(|&t| triangles[t as usize]);
    let held: Vec<[u32; 3]> = of_patch.chain(gaps.iter().copied()).collect();
    let vertices = UsedVertices::new(held.iter().flatten().copied());
    let inside = |&t: &u32| patch.binary_search(&t).is_ok();
    let all = vertices.as_slice();
    let is_free = |&v: &u32| rings.of(v).iter().all(inside);
    let (free, fixed): (Vec<u32>, Vec<u32>) = all.iter().partition(|v| is_free(v));
    // Differences of neighbors stay exact if the origin is where the triangles are smallest.
    let corners = |t: &[u32; 3]| t.map(|v| plane[v as usize]);
    let smallest = held
        .iter()
        .min_by(|s, t| height(corners(s)).total_cmp(&height(corners(t))));
    let Some(origin) = smallest.map(|t| corners(t)[0]) else {
        return free;
    };
    let local = |p: [f64; 2]| [0, 1].map(|k| (p[k] - origin[k]) / cell);
    let x = all.iter().flat_map(|&v| local(plane[v as usize]));
    let mut x: Vec<f64> = x.collect();
    let rest: Vec<RestShape> = held.iter().map(|t| rest(corners(t).map(local))).collect();
    let mut stencils = held.clone();
    vertices.renumber(stencils.as_flattened_mut());
    let term = Triangles::new(&stencils, &rest, SymmetricDirichlet, NoBarrier);
    let mut objective = Objective::new(vertices.count(), Box::new(term));
    let number = |&v: &u32| vertices.number(v);
    objective.fix(&fixed.iter().filter_map(number).collect::<Vec<_>>());
    let max_iterations = (WORK / held.len()).clamp(8, MAX_ITERATIONS);
    let settings = Settings {
        max_iterations,
        ..Settings::draft()
    };
    let enough = |iterate: &Iterate| {
        if iterate.smallest < ENOUGH {
            Control::Continue
        } else {
            Control::Finish
        }
    };
    minimize(&mut objective, &mut x, &settings, &enough);
    for (&v, x) in all.iter().zip(x.as_chunks::<2>().0) {
        if is_free(&v) {
            plane[v as usize] = [0, 1].map(|k| origin[k] + x[k] * cell);
        }
    }
    free
}

/// Returns the triangle itself, or opened until its smallest height is [`REST_HEIGHT`], with weight 1.
fn rest(triangle: [[f64; 2]; 3]) -> RestShape {
    let edge = |i: usize| {
        let (p, q) = (triangle[i], triangle[(i + 1) % 3]);
        [q[0] - p[0], q[1] - p[1]]
    };
    let length = |i: usize| edge(i)[0].hypot(edge(i)[1]);
    let longest = (0..3)
        .max_by(|&i, &j| length(i).total_cmp(&length(j)))
        .unwrap_or(0);
    let (base, last) = (edge(longest), edge((longest + 2) % 3));
    // The equilateral triangle of that height has sides 2/√3 times as long.
    let side = length(longest).max(REST_HEIGHT * 2.0 / 3.0_f64.sqrt());
    let foot = -(last[0] * base[0] + last[1] * base[1]) / length(longest).powi(2);
    let foot = if foot.is_finite() {
        foot.clamp(0.0, 1.0)
    } else {
        0.5
    };
    let mut shape = [[0.0; 2]; 3];
    shape[(longest + 1) % 3] = [side, 0.0];
    shape[(longest + 2) % 3] = [foot * side, height(triangle).max(REST_HEIGHT)];
    let [a, b, c] = shape;
    let shape = RestShape::from_edges([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    RestShape {
        weight: 1.0,
        ..shape
    }
}

/// Returns the triangles within `n_rings` rings of some triangles, including these, sorted.
pub(super) fn neighborhood(
    triangles: &[[u32; 3]],
    rings: &VertexFaces,
    of: &[u32],
    n_rings: u32,
) -> Vec<u32> {
    let mut inside: HashSet<u32> = of.iter().copied().collect();
    let mut seen = HashSet::new();
    let mut front: Vec<u32> = inside.iter().copied().collect();
    for _ in 0..n_rings {
        let mut next = Vec::new();
        for v in front.iter().flat_map(|&t| triangles[t as usize]) {
            if seen.insert(v) {
                let ring = rings.of(v).iter().copied();
                next.extend(ring.filter(|&t| inside.insert(t)));
            }
        }
        front = next;
    }
    let mut patch: Vec<u32> = inside.into_iter().collect();
    patch.sort_unstable();
    patch
}

/// Returns the smallest height of a triangle; negative if the triangle is flipped.
pub(super) fn height([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let length = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let longest = length(a, b).max(length(b, c)).max(length(c, a));
    let doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if longest > 0.0 {
        doubled / longest
    } else {
        0.0
    }
}

/// Number of neighborhoods tried; each has twice as many rings as the one before.
const ROUNDS: u32 = 10;

/// Heights are opened to this multiple of the clearance, so that they keep it at a slightly smaller scale.
const MARGIN: f64 = 1.25;

/// Gaps up to this multiple of the clearance are kept from closing while others are opened.
const GUARDED: f64 = 3.0;

/// Returns the UVs of a chart with heights and gaps of at least `clearance`, in the units of its map, as far as they could be
/// opened; `None` if none is narrower. The chart must be strictly positive.
pub fn cleared(map: &ChartMap, clearance: f64) -> Option<Vec<[f64; 2]>> {
    let edges = boundary(map);
    let rings = VertexFaces::new(map.uv.len(), map.triangles);
    let mut plane = map.uv.to_vec();
    let mut has_moved = false;
    for round in 0..ROUNDS {
        let corners = |t: &[u32; 3]| t.map(|v| plane[v as usize]);
        let gaps = gaps(&edges, &plane, GUARDED * clearance);
        let is_narrow = |&&[b, a, v]: &&[u32; 3]| {
            let [a, b, v] = [a, b, v].map(|v| plane[v as usize]);
            is_beyond([a, b], v, clearance)
        };
        let narrow = gaps.iter().filter(is_narrow);
        let beside = narrow.flat_map(|gap| gap.iter().flat_map(|&v| rings.of(v).iter().copied()));
        let thin = (0..).zip(map.triangles);
        let thin = thin.filter(|(_, t)| height(corners(t)) < clearance);
        let seeds: Vec<u32> = thin.map(|(face, _)| face).chain(beside).collect();
        if seeds.is_empty() {
            break;
        }
        let patch = neighborhood(map.triangles, &rings, &seeds, 1 << round);
        let cell = MARGIN * clearance / ENOUGH_CELLS;
        relax(map.triangles, &rings, &patch, &gaps, cell, &mut plane);
        has_moved = true;
    }
    has_moved.then_some(plane)
}

/// Returns the triangles from each boundary edge to the vertices of other edges that lie less than `width` beyond it. All of them
/// are positive.
fn gaps(edges: &[[u32; 2]], plane: &[[f64; 2]], width: f64) -> Vec<[u32; 3]> {
    let at = |v: u32| plane[v as usize];
    let reach = |edge: &[u32; 2]| widened(bounds_of(&edge.map(at)), width / 2.0);
    let boxes: Vec<Bounds> = edges.iter().map(reach).collect();
    let mut gaps = Vec::new();
    // Only edges that lie in heaps exhaust the budget, and such charts are not positive. Fewer gaps are then guarded.
    BoxIndex::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
        for (edge, other) in [(i, j), (j, i)].map(|(i, j)| (edges[i as usize], edges[j as usize])) {
            let [a, b] = edge;
            // Starts of edges suffice: every vertex of a boundary is the start of one.
            let v = other[0];
            if v != a && v != b && is_beyond([a, b].map(at), at(v), width) {
                gaps.push([b, a, v]);
            }
        }
    });
    gaps.sort_unstable();
    gaps.dedup();
    gaps
}

/// Returns whether a point lies to the right of a directed edge, less than `width` away, and has its foot on the edge.
fn is_beyond([a, b]: [[f64; 2]; 2], p: [f64; 2], width: f64) -> bool {
    let (along, to) = (sub(b, a), sub(p, a));
    let (length_squared, foot) = (dot(along, along), dot(along, to));
    let doubled = doubled_area(b, a, p);
    (0.0..length_squared).contains(&foot)
        && 0.0 < doubled
        && doubled < width * length_squared.sqrt()
}

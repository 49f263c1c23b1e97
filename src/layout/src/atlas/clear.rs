//! Charts in which nothing is too thin for coarse rounding.
//!
//! A triangle whose smallest height exceeds a *clearance* of 2r stays positive when its corners move by up to r, and edges that are
//! farther apart stay apart. Where a chart has less, thin triangles and the gaps beside its boundary (slits above all, which
//! begin with an angle of nearly nothing) are opened by [`relax`] in ever larger neighborhoods, everything else moving as little as
//! that allows.
use super::ChartMap;
use super::outline::boundary;
use super::relax::{ENOUGH_CELLS, height, neighborhood, relax};
use unwrapd_maps::mesh::VertexFaces;
use unwrapd_maps::plane::{BoxIndex, search_budget};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of, widened};
use unwrapd_method::numerics::vec2::{dot, doubled_area, sub};

/// Neighborhoods tried; each has twice as many rings as the one before.
const ROUNDS: u32 = 10;

/// Heights are opened to this multiple of the clearance, so that they keep it at a scale a little smaller.
const MARGIN: f64 = 1.25;

/// Gaps up to this multiple of the clearance are kept from closing while others are opened.
const GUARDED: f64 = 3.0;

/// The chart with heights and gaps of at least `clearance`, in the units of its map, as far as they could be opened; none
/// if nothing has to be. The chart must be strictly positive.
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

/// Triangles from each boundary edge to the vertices of other edges that lie less than `width` beyond it, all positive.
fn gaps(edges: &[[u32; 2]], plane: &[[f64; 2]], width: f64) -> Vec<[u32; 3]> {
    let at = |v: u32| plane[v as usize];
    let reach = |edge: &[u32; 2]| widened(bounds_of(&edge.map(at)), width / 2.0);
    let boxes: Vec<Bounds> = edges.iter().map(reach).collect();
    let mut gaps = Vec::new();
    // Charts that lie in heaps are not positive; should the search end early, fewer gaps are held.
    BoxIndex::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
        for (edge, other) in [(i, j), (j, i)].map(|(i, j)| (edges[i as usize], edges[j as usize])) {
            let [a, b] = edge;
            // The start of each edge: every vertex of a boundary is one.
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

/// Whether a point lies to the right of a directed edge, less than `width` away and with its foot on the edge.
fn is_beyond([a, b]: [[f64; 2]; 2], p: [f64; 2], width: f64) -> bool {
    let (along, to) = (sub(b, a), sub(p, a));
    let (length_squared, foot) = (dot(along, along), dot(along, to));
    let doubled = doubled_area(b, a, p);
    (0.0..length_squared).contains(&foot)
        && 0.0 < doubled
        && doubled < width * length_squared.sqrt()
}

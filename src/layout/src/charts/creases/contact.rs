//! Where the outlines of two pieces touch.

use unwrapd_maps::mesh::CUT;
use unwrapd_maps::plane::{BoxIndex, Segment, segment_distance};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of, touch, widened};
use unwrapd_method::numerics::vec2::sub;

/// How far the two sides of an edge may lie apart, as a part of its length, to become one.
const SAME: f64 = 1e-3;

/// An edge of the outline of a piece.
#[derive(Clone, Copy)]
pub struct Edge {
    /// Its halfedge of the surface.
    pub halfedge: u32,
    /// Its vertices; the piece lies on the left of the way from the first to the second.
    pub ends: [u32; 2],
}

/// An outline seen from behind.
pub fn turn_over(outline: &mut [Edge]) {
    for edge in outline {
        edge.ends.reverse();
    }
}

/// The vertices that the two sides of an edge have in common.
pub fn common_vertices([edge, other]: &[Edge; 2]) -> [[u32; 2]; 2] {
    [[edge.ends[0], other.ends[1]], [edge.ends[1], other.ends[0]]]
}

/// The edges of two outlines that lie on each other and are the two sides of one edge of the surface;
/// none if the outlines come nearer than `least` anywhere but there. `twin` glues the surface.
pub fn common_edges(
    (moved, at): (&[Edge], &dyn Fn(u32) -> [f64; 2]),
    (still, rest_at): (&[Edge], &dyn Fn(u32) -> [f64; 2]),
    twin: &[u32],
    least: f64,
) -> Option<Vec<[Edge; 2]>> {
    let segment = |edge: &Edge| edge.ends.map(at);
    let rest = |edge: &Edge| edge.ends.map(rest_at);
    let places: Vec<[f64; 2]> = moved.iter().flat_map(segment).collect();
    let around = widened(bounds_of(&places), least);
    let near: Vec<Edge> = (still.iter().copied())
        .filter(|edge| touch(&bounds_of(&rest(edge)), &around))
        .collect();
    let boxes: Vec<Bounds> = near.iter().map(|edge| bounds_of(&rest(edge))).collect();
    let index = BoxIndex::new(&boxes);
    let mut common = Vec::new();
    let mut contacts = Vec::new();
    for edge in moved {
        let here = segment(edge);
        index.meeting(&widened(bounds_of(&here), least), |i| {
            let other = near[i as usize];
            let there = rest(&other);
            let is_twin = twin[edge.halfedge as usize] != CUT
                && twin[edge.halfedge as usize] == other.halfedge;
            let most = (3.0 * least).max(SAME * norm(sub(here[0], here[1])));
            if is_twin && lie_on_each_other(here, there, most) {
                common.push([*edge, other]);
            } else if segment_distance(here, there) < least {
                contacts.push([here, there]);
            }
        });
    }
    let joined: Vec<[f64; 2]> = common.iter().flat_map(|pair| rest(&pair[1])).collect();
    let is_joined = |p: [f64; 2]| joined.iter().any(|&q| norm(sub(p, q)) < 4.0 * least);
    let is_apart = contacts
        .iter()
        .all(|contact| meet_at(contact, least, &is_joined));
    is_apart.then_some(common)
}

fn lie_on_each_other([a, b]: Segment, [c, d]: Segment, most: f64) -> bool {
    norm(sub(a, d)) < most && norm(sub(b, c)) < most
}

/// Whether two segments that come near each other do so only at an end of both where the pieces are
/// joined.
fn meet_at(contact: &[Segment; 2], least: f64, is_joined: &dyn Fn([f64; 2]) -> bool) -> bool {
    let is_clear = |segment: Segment, other: Segment| {
        segment
            .iter()
            .all(|&p| is_joined(p) || segment_distance([p, p], other) >= least)
    };
    let [here, there] = *contact;
    is_clear(here, there) && is_clear(there, here)
}

fn norm(v: [f64; 2]) -> f64 {
    v[0].hypot(v[1])
}

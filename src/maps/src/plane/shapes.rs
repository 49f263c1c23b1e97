//! Distances and intersections of segments.

use super::box_index::{BoxIndex, Visit, search_budget};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of, widened};
use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::numerics::vec2::{dot, doubled_area, sub, way_from};

/// Ends of a straight line.
pub type Segment = [[f64; 2]; 2];

/// Returns the distance of two segments, rounded; 0 if they cross.
pub fn segment_distance(s: Segment, t: Segment) -> f64 {
    if cross(s, t) {
        return 0.0;
    }
    let of_ends = |s: Segment, t: Segment| {
        let [p, q] = s.map(|end| way_from(t, end));
        p[0].hypot(p[1]).min(q[0].hypot(q[1]))
    };
    of_ends(s, t).min(of_ends(t, s))
}

/// Returns whether each segment has the ends of the other on its two sides, exactly.
fn cross(s: Segment, t: Segment) -> bool {
    let parts = |s: Segment, t: Segment| {
        orient2d_sign(s[0], s[1], t[0]) * orient2d_sign(s[0], s[1], t[1]) < 0
    };
    parts(s, t) && parts(t, s)
}

/// Returns whether two segments have a common point, exactly.
pub(super) fn meet(s: Segment, t: Segment) -> bool {
    let ends = |s: Segment, t: Segment| s.iter().any(|&end| contains(t, end));
    cross(s, t) || ends(s, t) || ends(t, s)
}

/// Returns whether a point lies on a segment, including its ends, exactly.
fn contains([a, b]: Segment, p: [f64; 2]) -> bool {
    let is_between = |k: usize| (a[k].min(b[k])..=a[k].max(b[k])).contains(&p[k]);
    is_between(0) && is_between(1) && orient2d_sign(a, b, p) == 0
}

/// Returns whether the second of two segments, which begins where the first ends, runs back over it.
pub(super) fn turns_back(s: Segment, t: Segment) -> bool {
    orient2d_sign(s[0], s[1], t[1]) == 0 && dot(sub(s[1], s[0]), sub(t[1], t[0])) < 0.0
}

// Closed polygons.

/// Returns twice the signed area of a closed polygon, rounded.
pub fn doubled_polygon_area(polygon: &[[f64; 2]]) -> f64 {
    let after = polygon.iter().skip(1);
    let edges = polygon.iter().zip(after);
    edges.map(|(&p, &q)| doubled_area(polygon[0], p, q)).sum()
}

/// Returns a vertex near which closed polygons cross or touch themselves or each other, exactly; the first vertex of
/// the first such edge.
pub fn meeting_point(polygons: &[Vec<[f64; 2]>]) -> Option<[f64; 2]> {
    let (mut edges, mut next): (Vec<Segment>, Vec<u32>) = (Vec::new(), Vec::new());
    for polygon in polygons {
        let (first, n) = (edges.len(), polygon.len());
        edges.extend((0..n).map(|k| [polygon[k], polygon[(k + 1) % n]]));
        next.extend((0..n).map(|k| (first + (k + 1) % n) as u32));
    }
    let boxes: Vec<Bounds> = edges.iter().map(|edge| bounds_of(edge)).collect();
    let mut found: Option<u32> = None;
    let visit = BoxIndex::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
        let [a, b] = [i, j].map(|k| edges[k as usize]);
        let do_meet = if next[i as usize] == j {
            turns_back(a, b)
        } else if next[j as usize] == i {
            turns_back(b, a)
        } else {
            meet(a, b)
        };
        if do_meet {
            found = Some(found.unwrap_or(u32::MAX).min(i).min(j));
        }
    });
    // Only edges that lie in heaps exhaust the search; they would have to meet.
    let first = found.or((visit == Visit::Truncated).then_some(0));
    first.map(|edge| edges[edge as usize][0])
}

// Overlapping triangles.

type PlaneTriangle = [[f64; 2]; 3];

/// Visits every pair of counter-clockwise triangles with `is_asked` whose interiors have a common point, the smaller
/// number first; the search is truncated after [`search_budget`] comparisons.
pub fn overlapping_pairs(
    triangles: &[PlaneTriangle],
    is_asked: impl Fn([u32; 2]) -> bool,
    mut visit: impl FnMut([u32; 2]),
) -> Visit {
    let boxes: Vec<Bounds> = triangles.iter().map(|t| bounds_of(t)).collect();
    BoxIndex::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
        let pair = [i.min(j), i.max(j)];
        if is_asked(pair) && interiors_intersect(&triangles[i as usize], &triangles[j as usize]) {
            visit(pair);
        }
    })
}

/// Returns whether all triangles are counter-clockwise and no two have an interior point in common, exactly; `false`
/// also if the search was truncated.
pub fn are_disjoint(vertices: &[[f64; 2]], triangles: &[[u32; 3]]) -> bool {
    let triangles: Vec<PlaneTriangle> = triangles
        .iter()
        .map(|t: &[u32; 3]| t.map(|v| vertices[v as usize]))
        .collect();
    if !triangles
        .iter()
        .all(|&[a, b, c]: &PlaneTriangle| orient2d_sign(a, b, c) > 0)
    {
        return false;
    }
    let mut is_any = false;
    let visit = overlapping_pairs(&triangles, |_| true, |_| is_any = true);
    !is_any && visit == Visit::Complete
}

/// Returns whether two counter-clockwise triangles have interior points in common, exactly: this fails if and only
/// if the line of an edge of one has the other on its right or on itself.
pub fn interiors_intersect(a: &PlaneTriangle, b: &PlaneTriangle) -> bool {
    let is_beyond = |[p, q]: [[f64; 2]; 2], t: &PlaneTriangle| {
        t.iter().all(|&corner| orient2d_sign(p, q, corner) <= 0)
    };
    let is_apart = |[a, b, c]: PlaneTriangle, t: &PlaneTriangle| {
        [[a, b], [b, c], [c, a]]
            .into_iter()
            .any(|edge| is_beyond(edge, t))
    };
    !is_apart(*a, b) && !is_apart(*b, a)
}

// Axes of outlines.

/// Number of classes into which directions are sorted, over a quarter turn: half a degree each.
const CLASSES: usize = 180;

/// Shares of an outline along two perpendicular directions: from the first on a chart must be upright, from the second
/// on it is if the atlas stays about as full.
const UPRIGHT: f64 = 0.5;
const LEANING: f64 = 0.25;

/// Axes of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Straightness {
    /// Most of the outline runs along this unit vector or at a right angle to it, as for a rectangle.
    Upright([f64; 2]),
    /// A good part of the outline does: a third for a hexagon.
    Leaning([f64; 2]),
    /// The outline has no axes, like a disc.
    Round,
}

impl Straightness {
    /// Finds the axes of an outline that consists of these edges.
    pub fn of(edges: &[[[f64; 2]; 2]]) -> Self {
        match main_axis(edges) {
            Some((axis, share)) if share >= UPRIGHT => Self::Upright(axis),
            Some((axis, share)) if share >= LEANING => Self::Leaning(axis),
            _ => Self::Round,
        }
    }
}

/// Returns the unit vector along which, or at a right angle to which, most of an outline runs, and that share.
fn main_axis(edges: &[[[f64; 2]; 2]]) -> Option<([f64; 2], f64)> {
    let mut classes = vec![[0.0; 3]; CLASSES];
    // Add the length of each edge to its class, together with its direction.
    let mut perimeter = 0.0;
    for [p, q] in edges {
        let [x, y] = [q[0] - p[0], q[1] - p[1]];
        let length = x.hypot(y);
        if !length.is_normal() {
            continue;
        }
        // Four times the angle is the same for all four directions of a quarter turn.
        let [c, s] = squared(squared([x / length, y / length]));
        let turn = s.atan2(c).rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU;
        let class = &mut classes[(turn * CLASSES as f64) as usize % CLASSES];
        for (sum, x) in class.iter_mut().zip([length, length * c, length * s]) {
            *sum += x;
        }
        perimeter += length;
    }
    // A direction may lie at the border of two classes.
    // Take the longest pair of neighboring classes; its mean direction is the axis.
    let most = (0..CLASSES)
        .map(|i: usize| {
            let next = classes[(i + 1) % CLASSES];
            [0, 1, 2].map(|k| classes[i][k] + next[k])
        })
        .fold([0.0; 3], |best, of| if of[0] > best[0] { of } else { best });
    let [length, c, s] = most;
    let (sin, cos) = (s.atan2(c) / 4.0).sin_cos();
    (length > 0.0).then_some(([cos, sin], length / perimeter))
}

/// Returns the unit vector at twice the angle.
fn squared([c, s]: [f64; 2]) -> [f64; 2] {
    [c * c - s * s, 2.0 * c * s]
}

// Closed polygons that keep a distance from themselves and each other.

/// Least path between two edges along their polygon, as a multiple of the distance, for them to be compared: nearer
/// ones are close only because edges are short.
const BETWEEN: f64 = 4.0;

/// Returns whether no two edges of closed polygons, except consecutive ones, come nearer to each other than the share
/// `part` of the extent of all. O(n log n) unless the edges lie in heaps.
pub fn keep_apart(polygons: &[Vec<[f64; 2]>], part: f64) -> bool {
    let edges: Vec<PlaneEdge> = (polygons.iter().enumerate())
        .flat_map(|(polygon, vertices)| edges(polygon, vertices))
        .collect();
    let boxes: Vec<Bounds> = edges.iter().map(|edge| bounds_of(&edge.ends)).collect();
    let [low, high] = bounds_of(polygons.concat().as_slice());
    let least = part * (high[0] - low[0]).max(high[1] - low[1]);
    let index = BoxIndex::new(&boxes);
    (edges.iter().zip(0..)).all(|(edge, i)| {
        let mut is_near = false;
        index.meeting(&widened(boxes[i as usize], least), |j| {
            let other = &edges[j as usize];
            is_near |= j > i
                && edge.way_to(other) > BETWEEN * least
                && segment_distance(edge.ends, other.ends) < least;
        });
        !is_near
    })
}

struct PlaneEdge {
    ends: Segment,
    polygon: usize,
    /// Arc length of the polygon at each end.
    at: [f64; 2],
    length: f64,
}

impl PlaneEdge {
    /// Returns the length of the shorter path along the polygon to a later edge; infinite to another polygon.
    fn way_to(&self, later: &Self) -> f64 {
        if self.polygon != later.polygon {
            return f64::INFINITY;
        }
        let around = self.at[0] + self.length - later.at[1];
        (later.at[0] - self.at[1]).min(around)
    }
}

/// Returns the edges of a closed polygon.
fn edges(polygon: usize, vertices: &[[f64; 2]]) -> Vec<PlaneEdge> {
    let after = vertices.iter().cycle().skip(1);
    let ends: Vec<Segment> = vertices.iter().zip(after).map(|(&p, &q)| [p, q]).collect();
    let mut at = vec![0.0];
    for &[p, q] in &ends {
        let along = sub(q, p);
        at.push(at[at.len() - 1] + dot(along, along).sqrt());
    }
    (ends.iter().zip(at.windows(2)))
        .map(|(&ends, of_ends)| PlaneEdge {
            ends,
            polygon,
            at: [of_ends[0], of_ends[1]],
            length: at[at.len() - 1],
        })
        .collect()
}

//! Turns between handles that a map preserves.
//!
//! If a body is turned at one end and held at another, its elements share the turns. Turns beyond their capacity go
//! into a coil, or are lost where the body passes through itself: the elements stay valid, and the ends do not show the
//! loss. So turns are counted between the ends: the body is cut into thin slices, the rotation that best fits its
//! vertices is computed for each slice, and the turns relative to the slice before, at most half a turn each, are added
//! up about the axis. Slices are used, not elements, because elements away from the axis are sheared and thereby turned
//! aside.
//!
//! In the plane the count is exact. From one edge of a triangle to the next the map turns by the difference of two
//! angles between 0 and half a turn, as long as the triangle is not inverted, so the turns along any path of triangles
//! add up without ambiguity, however much they are sheared. A path across slices would lose half turns there.

use super::body::{Body, BodyElements};
use super::handles::Turned;
use super::problem::Problem;
use serde::{Deserialize, Serialize};
use std::collections::{HashMap, HashSet, VecDeque};
use unwrapd_method::numerics::rotation::{Rotation, best_rotation};
use unwrapd_method::numerics::square::{Matrix, times, transposed};

/// Turns that a handle asks for, and those that the map holds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Turns {
    /// The handle's place in the list.
    pub handle: usize,
    /// Turns of its disc relative to the nearest other handle.
    pub asked: f64,
    /// Number of those turns that the body between the two holds as its twist. Missing turns are in a coil, or lost.
    pub left: f64,
}

/// Turns below this many need no count: the ends show them, and a bar that bends a little lacks some twist.
const HALF: f64 = 0.5;

impl Turns {
    /// Returns whether half a turn or more is missing.
    pub fn are_lost(&self) -> bool {
        (self.asked - self.left).abs() >= HALF
    }
}

impl Problem {
    /// Returns the turns that a map preserves, for each disc that makes half a turn or more relative to the nearest
    /// other handle, along the path between them; costs some sweeps over the elements. Leaves out discs of too few
    /// vertices to have a direction, and discs without another handle that holds vertices.
    pub fn turns(&self, x: &[f64]) -> Vec<Turns> {
        let turns = self.turned.iter().filter_map(|turned| {
            let (left, end) = match &self.body.elements {
                BodyElements::Triangles { corners, .. } => self.planar_turns(turned, corners, x)?,
                BodyElements::Tetrahedra { .. } => self.turns_across_slices(turned, x)?,
            };
            Some(Turns {
                handle: turned.handle,
                asked: (turned.degrees - self.degrees_of(end, turned)) / 360.0,
                left,
            })
        });
        turns.filter(|t| t.asked.abs() >= HALF).collect()
    }

    /// Returns the turns of a disc relative to the nearest other handle, along a path of triangles between edges held
    /// by the two, and the vertex of the other handle.
    fn planar_turns(&self, turned: &Turned, corners: &[[u32; 3]], x: &[f64]) -> Option<(f64, u32)> {
        let Slices { slices, end } = self.slices(&turned.vertices, 4)?;
        let [first, last] = [slices.first()?, slices.last()?].map(|held| {
            let held: HashSet<u32> = held.iter().copied().collect();
            held
        });
        let path = path_of_edges(corners, &first, &last)?;
        let at = |x: &[f64], v: u32| [x[2 * v as usize], x[2 * v as usize + 1]];
        let direction = |x: &[f64], [a, b]: [u32; 2]| {
            let ([ax, ay], [bx, by]) = (at(x, a), at(x, b));
            [bx - ax, by - ay]
        };
        // Turn of the second edge relative to the first, at most half a turn.
        let between = |x: &[f64], edges: &[[u32; 2]]| {
            let [[a, b], [c, d]] = [edges[0], edges[1]].map(|edge| direction(x, edge));
            (a * d - b * c).atan2(a * c + b * d)
        };
        let angle: f64 = path
            .windows(2)
            .map(|edges: &[[u32; 2]]| between(x, edges) - between(&self.body.rest, edges))
            .sum();
        Some((-angle / std::f64::consts::TAU, end))
    }

    /// Returns the turns of a disc relative to the nearest other handle, added up from slice to slice, and a vertex of
    /// the other handle.
    fn turns_across_slices(&self, turned: &Turned, x: &[f64]) -> Option<(f64, u32)> {
        const D: usize = 3;
        let Slices { slices, end } = self.slices(&turned.vertices, 2 * D)?;
        let place = |x: &[f64], v: u32| std::array::from_fn(|k| x[D * v as usize + k]);
        let rotation = |slice: &Vec<u32>| {
            let pairs = slice
                .iter()
                .map(|&v| (place(&self.body.rest, v), place(x, v)));
            best_rotation::<D>(&pairs.collect::<Vec<_>>())
        };
        let mut last = rotation(slices.first()?)?;
        let mut angle = 0.0;
        // Skip slices without a direction.
        for next in slices[1..].iter().filter_map(rotation) {
            let between = times(&transposed(&next), &last).log();
            angle += Matrix::<D>::angle(&between, turned.axis);
            last = next;
        }
        Some((angle / std::f64::consts::TAU, end))
    }

    /// Returns the degrees by which a vertex held by another disc is turned about the axis of `turned`.
    fn degrees_of(&self, vertex: u32, turned: &Turned) -> f64 {
        let other = self
            .turned
            .iter()
            .find(|other| other.vertices.contains(&vertex));
        other.map_or(0.0, |other| {
            let cosine: f64 = (other.axis.iter().zip(turned.axis))
                .map(|(a, b)| a * b)
                .sum();
            other.degrees * if self.body.dim() == 2 { 1.0 } else { cosine }
        })
    }
}

/// Finds a path of edges from one between `first` vertices to one between `last` vertices, or with one of them if there
/// is none between them. Each edge shares a triangle with the one before.
fn path_of_edges(
    corners: &[[u32; 3]],
    first: &HashSet<u32>,
    last: &HashSet<u32>,
) -> Option<Vec<[u32; 2]>> {
    // Triangles of each edge.
    let sides = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
    let mut triangles_of: HashMap<[u32; 2], Vec<[u32; 3]>> = HashMap::new();
    for &triangle in corners {
        for [a, b] in sides(triangle) {
            let edge = [a.min(b), a.max(b)];
            triangles_of.entry(edge).or_default().push(triangle);
        }
    }
    // The first edge that `first` holds, and those that `last` holds both ends of, or else one.
    let is_held = |[a, b]: [u32; 2], held: &HashSet<u32>| held.contains(&a) && held.contains(&b);
    let mut edges: Vec<[u32; 2]> = triangles_of.keys().copied().collect();
    edges.sort_unstable();
    let begin = *edges.iter().find(|&&edge| is_held(edge, first))?;
    let goal: HashSet<[u32; 2]> = {
        let between = edges.iter().filter(|&&edge| is_held(edge, last));
        let between: HashSet<_> = between.copied().collect();
        if between.is_empty() {
            let with_one = edges
                .iter()
                .filter(|edge| edge.iter().any(|v| last.contains(v)));
            with_one.copied().collect()
        } else {
            between
        }
    };
    // Breadth-first search over edges of a common triangle.
    let mut before: HashMap<[u32; 2], [u32; 2]> = HashMap::from([(begin, begin)]);
    let mut queue = VecDeque::from([begin]);
    let end = loop {
        let edge = queue.pop_front()?;
        if goal.contains(&edge) {
            break edge;
        }
        for [a, b] in triangles_of[&edge].iter().flat_map(|&t| sides(t)) {
            let next = [a.min(b), a.max(b)];
            before.entry(next).or_insert_with(|| {
                queue.push_back(next);
                edge
            });
        }
    };
    // Trace the path back.
    let mut path = vec![end];
    while let Some(&edge) = before
        .get(&path[path.len() - 1])
        .filter(|&&edge| edge != path[path.len() - 1])
    {
        path.push(edge);
    }
    path.reverse();
    Some(path)
}

// Slices of a body between one of its handles and the nearest other one.

/// Vertices whose path between the two handles is longer than the shortest by this factor belong to limbs beside it.
const DETOUR: f64 = 1.5;

/// Difference below which places along the path, as shares of it, count as equal: the layers of a grid are not divided.
const SAME: f64 = 1e-9;

/// Slices of a body between two of its handles, in order.
struct Slices {
    /// Vertices of each slice; the first and the last are those of the handles.
    pub slices: Vec<Vec<u32>>,
    /// Vertex of the other handle that is nearest to the first.
    pub end: u32,
}

impl Problem {
    /// Cuts the body from these held vertices to the nearest ones held by another handle into slices as thin as `least`
    /// vertices per slice allow, by distances along edges at rest from both ends. Returns `None` if no others are held,
    /// or no edges lead to them.
    fn slices(&self, first: &[u32], least: usize) -> Option<Slices> {
        // Find the nearest vertex that another handle holds.
        let handles = self.stations.last()?;
        let grouped = handles.vertices.iter().zip(&handles.groups);
        let mut group_of: HashMap<u32, u32> = grouped.map(|(&v, &group)| (v, group)).collect();
        for v in first {
            group_of.remove(v);
        }
        let from_first = self.body.distances(first);
        let away = |v: u32| from_first[v as usize];
        let end = group_of
            .keys()
            .copied()
            .min_by(|a: &u32, b: &u32| away(*a).total_cmp(&away(*b)).then(a.cmp(b)))?;
        if !away(end).is_finite() {
            return None;
        }
        // Collect the vertices between the two handles, in the order of their share of the path.
        let last: Vec<u32> = handles
            .vertices
            .iter()
            .filter(|v: &&u32| group_of.get(v) == group_of.get(&end))
            .copied()
            .collect();
        let from_last = self.body.distances(&last);
        let mut between = Vec::new();
        for (v, (a, b)) in (0..).zip(from_first.iter().zip(&from_last)) {
            if *a > 0.0 && *b > 0.0 && a + b <= DETOUR * away(end) {
                between.push((a / (a + b), v));
            }
        }
        between.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
        // Slice them; the handles' own vertices are the first and the last slice.
        let mut slices = vec![first.to_vec()];
        slices.extend(sliced(&between, least));
        slices.push(last);
        Some(Slices { slices, end })
    }
}

/// Splits vertices in the order of their places into slices of at least `least` vertices, keeping equal places
/// together; the remainder joins the last slice.
fn sliced(places: &[(f64, u32)], least: usize) -> Vec<Vec<u32>> {
    let (mut slices, mut slice) = (Vec::<Vec<u32>>::new(), Vec::new());
    let mut last = f64::NEG_INFINITY;
    for &(place, v) in places {
        if slice.len() >= least && place > last + SAME {
            slices.push(std::mem::take(&mut slice));
        }
        slice.push(v);
        last = place;
    }
    match slices.last_mut() {
        Some(last) if slice.len() < least => last.extend(slice),
        _ => slices.push(slice),
    }
    slices
}

impl Body {
    /// Returns the distance of every vertex from these along edges at rest; infinite if there is no path. Sweeps over
    /// the elements until nothing changes.
    fn distances(&self, from: &[u32]) -> Vec<f64> {
        let dim = self.dim();
        let length = |a: u32, b: u32| {
            let [a, b] = [a, b].map(|v| &self.rest[dim * v as usize..dim * (v as usize + 1)]);
            a.iter()
                .zip(b)
                .map(|(a, b)| (a - b) * (a - b))
                .sum::<f64>()
                .sqrt()
        };
        let mut distance = vec![f64::INFINITY; self.n_vertices()];
        for &v in from {
            distance[v as usize] = 0.0;
        }
        // Sweep until no distance falls any more.
        let corners = self.corners();
        let mut has_changed = true;
        while std::mem::take(&mut has_changed) {
            for element in &corners {
                for &a in *element {
                    for &b in *element {
                        let by_a = distance[a as usize] + length(a, b);
                        if by_a < distance[b as usize] {
                            distance[b as usize] = by_a;
                            has_changed = true;
                        }
                    }
                }
            }
        }
        distance
    }
}

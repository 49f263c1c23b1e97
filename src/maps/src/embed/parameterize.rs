//! The optimized map of a disk in space.

use super::hierarchy::coarse_to_fine;
use super::problem::{Embedding, MapProblem, Options, Pins, far_pair, pair_distance};
use super::rest::{RestShapes, rest_shapes};
use super::tutte::{
    BoundarySpacing, ClosedDisk, first_bad_triangle, is_positive, outer_loop, tutte,
    tutte_embedding,
};
use crate::mesh::{CUT, Disk, next, origin};
use crate::plane::keep_apart;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use unwrapd_method::energy::prefers_a_size;
use unwrapd_method::numerics::vec3::distance;
use unwrapd_method::numerics::vec3::{area_vector, cross, dot, norm, sub};
use unwrapd_method::solver::{Iterate, Objective, Status, Watch};

/// Number of triangles from which the start is found coarse to fine, which costs less than the Newton steps that it
/// saves. When the number fell from 20,000 to 1,000, bimba_11k came within 1 % of the lowest energy in half the time
/// (`tests/bench/slim.py`).
const LARGE: usize = 1_000;

/// Energy per triangle of a Tutte map that is too far from any optimum. With symmetric Dirichlet, ordinary disks start
/// at 4 to 80, those with long arms at 2e4 to 2e10: from there Newton's method takes hundreds of steps, or ends a
/// millionfold above the optimum.
const FAR: f64 = 200.0;

/// A triangle of the start is flipped or empty, so no path from it is free of flips.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InvalidStart {
    /// The number of positions is not the number of vertices.
    #[error("there are {0} positions for {1} vertices")]
    Length(usize, usize),
    /// This triangle is not positive.
    #[error("triangle {0} of the start is flipped or degenerate")]
    NotPositive(usize),
}

/// Maps a disk into the plane: finds a valid start, then the minimum of the energy to which Newton's method leads from
/// it.
///
/// `positions` holds one finite position per vertex of the disk.
pub fn parameterize(
    disk: &Disk,
    positions: &[[f64; 3]],
    options: &Options,
    watch: &dyn Watch,
) -> Embedding {
    let problem = MapProblem {
        disk,
        rest: rest_shapes(positions, &disk.triangles).weighted(&options.weights),
        options,
    };
    match options.pins {
        Pins::None => {
            let (start, objective) = first_map_and_objective(&problem, positions);
            problem.minimized(objective, start, &[], watch)
        }
        Pins::Two => {
            let (start, pinned) = pinned_map(&problem, positions, watch);
            problem.minimized(problem.objective(&start), start, &pinned, watch)
        }
    }
}

/// Returns the first map and the objective to minimize from it.
fn first_map_and_objective(
    problem: &MapProblem,
    positions: &[[f64; 3]],
) -> (Vec<[f64; 2]>, Objective) {
    if problem.disk.triangles.len() >= LARGE && rayon::current_num_threads() > 1 {
        return problem.objective_beside(|| first_map(problem, positions));
    }
    let start = first_map(problem, positions);
    let objective = problem.objective(&start);
    (start, objective)
}

/// Returns the disk as it lies if it is flat, or unrolled if possible; otherwise, at its best size, Tutte's map if that
/// is near enough to an optimum, or the one found coarse to fine.
fn first_map(problem: &MapProblem, positions: &[[f64; 3]]) -> Vec<[f64; 2]> {
    let isometric =
        flat_map(problem.disk, positions).or_else(|| unfolded_map(problem.disk, positions));
    if let Some(uv) = isometric {
        let uv = problem.scaled(&uv, 1.0 / problem.rest.scale);
        if problem.mean_energy(&uv) <= FAR {
            return uv;
        }
    }
    let coarse_to_fine = || {
        hierarchical_start_at(problem.disk, positions, &problem.rest)
            .map(|uv| problem.at_best_size(&uv))
    };
    if problem.disk.triangles.len() >= LARGE
        && let Some(uv) = coarse_to_fine()
    {
        return uv;
    }
    let uv = problem.at_best_size(&start(problem.disk, positions));
    let energy = problem.mean_energy(&uv);
    if energy <= FAR {
        return uv;
    }
    coarse_to_fine()
        .filter(|other| problem.mean_energy(other) < energy)
        .unwrap_or(uv)
}

/// Returns Tutte's map and its two pins, at the size at which they are as far apart as in a nearly isometric map; that
/// map itself if Tutte's is too far from any optimum, or the watcher wants to stop.
fn pinned_map(
    problem: &MapProblem,
    positions: &[[f64; 3]],
    watch: &dyn Watch,
) -> (Vec<[f64; 2]>, [u32; 2]) {
    let boundary = &problem.disk.loops[outer_loop(problem.disk, positions)];
    let tutte = problem.at_rest_size(&start(problem.disk, positions));
    let Some((near, is_hurried)) = nearly_isometric(problem, positions, watch) else {
        let pins = far_pair(boundary, &tutte);
        return (tutte, pins);
    };
    let pins = far_pair(boundary, &near);
    let uv = problem.scaled(
        &tutte,
        pair_distance(&near, pins) / pair_distance(&tutte, pins),
    );
    let energy = problem.mean_energy(&uv);
    if !is_hurried && (energy <= FAR || problem.mean_energy(&near) >= energy) {
        (uv, pins)
    } else {
        (near, pins)
    }
}

/// Returns the optimum without pins of an energy that prefers a size, so that pins taken from it cost nothing; for
/// another energy, the map found coarse to fine. Also returns whether the watcher wants to stop.
fn nearly_isometric(
    problem: &MapProblem,
    positions: &[[f64; 3]],
    watch: &dyn Watch,
) -> Option<(Vec<[f64; 2]>, bool)> {
    if !prefers_a_size(&*problem.options.density) {
        return hierarchical_start_at(problem.disk, positions, &problem.rest)
            .map(|near| (near, false));
    }
    let unshown = |iterate: &Iterate| watch.iterate(iterate);
    let (start, objective) = first_map_and_objective(problem, positions);
    let (near, summary) = problem.minimum(objective, start, &[], &unshown);
    Some((near, summary.status == Status::Stopped))
}

/// Minimizes from a given map, in any unit: it is first scaled to the best size. [`Options::pins`] are ignored.
///
/// # Errors
/// If the start is not positive in every triangle; checked exactly.
pub fn optimize(
    disk: &Disk,
    positions: &[[f64; 3]],
    start: &[[f64; 2]],
    options: &Options,
    watch: &dyn Watch,
) -> Result<Embedding, InvalidStart> {
    let (problem, start) = from_given(disk, positions, start, options)?;
    Ok(problem.minimized(problem.objective(&start), start, &[], watch))
}

/// Returns the problem of a disk with a given map, and this map at its best size.
///
/// # Errors
/// As [`optimize`].
pub(super) fn from_given<'a>(
    disk: &'a Disk,
    positions: &[[f64; 3]],
    start: &[[f64; 2]],
    options: &'a Options,
) -> Result<(MapProblem<'a>, Vec<[f64; 2]>), InvalidStart> {
    if start.len() != disk.n_vertices {
        return Err(InvalidStart::Length(start.len(), disk.n_vertices));
    }
    if let Some(triangle) = first_bad_triangle(&disk.triangles, start) {
        return Err(InvalidStart::NotPositive(triangle));
    }
    let problem = MapProblem {
        disk,
        rest: rest_shapes(positions, &disk.triangles).weighted(&options.weights),
        options,
    };
    let start = problem.at_best_size(start);
    Ok((problem, start))
}

// The map of a disk that lies in a plane.

/// Largest distance of vertices from the plane, as a share of the disk's extent: the rounding of coordinates in `f32`.
const FLAT: f64 = 1e-6;

/// Least distance of the boundary from itself, as a share of the disk's extent: a few times the rounding of coordinates
/// in `f32`. A disk that comes nearer, such as a slit one, must be opened: rounding would close it.
const APART: f64 = 2e-7;

/// Returns the disk as it lies, in its own unit, seen from the side from which its triangles are counter-clockwise;
/// `None` if it is not flat, a triangle is flipped or empty there, or the boundary touches itself.
///
/// No other map has less distortion, and long arms, where Tutte's map is far from any optimum, cost nothing.
fn flat_map(disk: &Disk, positions: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    let origin = *positions.first()?;
    let reach = (positions.iter())
        .flat_map(|&p| sub(p, origin).map(f64::abs))
        .fold(0.0, f64::max);
    if !reach.is_normal() {
        return None;
    }
    let relative: Vec<[f64; 3]> = (positions.iter())
        .map(|&p| sub(p, origin).map(|x| x / reach))
        .collect();
    let normal = normal(disk, &relative)?;
    if relative.iter().any(|&p| dot(p, normal).abs() > FLAT) {
        return None;
    }
    let [u, v] = axes(normal);
    let uv: Vec<[f64; 2]> = relative.iter().map(|&p| [dot(p, u), dot(p, v)]).collect();
    if !is_positive(&disk.triangles, &uv) || !keep_apart(&disk.boundary_in(&uv), APART) {
        return None;
    }
    Some(uv.into_iter().map(|p| p.map(|x| reach * x)).collect())
}

/// Returns the unit normal of most of the area.
fn normal(disk: &Disk, positions: &[[f64; 3]]) -> Option<[f64; 3]> {
    let mut sum = [0.0; 3];
    for triangle in &disk.triangles {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        let area = area_vector(a, b, c);
        (0..3).for_each(|k| sum[k] += area[k]);
    }
    let length = norm(sum);
    length.is_normal().then(|| sum.map(|x| x / length))
}

/// Returns two unit vectors that form a right-handed frame with a third.
fn axes(normal: [f64; 3]) -> [[f64; 3]; 2] {
    let least = (0..3).min_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()));
    let mut axis = [0.0; 3];
    axis[least.unwrap_or(0)] = 1.0;
    let u = cross(axis, normal);
    let length = norm(u);
    let u = u.map(|x| x / length);
    [u, cross(normal, u)]
}

// A start without flips.

/// Returns a locally injective map of the disk: counter-clockwise and positive in every triangle, exactly.
///
/// Returns Tutte's map if floating point allows, otherwise that of the hierarchy. Holes are closed first. Size and
/// distortion are arbitrary. If both fail, as for a few disks with hundreds of empty triangles, returns Tutte's map as
/// floating point left it: a caller that needs a valid map checks it again ([`is_positive`]) and
/// cuts the disk.
pub fn start(disk: &Disk, positions: &[[f64; 3]]) -> Vec<[f64; 2]> {
    tutte_start(disk, positions)
        .or_else(|| hierarchical_start(disk, positions))
        .unwrap_or_else(|| {
            let closed = ClosedDisk::new(disk, positions);
            let mut uv = tutte_embedding(&closed, BoundarySpacing::ArcLength);
            uv.truncate(disk.n_vertices);
            uv
        })
}

/// Returns Tutte's map, if floating point left every triangle positive, including those that close the holes.
pub fn tutte_start(disk: &Disk, positions: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    let mut uv = tutte(&ClosedDisk::new(disk, positions))?;
    uv.truncate(disk.n_vertices);
    Some(uv)
}

/// Returns a map found coarse to fine. It takes longer than Tutte's but ends near an optimum, in the unit of
/// [`rest_shapes`], and hardly ever fails.
pub fn hierarchical_start(disk: &Disk, positions: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    hierarchical_start_at(disk, positions, &rest_shapes(positions, &disk.triangles))
}

/// Like [`hierarchical_start`], with known rest shapes.
fn hierarchical_start_at(
    disk: &Disk,
    positions: &[[f64; 3]],
    rest: &RestShapes,
) -> Option<Vec<[f64; 2]>> {
    let closed = ClosedDisk::new(disk, positions);
    let relative: Vec<[f64; 3]> = (closed.positions.iter())
        .map(|p| p.map(|x| x / rest.scale))
        .collect();
    let mut uv = coarse_to_fine(&closed, &relative, rest.least)?;
    uv.truncate(disk.n_vertices);
    Some(uv)
}

// The map of a developable disk.

/// Largest change of lengths, as a share of the disk's extent: the rounding of coordinates in `f32` along a path of a
/// hundred triangles.
const SAME: f64 = 1e-5;

/// Least distance of the boundary from itself, as a share of the disk's extent: nearer parts could touch once
/// coordinates are rounded to `f32`.
const UNFOLDED_APART: f64 = 1e-6;

/// Unrolls the disk into the plane, in its own unit; returns `None` if that changes the length of an edge, or the
/// boundary meets itself.
///
/// Triangles are laid down one after the other, each next to one that lies already, across long edges first. A
/// cylinder, a cone or a bent sheet comes out without distortion. O(n log n).
fn unfolded_map(disk: &Disk, positions: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    let uv = laid_down(disk, positions)?;
    let at = |v: u32| positions[v as usize];
    let longest = (disk.triangles.iter())
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| (a, b, distance(at(a), at(b))));
    let [low, high] = unwrapd_method::numerics::bounds::bounds_of(&uv);
    let extent = (high[0] - low[0]).max(high[1] - low[1]);
    let mut edges = longest;
    let is_isometric = edges.all(|(a, b, length): (u32, u32, f64)| {
        let [p, q] = [a, b].map(|v| uv[v as usize]);
        ((q[0] - p[0]).hypot(q[1] - p[1]) - length).abs() <= SAME * extent
    });
    let is_map = is_isometric
        && is_positive(&disk.triangles, &uv)
        && keep_apart(&disk.boundary_in(&uv), UNFOLDED_APART);
    is_map.then_some(uv)
}

/// An edge across which the next triangle may be laid, the longest first.
#[derive(PartialEq)]
struct Crossing {
    length: f64,
    halfedge: u32,
}

/// Returns the places of all vertices; a vertex with several keeps the one where it was laid first.
fn laid_down(disk: &Disk, positions: &[[f64; 3]]) -> Option<Vec<[f64; 2]>> {
    let twin = disk.twins();
    let mut uv: Vec<Option<[f64; 2]>> = vec![None; disk.n_vertices];
    let mut is_laid = vec![false; disk.triangles.len()];
    let mut open = BinaryHeap::new();
    // Lay the longest edge along the first axis.
    let longest = (0..3 * disk.triangles.len() as u32)
        .map(|h| (length(disk, positions, h), h))
        .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
    let (length_of_first, first) = longest?;
    uv[origin(&disk.triangles, first) as usize] = Some([0.0, 0.0]);
    uv[origin(&disk.triangles, next(first)) as usize] = Some([length_of_first, 0.0]);
    let mut halfedge = first;
    // Lay one triangle after another, across the longest open edge first.
    loop {
        if !std::mem::replace(&mut is_laid[halfedge as usize / 3], true) {
            lay(disk, positions, halfedge, &mut uv)?;
            for h in [next(halfedge), next(next(halfedge)), halfedge] {
                let t = twin[h as usize];
                if t != CUT && !is_laid[t as usize / 3] {
                    open.push(Crossing {
                        length: length(disk, positions, t),
                        halfedge: t,
                    });
                }
            }
        }
        match open.pop() {
            Some(crossing) => halfedge = crossing.halfedge,
            None => break,
        }
    }
    uv.into_iter().collect()
}

/// Lays the last vertex of a triangle whose edge lies already.
fn lay(
    disk: &Disk,
    positions: &[[f64; 3]],
    halfedge: u32,
    uv: &mut [Option<[f64; 2]>],
) -> Option<()> {
    let corners = [halfedge, next(halfedge), next(next(halfedge))];
    let [a, b, c] = corners.map(|h| origin(&disk.triangles, h) as usize);
    if uv[c].is_some() {
        return Some(());
    }
    let (p, q) = (uv[a]?, uv[b]?);
    let (along, to) = (
        sub(positions[b], positions[a]),
        sub(positions[c], positions[a]),
    );
    let length = norm(along);
    let x = dot(along, to) / length;
    let y = 2.0 * norm(area_vector(positions[a], positions[b], positions[c])) / length;
    let e = [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
    let place = [p[0] + x * e[0] - y * e[1], p[1] + x * e[1] + y * e[0]];
    uv[c] = place.iter().all(|x| x.is_finite()).then_some(place);
    uv[c].map(|_| ())
}

fn length(disk: &Disk, positions: &[[f64; 3]], h: u32) -> f64 {
    let [a, b] = [h, next(h)].map(|h| positions[origin(&disk.triangles, h) as usize]);
    distance(a, b)
}

impl Eq for Crossing {}

impl Ord for Crossing {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.length.total_cmp(&other.length)).then_with(|| other.halfedge.cmp(&self.halfedge))
    }
}

impl PartialOrd for Crossing {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

//! The optimized map of a disk in space.

use super::closed::outer_loop;
use super::options::{Embedding, Options};
use super::pins::{Pins, distance, far_pair};
use super::positive::{first_bad_triangle, is_positive};
use super::problem::Problem;
use super::rest::rest_shapes;
use super::start::{hierarchical_start_at, start};
use super::unfolded::unfolded_map;
use crate::mesh::Disk;
use crate::plane::keep_apart;
use unwrapd_method::energy::prefers_a_size;
use unwrapd_method::numerics::vec3::{area_vector, cross, dot, norm, sub};
use unwrapd_method::solver::{Iterate, Objective, Status, Watch};

/// Number of triangles from which the start is found coarse to fine, which costs less than the Newton steps that it
/// saves. When the number fell from 20,000 to 1,000, bimba_11k came within 1 % of the lowest energy in half the time
/// (`tests/bench/slim.py`).
const LARGE: usize = 1_000;

/// Energy per triangle of a Tutte map that is too far from any optimum. Ordinary disks start at 1 to 40, those with
/// long arms at 1e4 to 1e10: from there Newton's method takes hundreds of steps, or ends a millionfold above the
/// optimum.
const FAR: f64 = 100.0;

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
    let problem = Problem {
        disk,
        rest: rest_shapes(positions, &disk.triangles),
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
    problem: &Problem,
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
fn first_map(problem: &Problem, positions: &[[f64; 3]]) -> Vec<[f64; 2]> {
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
    problem: &Problem,
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
    let uv = problem.scaled(&tutte, distance(&near, pins) / distance(&tutte, pins));
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
    problem: &Problem,
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
    if start.len() != disk.n_vertices {
        return Err(InvalidStart::Length(start.len(), disk.n_vertices));
    }
    if let Some(triangle) = first_bad_triangle(&disk.triangles, start) {
        return Err(InvalidStart::NotPositive(triangle));
    }
    let problem = Problem {
        disk,
        rest: rest_shapes(positions, &disk.triangles),
        options,
    };
    let start = problem.at_best_size(start);
    Ok(problem.minimized(problem.objective(&start), start, &[], watch))
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

//! From a disk in space to its optimized map.

use super::rest::{RestShapes, rest_shapes};
use super::start::{first_bad_triangle, start};
use crate::barrier::{BarrierKind, MapEnergy, epsilon, map_energy};
use crate::energy::EnergyKind;
use crate::mesh::Disk;
use crate::numerics::vec2::doubled_area;
use crate::solver::{Objective, Settings, Summary, Watch, best_scale, minimize};

/// What is minimized, and how far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The density.
    pub energy: EnergyKind,
    /// The barrier; without one [`EnergyKind::Arap`] and [`EnergyKind::Lscm`] may flip triangles.
    pub barrier: BarrierKind,
    /// β, the barrier's strength, when the mean rest area is 1.
    pub beta: f64,
    /// s, the share of its rest area below which a triangle feels the barrier.
    pub s: f64,
    /// When to stop.
    pub solver: Settings,
}

impl Default for Options {
    /// ARAP with the inverse-spline barrier, β = 0.01, s = 1.
    fn default() -> Self {
        Self {
            energy: EnergyKind::default(),
            barrier: BarrierKind::default(),
            beta: 0.01,
            s: 1.0,
            solver: Settings::default(),
        }
    }
}

/// A map of a disk and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedding {
    /// One position per vertex, in the mesh's unit of length, counter-clockwise; the sum of the areas in the plane is
    /// that of the triangles in space (of their rest shapes, if none has an area).
    pub uv: Vec<[f64; 2]>,
    /// Energies in it are for a mean rest area of 1.
    pub summary: Summary,
}

/// A triangle of the start is flipped or empty, so there is no way from it that never flips.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InvalidStart {
    /// The number of positions is not the number of vertices.
    #[error("{0} positions for {1} vertices")]
    Length(usize, usize),
    /// This triangle is not positive.
    #[error("triangle {0} is flipped or empty in the start")]
    NotPositive(usize),
}

/// Maps a disk into the plane: a valid start, then the minimum of the energy that Newton's method finds from it.
///
/// `positions` holds one finite position per vertex of the disk.
pub fn parameterize(
    disk: &Disk,
    positions: &[[f64; 3]],
    options: &Options,
    watch: &dyn Watch,
) -> Embedding {
    let rest = rest_shapes(positions, &disk.triangles);
    let uv = start(disk, positions);
    improved(disk, &rest, &uv, options, watch)
}

/// Minimizes from a given map, in any unit: it is scaled to the best size first.
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
    let rest = rest_shapes(positions, &disk.triangles);
    Ok(improved(disk, &rest, start, options, watch))
}

fn improved(
    disk: &Disk,
    rest: &RestShapes,
    start: &[[f64; 2]],
    options: &Options,
    watch: &dyn Watch,
) -> Embedding {
    let start = with_best_size(disk, rest, start, options);
    let term = map_energy(
        &disk.triangles,
        &rest.shapes,
        &energy_at(disk, rest, &start, options),
    );
    let mut objective = Objective::new(disk.n_vertices, term);
    let mut x: Vec<f64> = start.as_flattened().to_vec();
    let summary = minimize(&mut objective, &mut x, &options.solver, watch);
    let mut uv: Vec<[f64; 2]> = x.as_chunks().0.to_vec();
    // The solver keeps areas above ε in floating point; the promise is about the exact sign.
    if options.barrier == BarrierKind::InverseSpline
        && first_bad_triangle(&disk.triangles, &uv).is_some()
    {
        uv = start;
    }
    Embedding {
        uv: in_mesh_unit(disk, rest, &uv),
        summary,
    }
}

/// The start at the size of lowest energy.
///
/// Where rounding would empty a triangle, the nearest power of 2 scales it, which is exact.
fn with_best_size(
    disk: &Disk,
    rest: &RestShapes,
    start: &[[f64; 2]],
    options: &Options,
) -> Vec<[f64; 2]> {
    // To a mean area of 1: the search then starts near its end, whatever unit the start was in.
    let area = total_area(&disk.triangles, start);
    let rough = power_of_two((disk.triangles.len() as f64 / area).sqrt());
    let start = scaled(start, rough);
    // The domain grows as ε falls; for the search there is none.
    let parameters = MapEnergy {
        epsilon: 0.0,
        ..energy_at(disk, rest, &start, options)
    };
    let term = map_energy(&disk.triangles, &rest.shapes, &parameters);
    let best = best_scale(&*term, start.as_flattened());
    let exact = scaled(&start, best);
    if first_bad_triangle(&disk.triangles, &exact).is_none() {
        exact
    } else {
        scaled(&start, power_of_two(best))
    }
}

fn scaled(uv: &[[f64; 2]], factor: f64) -> Vec<[f64; 2]> {
    uv.iter().map(|p| p.map(|x| x * factor)).collect()
}

fn power_of_two(factor: f64) -> f64 {
    factor.log2().round().exp2()
}

/// The energy with the ε that this start asks for.
fn energy_at(disk: &Disk, rest: &RestShapes, start: &[[f64; 2]], options: &Options) -> MapEnergy {
    let smallest_rest = rest
        .shapes
        .iter()
        .map(|shape| shape.area)
        .fold(f64::INFINITY, f64::min);
    let smallest_start = (disk.triangles.iter())
        .map(|t| signed_area(t, start))
        .fold(f64::INFINITY, f64::min);
    MapEnergy {
        energy: options.energy,
        barrier: options.barrier,
        beta: options.beta,
        s: options.s,
        epsilon: epsilon(smallest_rest, smallest_start),
    }
}

fn signed_area(triangle: &[u32; 3], uv: &[[f64; 2]]) -> f64 {
    let [a, b, c] = triangle.map(|v| uv[v as usize]);
    0.5 * doubled_area(a, b, c)
}

fn total_area(triangles: &[[u32; 3]], uv: &[[f64; 2]]) -> f64 {
    triangles.iter().map(|t| signed_area(t, uv)).sum()
}

/// The map at the size at which its area is that of the surface.
fn in_mesh_unit(disk: &Disk, rest: &RestShapes, uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let wanted = if rest.true_area > 0.0 {
        rest.true_area
    } else {
        rest.area
    };
    let area = total_area(&disk.triangles, uv).abs().max(f64::MIN_POSITIVE);
    let factor = (wanted / area).sqrt();
    let exact = scaled(uv, factor);
    if first_bad_triangle(&disk.triangles, &exact).is_none() {
        exact
    } else {
        scaled(uv, power_of_two(factor))
    }
}

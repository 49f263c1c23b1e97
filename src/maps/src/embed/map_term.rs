//! The energy of maps of some triangles.

use super::options::Options;
use unwrapd_method::barrier::{Barrier, MapEnergy, epsilon, map_energy};
use unwrapd_method::energy::{RestShape, Term};
use unwrapd_method::numerics::vec2::doubled_area;

/// Creates the energy of maps of triangles with these rest shapes, in their unit, with the ε that a start requires.
pub fn map_term(
    triangles: &[[u32; 3]],
    rest: &[RestShape],
    start: &[[f64; 2]],
    options: &Options,
) -> Box<dyn Term> {
    let smallest = |sizes: &mut dyn Iterator<Item = f64>| sizes.fold(f64::INFINITY, f64::min);
    let smallest_rest = smallest(&mut rest.iter().map(|shape| shape.size));
    let smallest_start = smallest(&mut triangles.iter().map(|t| signed_area(t, start)));
    let epsilon = epsilon(smallest_rest, smallest_start);
    map_term_with(triangles, rest, epsilon, options)
}

/// Like [`map_term`], with a given ε.
pub(super) fn map_term_with(
    triangles: &[[u32; 3]],
    rest: &[RestShape],
    epsilon: f64,
    options: &Options,
) -> Box<dyn Term> {
    let parameters = MapEnergy {
        energy: options.energy,
        barrier: Barrier {
            kind: options.barrier,
            beta: options.beta,
            s: options.s,
            epsilon,
        },
    };
    map_energy(triangles, rest, &parameters)
}

/// Returns the area of a triangle in a map; negative if it is flipped.
pub(super) fn signed_area(triangle: &[u32; 3], uv: &[[f64; 2]]) -> f64 {
    let [a, b, c] = triangle.map(|v| uv[v as usize]);
    0.5 * doubled_area(a, b, c)
}

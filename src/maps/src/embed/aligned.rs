//! Maps some of whose edges run along the axes.

use super::parameterize::{InvalidStart, from_given};
use super::problem::{Embedding, Options};
use super::tutte::first_bad_triangle;
use crate::mesh::Disk;
use unwrapd_method::energy::{AlignedEdge, Alignment, Term};
use unwrapd_method::solver::{Continued, Objective, Status, Watch, minimize};

/// Strengths of the alignment beside an energy of about 4 per mean triangle, one minimization each. At the last one, α, an edge that the
/// energy pulls with a force of 1 deviates by 1/(2 α) = 5e-7 radians. The steps of 100 are not tuned.
const STRENGTHS: [f64; 4] = [1.0, 1e2, 1e4, 1e6];

/// Least length of an edge that is aligned, in the unit of the rest shapes: shorter ones would outweigh all others.
const SHORTEST: f64 = 1e-3;

/// Minimizes from a given map, in any unit, while some edges turn to the axes: those between the two vertices of each pair, whose
/// ends are to share a coordinate.
///
/// The edges pull more and more strongly; each minimization starts from the map of the one before, so no triangle ever flips.
///
/// # Errors
/// If the start is not positive in every triangle; checked exactly. Returns the start if rounding spoils the result.
pub fn aligned(
    disk: &Disk,
    positions: &[[f64; 3]],
    start: &[[f64; 2]],
    edges: &[([u32; 2], usize)],
    options: &Options,
    watch: &dyn Watch,
) -> Result<Embedding, InvalidStart> {
    let (problem, start) = from_given(disk, positions, start, options)?;
    let edges: Vec<AlignedEdge> = (edges.iter())
        .map(|&([a, b], coordinate)| {
            let [p, q] = [a, b].map(|v| start[v as usize]);
            AlignedEdge {
                vertices: [a.min(b), a.max(b)],
                coordinate,
                length: (q[0] - p[0]).hypot(q[1] - p[1]).max(SHORTEST),
            }
        })
        .collect();
    let terms = |alpha: f64| -> Vec<Box<dyn Term>> {
        let edges = edges.clone();
        vec![problem.term(&start), Box::new(Alignment { edges, alpha })]
    };
    let mut objective = Objective::of_terms(disk.n_vertices, terms(STRENGTHS[0]));
    let settings = problem.settings();
    let mut x: Vec<f64> = start.as_flattened().to_vec();
    let mut summary = minimize(&mut objective, &mut x, &settings, watch);
    for alpha in &STRENGTHS[1..] {
        if summary.status == Status::Stopped {
            break;
        }
        objective.exchange(terms(*alpha));
        let counted = Continued {
            watch,
            before: summary.iterations,
        };
        let next = minimize(&mut objective, &mut x, &settings, &counted);
        summary = summary.followed_by(&next);
    }
    let mut uv: Vec<[f64; 2]> = x.as_chunks().0.to_vec();
    if first_bad_triangle(&disk.triangles, &uv).is_some() {
        uv = start;
    }
    Ok(Embedding {
        uv: problem.in_mesh_unit(&uv),
        summary,
    })
}

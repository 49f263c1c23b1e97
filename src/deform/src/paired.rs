//! Handles paired with their targets.

use std::cmp::Ordering;

use super::problem_error::ProblemError;
use unwrapd_method::energy::Row;
use unwrapd_method::solver::Handles;

/// Pairs vertices with their targets, each vertex once.
pub(super) fn handles(
    dim: usize,
    vertices: &[u32],
    targets: &[Vec<f64>],
    groups: &[u32],
) -> Result<Handles, ProblemError> {
    if vertices.len() != targets.len() {
        return Err(ProblemError::Unpaired {
            handles: vertices.len(),
            targets: targets.len(),
        });
    }
    let is_bad = |t: &Vec<f64>| t.len() != dim || !t.iter().all(|x| x.is_finite());
    if let Some(handle) = targets.iter().position(is_bad) {
        return Err(ProblemError::BadTarget { handle, dim });
    }
    // Sort by vertex, and keep each vertex once. Its targets must be equal.
    let mut order: Vec<usize> = (0..vertices.len()).collect();
    order.sort_by_key(|&i| vertices[i]);
    let same = |w: &&[usize]| vertices[w[0]] == vertices[w[1]] && targets[w[0]] != targets[w[1]];
    if let Some(pair) = order.windows(2).find(same) {
        let vertex = vertices[pair[0]];
        return Err(ProblemError::ContradictoryHandles { vertex });
    }
    order.dedup_by_key(|i| vertices[*i]);
    Ok(Handles {
        vertices: order.iter().map(|&i| vertices[i]).collect(),
        targets: order.iter().flat_map(|&i| targets[i].clone()).collect(),
        groups: order.iter().map(|&i| groups[i]).collect(),
        ..Handles::default()
    })
}

/// Adds points inside elements to handles; all targets of one point must be equal.
pub(super) fn with_points(
    handles: Handles,
    points: Vec<Row>,
    point_targets: Vec<f64>,
) -> Result<Handles, ProblemError> {
    let dim = point_targets.len() / points.len().max(1);
    let target = |i: usize| &point_targets[dim * i..dim * (i + 1)];
    let mut order: Vec<usize> = (0..points.len()).collect();
    // Weights are finite.
    order.sort_by(|&i, &j| points[i].partial_cmp(&points[j]).unwrap_or(Ordering::Equal));
    let contradict = |w: &[usize]| points[w[0]] == points[w[1]] && target(w[0]) != target(w[1]);
    if order.windows(2).any(contradict) {
        return Err(ProblemError::ContradictoryPoints);
    }
    Ok(Handles {
        points,
        point_targets,
        ..handles
    })
}

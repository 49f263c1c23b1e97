//! Point location: the element that contains a point.

use super::body::Body;
use unwrapd_method::energy::Row;
use unwrapd_method::numerics::square::{Matrix, Square, apply, transposed};

/// Share of an element by which points on an edge between two elements may lie outside both.
const ROUNDING: f64 = 1e-9;

/// Finds the element at rest that contains a point and returns the point's barycentric coordinates; the first if there
/// are several.
pub(super) fn locate<const D: usize>(body: &Body, at: [f64; D]) -> Option<Row>
where
    Matrix<D>: Square<D>,
{
    let place = |v: u32| -> [f64; D] { std::array::from_fn(|k| body.rest[D * v as usize + k]) };
    for element in body.corners() {
        let origin = place(element[0]);
        let edges: Matrix<D> = std::array::from_fn(|k| {
            let corner = place(element[k + 1]);
            std::array::from_fn(|c| corner[c] - origin[c])
        });
        let arm: [f64; D] = std::array::from_fn(|k| at[k] - origin[k]);
        if !is_within_reach(&edges, &arm) {
            continue;
        }
        let inverse = transposed(&edges.inverse(edges.det()));
        let others = apply(&inverse, &arm);
        let first = 1.0 - others.iter().sum::<f64>();
        if first >= -ROUNDING && others.iter().all(|&w| w >= -ROUNDING) {
            let weights = std::iter::once(first).chain(others);
            let mut row: Row = element.iter().copied().zip(weights).collect();
            row.sort_unstable_by_key(|&(v, _)| v);
            return Some(row);
        }
    }
    None
}

/// Returns the vertex at which a point lies, if any.
pub(super) fn sole_vertex(row: &Row) -> Option<u32> {
    let is_all = |&&(_, weight): &&(u32, f64)| weight >= 1.0 - ROUNDING;
    row.iter().find(is_all).map(|&(vertex, _)| vertex)
}

/// Returns whether the element's box, slightly enlarged, contains the point: a cheap test before the exact one.
fn is_within_reach<const D: usize>(edges: &Matrix<D>, arm: &[f64; D]) -> bool {
    (0..D).all(|k| {
        let along = edges.iter().map(|edge| edge[k]);
        let (low, high) = along.fold((0.0, 0.0), |(low, high): (f64, f64), x| {
            (low.min(x), high.max(x))
        });
        let margin = ROUNDING * D as f64 * (high - low);
        (low - margin..=high + margin).contains(&arm[k])
    })
}

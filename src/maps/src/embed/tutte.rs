//! Tutte's embedding on a circle.
//!
//! Every inner vertex is the mean of its neighbors, and the boundary lies on a circle: in exact arithmetic no triangle
//! of such a map is flipped or empty (Tutte 1963; Floater 2003 for triangulations whose boundary vertices are joined
//! inside). In floating point this is not guaranteed, so callers check the result.

use super::closed::{ClosedDisk, edge_lengths};
use super::positive::first_bad_triangle;
use unwrapd_method::numerics::cholesky::{Cholesky, SymmetricPattern};

/// Spacing of the boundary on the circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Boundary {
    /// By its length in space; edges shorter than a share of the mean count as that share, so that corners stay apart.
    ArcLength,
    /// Equal angles for all edges.
    EqualAngles,
}

/// Shortest boundary edge on the circle, as a share of the mean one. Larger shares depart further from arc length,
/// smaller ones squeeze the triangles at short edges.
const SHORTEST_ARC: f64 = 0.1;

/// Number of a vertex on the circle among the unknowns.
const FIXED: u32 = u32::MAX;

/// Returns one position per vertex of the closed disk. Costs one sparse factorization.
pub(super) fn tutte_embedding(closed: &ClosedDisk, boundary: Boundary) -> Vec<[f64; 2]> {
    let mut uv = vec![[0.0; 2]; closed.positions.len()];
    let mut unknown = vec![0; closed.positions.len()];
    for (&v, point) in closed.boundary.iter().zip(circle(closed, boundary)) {
        uv[v as usize] = point;
        unknown[v as usize] = FIXED;
    }
    let inner: Vec<usize> = (0..uv.len()).filter(|&v| unknown[v] != FIXED).collect();
    for (i, &v) in inner.iter().enumerate() {
        unknown[v] = i as u32;
    }
    if inner.is_empty() {
        return uv;
    }
    let (pattern, values, mut rhs) = system(closed, &unknown, inner.len(), &uv);
    let mut cholesky = Cholesky::analyze(&pattern, 1);
    if cholesky.factor(&values).is_ok() {
        cholesky.solve(&mut rhs, 2);
        for (i, &v) in inner.iter().enumerate() {
            uv[v] = [rhs[i], rhs[inner.len() + i]];
        }
    }
    uv
}

fn circle(closed: &ClosedDisk, boundary: Boundary) -> Vec<[f64; 2]> {
    let n = closed.boundary.len();
    let lengths = match boundary {
        Boundary::ArcLength => edge_lengths(&closed.boundary, &closed.positions),
        Boundary::EqualAngles => vec![1.0; n],
    };
    let shortest = SHORTEST_ARC * lengths.iter().sum::<f64>() / n as f64;
    let lengths: Vec<f64> = lengths.iter().map(|l| l.max(shortest)).collect();
    let turn = std::f64::consts::TAU / lengths.iter().sum::<f64>();
    let mut angle = 0.0;
    (lengths.iter())
        .map(|length| {
            let point = [f64::cos(angle), f64::sin(angle)];
            angle += turn * length;
            point
        })
        .collect()
}

/// Returns the uniform Laplacian of the inner vertices (lower triangle) and its two right-hand sides.
///
/// An interior edge occurs as two halfedges, one from each end; boundary edges join fixed vertices.
fn system(
    closed: &ClosedDisk,
    unknown: &[u32],
    n: usize,
    uv: &[[f64; 2]],
) -> (SymmetricPattern, Vec<f64>, Vec<f64>) {
    let mut degrees = vec![0.0; n];
    let mut rhs = vec![0.0; 2 * n];
    let mut entries = Vec::with_capacity(4 * n);
    for triangle in &closed.triangles {
        for k in 0..3 {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            let (row, column) = (unknown[a as usize], unknown[b as usize]);
            if row == FIXED {
                continue;
            }
            degrees[row as usize] += 1.0;
            if column == FIXED {
                rhs[row as usize] += uv[b as usize][0];
                rhs[n + row as usize] += uv[b as usize][1];
            } else if column < row {
                entries.push((column, row, -1.0));
            }
        }
    }
    entries.extend((0..).zip(degrees).map(|(i, degree)| (i, i, degree)));
    let (pattern, values) = SymmetricPattern::from_entries(n, entries);
    (pattern, values, rhs)
}

/// Returns Tutte's map of the closed disk, if floating point left every triangle positive.
///
/// Equal angles are tried second: they avoid squeezing at short boundary edges.
pub(super) fn tutte(closed: &ClosedDisk) -> Option<Vec<[f64; 2]>> {
    [Boundary::ArcLength, Boundary::EqualAngles]
        .into_iter()
        .map(|boundary| tutte_embedding(closed, boundary))
        .find(|uv| first_bad_triangle(&closed.triangles, uv).is_none())
}

//! Tutte's embedding on a circle.
//!
//! Every inner vertex is the mean of its neighbors, and the boundary lies on a circle: in exact arithmetic no triangle
//! of such a map is flipped or empty (Tutte 1963; Floater 2003 for triangulations whose boundary vertices are joined
//! inside). In floating point this is not guaranteed, so callers check the result.

use crate::mesh::Disk;
use unwrapd_method::numerics::cholesky::{Cholesky, SymmetricPattern};
use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::numerics::vec3;

/// Spacing of the boundary on the circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BoundarySpacing {
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
pub(super) fn tutte_embedding(closed: &ClosedDisk, boundary: BoundarySpacing) -> Vec<[f64; 2]> {
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

fn circle(closed: &ClosedDisk, boundary: BoundarySpacing) -> Vec<[f64; 2]> {
    let n = closed.boundary.len();
    let lengths = match boundary {
        BoundarySpacing::ArcLength => edge_lengths(&closed.boundary, &closed.positions),
        BoundarySpacing::EqualAngles => vec![1.0; n],
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
    [BoundarySpacing::ArcLength, BoundarySpacing::EqualAngles]
        .into_iter()
        .map(|boundary| tutte_embedding(closed, boundary))
        .find(|uv| first_bad_triangle(&closed.triangles, uv).is_none())
}

// A disk whose holes are closed by virtual faces.

/// A triangulation with one boundary loop: the disk's triangles first, then a fan around a new vertex in each hole.
///
/// Tutte's theorem and the hierarchy require this form. The virtual faces carry (nearly) no distortion energy.
pub(super) struct ClosedDisk {
    /// Vertices of the disk, then one apex per hole, in the middle of its loop.
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// Number of real triangles; those after them are virtual.
    pub n_real: usize,
    /// Outer loop, counter-clockwise.
    pub boundary: Vec<u32>,
}

impl ClosedDisk {
    pub fn new(disk: &Disk, positions: &[[f64; 3]]) -> Self {
        let outer = outer_loop(disk, positions);
        let mut closed = Self {
            positions: positions[..disk.n_vertices].to_vec(),
            triangles: disk.triangles.clone(),
            n_real: disk.triangles.len(),
            boundary: disk.loops[outer].clone(),
        };
        for (_, hole) in disk.loops.iter().enumerate().filter(|(i, _)| *i != outer) {
            let apex = closed.positions.len() as u32;
            let middle = hole.iter().fold([0.0; 3], |sum, &v| {
                vec3::add_scaled(sum, 1.0 / hole.len() as f64, positions[v as usize])
            });
            closed.positions.push(middle);
            // The hole lies to the right of its loop.
            closed.triangles.extend((0..hole.len()).map(|i| {
                let next = hole[(i + 1) % hole.len()];
                [next, hole[i], apex]
            }));
        }
        closed
    }
}

/// Chooses the loop that is longest in space as the outer one, which must contain everything else.
pub(super) fn outer_loop(disk: &Disk, positions: &[[f64; 3]]) -> usize {
    let lengths = disk
        .loops
        .iter()
        .map(|boundary| edge_lengths(boundary, positions).iter().sum::<f64>());
    let longest =
        lengths.enumerate().fold(
            (0, 0.0),
            |best, (i, length)| {
                if length > best.1 { (i, length) } else { best }
            },
        );
    longest.0
}

/// Returns the length in space of the edge from each vertex of a loop to the next.
fn edge_lengths(boundary: &[u32], positions: &[[f64; 3]]) -> Vec<f64> {
    let at = |i: usize| positions[boundary[i % boundary.len()] as usize];
    (0..boundary.len())
        .map(|i| vec3::distance(at(i), at(i + 1)))
        .collect()
}

// Exact tests for flips.

/// Returns whether every triangle is counter-clockwise and not empty, decided exactly.
pub fn is_positive(triangles: &[[u32; 3]], uv: &[[f64; 2]]) -> bool {
    first_bad_triangle(triangles, uv).is_none()
}

/// Returns the first triangle that is not exactly positive.
pub(super) fn first_bad_triangle(triangles: &[[u32; 3]], uv: &[[f64; 2]]) -> Option<usize> {
    triangles.iter().position(|t| {
        let [a, b, c] = t.map(|v| uv[v as usize]);
        orient2d_sign(a, b, c) <= 0
    })
}

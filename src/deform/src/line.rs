//! Lines that handles pull: the points at which a body holds them.
//!
//! A line is held at points inside elements. Were it held in every element that it crosses, as many conditions as
//! unknowns would meet along it, and bends between elements would contradict each other. So a point is held only if
//! most of its weight is on vertices that nothing else holds, and no more than one of its element's is held already:
//! then each point can come to its target whatever the others do.

use super::body::{Body, locate};
use unwrapd_method::energy::Row;
use unwrapd_method::numerics::square::{Matrix, Square, apply, transposed};

/// Weight of a vertex, or length of a crossing as a share of its segment, below which it is rounding.
const ROUNDING: f64 = 1e-9;

/// Least total weight of movable vertices in a point that is pulled itself: with less, they would have to move more
/// than twice as far as the point.
pub(super) const LEAST_FREE: f64 = 0.5;

/// A point of a line and its target.
pub(super) type HeldPoint<const D: usize> = (Row, [f64; D]);

/// Returns the points at which a body at rest holds a line, its ends first, with their targets on another line: each
/// keeps its share of the length. Points on vertices that are held already are left out.
///
/// Returns `None` if a line has no length, or the first one does not meet the body.
///
/// Cost: each element is clipped against each segment of the line.
pub(super) fn held_points<const D: usize>(
    body: &Body,
    line: &[[f64; D]],
    to: &[[f64; D]],
    is_held: impl Fn(u32) -> bool,
) -> Option<Vec<HeldPoint<D>>>
where
    Matrix<D>: Square<D>,
{
    let (line, to) = (Polyline::new(line)?, Polyline::new(to)?);
    // Find the middle of every crossing of an element, and put the ends first.
    let mut candidates = line.crossings(body);
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ends = [0.0, 1.0].map(|share| locate(body, line.at(share)).map(|row| (share, row)));
    let candidates: Vec<(f64, Row)> = ends.into_iter().flatten().chain(candidates).collect();
    if candidates.is_empty() {
        return None;
    }
    // Hold those that are independent of the others.
    let mut is_taken: Vec<bool> = (0..body.n_vertices() as u32).map(is_held).collect();
    let mut points = Vec::new();
    for (share, row) in candidates {
        let row: Row = row.into_iter().filter(|(_, w)| *w > ROUNDING).collect();
        let free = row.iter().filter(|(v, _)| !is_taken[*v as usize]);
        let (n_free, weight) = free.fold((0, 0.0), |(n, sum), (_, w)| (n + 1, sum + w));
        if weight >= LEAST_FREE && n_free + 1 >= row.len() {
            for (v, _) in &row {
                is_taken[*v as usize] = true;
            }
            points.push((row, to.at(share)));
        }
    }
    Some(points)
}

/// A line of straight segments.
struct Polyline<'a, const D: usize> {
    corners: &'a [[f64; D]],
    /// Length up to each corner, as a share of the whole.
    shares: Vec<f64>,
}

impl<'a, const D: usize> Polyline<'a, D>
where
    Matrix<D>: Square<D>,
{
    /// Creates a line; `None` if its length is not a positive number.
    fn new(corners: &'a [[f64; D]]) -> Option<Self> {
        let mut shares = vec![0.0];
        for pair in corners.windows(2) {
            let squares = (0..D).map(|k| (pair[1][k] - pair[0][k]).powi(2));
            let length = squares.sum::<f64>().sqrt();
            shares.push(shares[shares.len() - 1] + length);
        }
        let length = shares[shares.len() - 1];
        for share in &mut shares {
            *share /= length;
        }
        (length > 0.0 && length.is_finite()).then_some(Self { corners, shares })
    }

    /// Returns the place after a share of the length.
    fn at(&self, share: f64) -> [f64; D] {
        let next = self.shares.partition_point(|&s| s < share);
        let next = next.clamp(1, self.corners.len() - 1);
        let [a, b] = [self.shares[next - 1], self.shares[next]];
        let t = if b > a { (share - a) / (b - a) } else { 0.0 };
        between(
            self.corners[next - 1],
            self.corners[next],
            t.clamp(0.0, 1.0),
        )
    }

    /// Returns the middle of each stretch of a segment within an element of a body at rest: its share of the length,
    /// and the element's vertices with their weights there.
    fn crossings(&self, body: &Body) -> Vec<(f64, Row)> {
        let place = |v: u32| -> [f64; D] { std::array::from_fn(|k| body.rest[D * v as usize + k]) };
        let mut crossings = Vec::new();
        for element in body.corners() {
            let origin = place(element[0]);
            let edges: Matrix<D> = std::array::from_fn(|k| {
                let corner = place(element[k + 1]);
                std::array::from_fn(|c| corner[c] - origin[c])
            });
            let inverse = transposed(&edges.inverse(edges.det()));
            let weights = |at: [f64; D]| -> Vec<f64> {
                let others = apply(&inverse, &std::array::from_fn(|k| at[k] - origin[k]));
                let first = 1.0 - others.iter().sum::<f64>();
                std::iter::once(first).chain(others).collect()
            };
            for (i, pair) in self.corners.windows(2).enumerate() {
                // Weights are linear along the segment; all are positive within the element.
                let (at_start, at_end) = (weights(pair[0]), weights(pair[1]));
                let Some([low, high]) = positive(&at_start, &at_end) else {
                    continue;
                };
                let t = 0.5 * (low + high);
                let [a, b] = [self.shares[i], self.shares[i + 1]];
                let ends = at_start.iter().zip(&at_end);
                let weights = ends.map(|(a, b)| (1.0 - t) * a + t * b);
                let mut row: Row = element.iter().copied().zip(weights).collect();
                row.sort_unstable_by_key(|&(v, _)| v);
                crossings.push((a + t * (b - a), row));
            }
        }
        crossings
    }
}

fn between<const D: usize>(a: [f64; D], b: [f64; D], t: f64) -> [f64; D] {
    std::array::from_fn(|k| (1.0 - t) * a[k] + t * b[k])
}

/// Returns the range of t in [0, 1] in which no (1 − t)a + tb is negative; `None` if that is a point or empty.
fn positive(at_start: &[f64], at_end: &[f64]) -> Option<[f64; 2]> {
    let [mut low, mut high] = [0.0_f64, 1.0_f64];
    for (&a, &b) in at_start.iter().zip(at_end) {
        // Numbers near 0 lie on a side of the element.
        let [a, b] = [a, b].map(|x| if x.abs() <= ROUNDING { 0.0 } else { x });
        if a < 0.0 && b < 0.0 || a.min(b) < 0.0 && a.max(b) == 0.0 {
            return None;
        }
        if a < 0.0 {
            low = low.max(a / (a - b));
        } else if b < 0.0 {
            high = high.min(a / (a - b));
        }
    }
    (high - low > ROUNDING).then_some([low, high])
}

//! Paths of curves as closed polygons.

use kurbo::{BezPath, PathEl, Point};

/// Largest coordinate of a path.
const GREATEST: f64 = 1e9;

/// Reason why a path has no polygons.
pub(super) enum PathError {
    /// A coordinate is not finite or beyond [`GREATEST`].
    OutOfRange,
    /// The path has more vertices than allowed.
    TooDetailed,
    /// A part of the path does not end where it began.
    Open,
}

/// Returns the closed polygons of a path, nowhere farther than `tolerance` from its curves, with at most
/// `most_vertices` in total.
///
/// A polygon may repeat its first vertex at its end. Parts of a single point are left out.
pub(super) fn polygons(
    path: BezPath,
    tolerance: f64,
    most_vertices: usize,
) -> Result<Vec<Vec<[f64; 2]>>, PathError> {
    let in_range = |p: Point| p.x.abs() < GREATEST && p.y.abs() < GREATEST;
    let is_in_range = |e: &PathEl| e.is_finite() && e.end_point().is_none_or(in_range);
    if !path.elements().iter().all(is_in_range) {
        return Err(PathError::OutOfRange);
    }
    let mut parts = Parts::default();
    let mut n_vertices = 0;
    kurbo::flatten(path, tolerance, |element| {
        n_vertices += 1;
        if n_vertices <= most_vertices {
            parts.push(element);
        }
    });
    parts.begin(None);
    if n_vertices > most_vertices {
        Err(PathError::TooDetailed)
    } else if parts.is_any_open {
        Err(PathError::Open)
    } else {
        Ok(parts.closed)
    }
}

/// The finished parts of a path, and the one in progress.
#[derive(Default)]
struct Parts {
    closed: Vec<Vec<[f64; 2]>>,
    is_any_open: bool,
    current: Vec<[f64; 2]>,
}

impl Parts {
    fn push(&mut self, element: PathEl) {
        match element {
            PathEl::MoveTo(p) => self.begin(Some([p.x, p.y])),
            PathEl::LineTo(p) => self.current.push([p.x, p.y]),
            // Flattened paths have no other elements than the end of a part. What follows begins where this part did, if it
            // has no beginning of its own.
            _ => {
                let first = self.current.first().copied();
                self.current.extend(first);
                self.begin(first);
            }
        }
    }

    /// Ends the current part and begins another one at a point.
    fn begin(&mut self, first: Option<[f64; 2]>) {
        let part = std::mem::replace(&mut self.current, first.into_iter().collect());
        if part.len() > 1 {
            self.is_any_open |= part.first() != part.last();
            self.closed.push(part);
        }
    }
}

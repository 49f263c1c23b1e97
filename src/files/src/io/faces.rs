//! Faces of a file, and the triangles into which polygons are split.

use crate::polygon::{Filling, triangulate};

/// Positions and triangles of one file, in the file's order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct IndexedTriangles<T = f32> {
    /// Vertex positions.
    pub positions: Vec<[T; 3]>,
    /// Three vertex indices for each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Polygons without an inside.
    pub fanned: Fanned,
}

/// Reason why a file cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file does not follow its format.
    #[error("{format}, {place} {at}: {cause}")]
    Malformed {
        /// Name of the format.
        format: &'static str,
        /// Unit of `at`: `line` or `byte`.
        place: &'static str,
        /// Position of the error; lines count from 1.
        at: usize,
        /// Description of the error.
        cause: &'static str,
    },
    /// A coordinate is NaN, infinite or, if stored as `f32`, beyond its range.
    #[error("vertex {vertex} has a coordinate that is not a finite number")]
    NonFinitePosition {
        /// Index of the vertex, from 0.
        vertex: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("a face names vertex {index}, but there are only {n_vertices}")]
    IndexOutOfRange {
        /// Index of the vertex, from 0.
        index: i64,
        /// Number of vertices in the file.
        n_vertices: usize,
    },
}

impl ReadError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Malformed { .. } => "invalid_mesh",
            Self::NonFinitePosition { .. } => "non_finite_position",
            Self::IndexOutOfRange { .. } => "index_out_of_range",
        }
    }
}

/// Number types of coordinates.
pub(super) trait Coordinate: Copy + Default {
    const NAN: Self;

    /// Returns the nearest such number, without a negative zero; `None` if that is not finite.
    fn nearest(x: f64) -> Option<Self>;

    fn to_f64(self) -> f64;
}

impl Coordinate for f32 {
    const NAN: Self = Self::NAN;

    fn nearest(x: f64) -> Option<Self> {
        Some(x as f32 + 0.0).filter(|x| x.is_finite())
    }

    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

impl Coordinate for f64 {
    const NAN: Self = Self::NAN;

    fn nearest(x: f64) -> Option<Self> {
        Some(x + 0.0).filter(|x| x.is_finite())
    }

    fn to_f64(self) -> f64 {
        self
    }
}

/// Converts a position of a file, without negative zeros; coordinates that are not finite become NaN. [`Faces::filled`]
/// refuses faces with such a corner: a vertex that no face uses may hold anything.
pub(super) fn any_position<T: Coordinate>(coordinates: [f64; 3]) -> [T; 3] {
    coordinates.map(|x| T::nearest(x).unwrap_or(T::NAN))
}

/// Converts a position of a file, which must be finite, without negative zeros.
pub(super) fn position<T: Coordinate>(
    coordinates: [f64; 3],
    vertex: usize,
) -> Result<[T; 3], ReadError> {
    match coordinates.map(T::nearest) {
        [Some(x), Some(y), Some(z)] => Ok([x, y, z]),
        _ => Err(ReadError::NonFinitePosition { vertex }),
    }
}

/// Number of polygons whose places are kept.
const PLACES: usize = 5;

/// Polygons without an inside: they cross themselves or have no area, and became the fans of their first corners.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Fanned {
    /// Number of such polygons.
    pub n_polygons: usize,
    /// Places of the first of them: lines of a text from 1, or else faces from 0.
    pub first: Vec<usize>,
}

/// Triangles under construction. Polygons are fans until all positions are known ([`Faces::filled`]).
#[derive(Default)]
pub(super) struct Faces {
    triangles: Vec<[u32; 3]>,
    polygons: Vec<Polygon>,
    checked: Vec<u32>,
}

/// A face with more than three corners.
struct Polygon {
    /// First triangle of its fan.
    first: usize,
    n_corners: usize,
    /// Place that messages name.
    place: usize,
}

impl Faces {
    /// Appends a face; one of fewer than three corners has no triangles.
    pub fn push(&mut self, corners: &[u32], place: usize) {
        if corners.len() > 3 {
            self.polygons.push(Polygon {
                first: self.triangles.len(),
                n_corners: corners.len(),
                place,
            });
        }
        let pairs = corners.windows(2).skip(1);
        self.triangles
            .extend(pairs.map(|pair| [corners[0], pair[0], pair[1]]));
    }

    /// Like [`push`](Self::push), for indices of a file, which must be below `n_vertices`.
    pub fn push_checked(
        &mut self,
        corners: &[i64],
        n_vertices: usize,
        place: usize,
    ) -> Result<(), ReadError> {
        if corners.len() < 3 {
            return Ok(());
        }
        let mut checked = std::mem::take(&mut self.checked);
        checked.clear();
        for &index in corners {
            match u32::try_from(index) {
                Ok(i) if (i as usize) < n_vertices => checked.push(i),
                _ => return Err(ReadError::IndexOutOfRange { index, n_vertices }),
            }
        }
        self.push(&checked, place);
        self.checked = checked;
        Ok(())
    }

    /// Returns the largest index.
    pub fn last_corner(&self) -> Option<u32> {
        self.triangles.iter().flatten().copied().max()
    }

    /// Returns all triangles in the order of the faces, those of polygons inside them, and the polygons without an
    /// inside.
    ///
    /// `position` returns the vertex of a corner and its position.
    ///
    /// # Errors
    /// If the position of a corner is not finite.
    pub fn filled<T: Coordinate>(
        self,
        position: impl Fn(u32) -> (u32, [T; 3]),
    ) -> Result<(Vec<[u32; 3]>, Fanned), ReadError> {
        let mut triangles = self.triangles;
        // Check the position of every corner.
        for &corner in triangles.as_flattened() {
            let (vertex, position) = position(corner);
            if !position.iter().all(|x| x.to_f64().is_finite()) {
                let vertex = vertex as usize;
                return Err(ReadError::NonFinitePosition { vertex });
            }
        }
        let mut fanned = Fanned::default();
        // Replace the fan of each polygon by triangles inside it.
        let (mut corners, mut positions, mut local) = (Vec::new(), Vec::new(), Vec::new());
        for polygon in self.polygons {
            let fan = &mut triangles[polygon.first..][..polygon.n_corners - 2];
            corners.clear();
            corners.extend(&fan[0][..2]);
            corners.extend(fan.iter().map(|triangle| triangle[2]));
            positions.clear();
            positions.extend(corners.iter().map(|&c| position(c).1.map(T::to_f64)));
            local.clear();
            if triangulate(&positions, &mut local) == Filling::Fan {
                fanned.n_polygons += 1;
                fanned
                    .first
                    .extend((fanned.n_polygons <= PLACES).then_some(polygon.place));
            }
            for (triangle, local) in fan.iter_mut().zip(&local) {
                *triangle = local.map(|k| corners[k as usize]);
            }
        }
        Ok((triangles, fanned))
    }
}

//! Faces of a file, and the triangles into which polygons are split.

use super::{Coordinate, ReadError};
use crate::polygon::{Filling, triangulate};

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

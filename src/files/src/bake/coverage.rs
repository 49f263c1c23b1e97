//! Coverage of texels by faces.

use super::Corners;
use crate::picture::{spans, steps};
use rayon::prelude::*;

/// Rows per task. Fewer balance better, but more faces reach into several tasks.
const BAND: usize = 64;
/// Reach in texels: bilinear filtering at a point of a chart reads centers of texels less than √2 texels away.
const REACH: f64 = 1.5;
/// Entry of a texel without a face.
const EMPTY: u32 = u32::MAX;
/// Bit of a texel whose center lies beside its face.
const BESIDE: u32 = 1 << 31;

/// For each texel of a square texture the face that contains its center, or beside which the center lies within the
/// reach of bilinear filtering.
pub struct Coverage {
    side: usize,
    /// Corners of the faces, in texels.
    faces: Vec<Corners>,
    texels: Vec<u32>,
}

impl Coverage {
    /// Rasterizes `faces`, given by the UVs of their corners, v down, in the unit square; fewer than 2³¹. A center on a
    /// common edge belongs to one face; of overlapping faces the last wins.
    pub fn new(faces: &[Corners], side: usize) -> Self {
        let scale = side as f64;
        let faces: Vec<Corners> = faces
            .iter()
            .map(|face| face.map(|uv| uv.map(|x| x * scale)))
            .collect();
        // List the faces that reach into each band of rows.
        let mut bands: Vec<Vec<u32>> = vec![Vec::new(); side.div_ceil(BAND)];
        for (face, corners) in (0..).zip(&faces) {
            let [low, high] = extent(corners.map(|p| p[1]));
            let last = ((high + REACH).max(0.0) as usize / BAND).min(bands.len() - 1);
            let first = (low - REACH).max(0.0) as usize / BAND;
            for band in bands.iter_mut().take(last + 1).skip(first) {
                band.push(face);
            }
        }
        // Cover the bands in parallel; each writes only its own texels.
        let mut texels = vec![EMPTY; side * side];
        texels
            .par_chunks_mut(BAND * side)
            .zip(&bands)
            .enumerate()
            .for_each(|(band, (texels, of_band))| {
                Band {
                    first_row: band * BAND,
                    side,
                    texels,
                }
                .cover(&faces, of_band);
            });
        Self {
            side,
            faces,
            texels,
        }
    }

    /// Returns the number of texels along a side.
    pub fn side(&self) -> usize {
        self.side
    }

    /// Returns the face of a texel; `None` if no chart is near.
    pub fn at(&self, x: usize, y: usize) -> Option<u32> {
        let texel = self.texels[y * self.side + x];
        (texel != EMPTY).then_some(texel & !BESIDE)
    }

    /// Returns whether the center of a texel lies in a face.
    pub fn is_inside(&self, x: usize, y: usize) -> bool {
        self.texels[y * self.side + x] & BESIDE == 0
    }

    /// Returns whether a texel and all its neighbors lie in faces.
    pub(super) fn is_interior(&self, x: usize, y: usize) -> bool {
        let last = self.side - 1;
        let around = |c: usize| c.saturating_sub(1)..=(c + 1).min(last);
        around(y).all(|y| around(x).all(|x| self.is_inside(x, y)))
    }

    /// Returns the corners of a face, in texels.
    pub(super) fn corners(&self, face: u32) -> &Corners {
        &self.faces[face as usize]
    }
}

/// Some rows of a texture.
struct Band<'a> {
    first_row: usize,
    side: usize,
    texels: &'a mut [u32],
}

impl Band<'_> {
    fn cover(&mut self, faces: &[Corners], of_band: &[u32]) {
        let top = self.first_row as f64;
        let size = [self.side, self.texels.len() / self.side];
        let local = |face: u32| faces[face as usize].map(|[x, y]| [x, y - top]);
        for &face in of_band {
            for (row, columns) in spans(steps(local(face)), size) {
                self.texels[row * self.side..][columns].fill(face);
            }
        }
        let mut distances = vec![REACH * REACH; self.texels.len()];
        for &face in of_band {
            self.surround(face, &local(face), &mut distances);
        }
    }

    /// Assigns to a face the texels beside it that lie in no face and are nearer to it than to any earlier one.
    fn surround(&mut self, face: u32, corners: &Corners, distances: &mut [f64]) {
        let rows = self.texels.len() / self.side;
        let [low, high] = extent(corners.map(|p| p[1]));
        for row in centers(low - REACH, high + REACH, rows) {
            let y = row as f64 + 0.5;
            let Some([left, right]) = width_between(corners, y - REACH, y + REACH) else {
                continue;
            };
            for column in centers(left - REACH, right + REACH, self.side) {
                let texel = row * self.side + column;
                if self.texels[texel] & BESIDE == 0 {
                    continue;
                }
                let (_, distance2) = nearest_on_edges(corners, [column as f64 + 0.5, y]);
                if distance2 < distances[texel] {
                    distances[texel] = distance2;
                    self.texels[texel] = face | BESIDE;
                }
            }
        }
    }
}

/// Returns the texels, of `n`, with centers from `low` to `high`.
fn centers(low: f64, high: f64, n: usize) -> std::ops::Range<usize> {
    let first = (low - 0.5).ceil().max(0.0) as usize;
    let end = ((high + 0.5).floor().max(0.0) as usize).min(n);
    first.min(end)..end
}

fn extent(values: [f64; 3]) -> [f64; 2] {
    let [a, b, c] = values;
    [a.min(b).min(c), a.max(b).max(c)]
}

/// Returns the least and greatest x of the part of a triangle between two heights.
fn width_between(corners: &Corners, low: f64, high: f64) -> Option<[f64; 2]> {
    let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
    for k in 0..3 {
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        let (a, b) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        if b[1] < low || a[1] > high {
            continue;
        }
        let height = b[1] - a[1];
        for y in [a[1].max(low), b[1].min(high)] {
            let t = if height > 0.0 {
                (y - a[1]) / height
            } else {
                0.0
            };
            let x = a[0] + t * (b[0] - a[0]);
            left = left.min(x);
            right = right.max(x);
        }
        // A level edge has both its ends at one height.
        if height <= 0.0 {
            left = left.min(b[0]);
            right = right.max(b[0]);
        }
    }
    (left <= right).then_some([left, right])
}

// Places in a triangle of the plane.

/// Weights of the corners of a triangle.
pub(super) type Barycentric = [f64; 3];

/// A triangle with the data for locating points in it.
pub(super) struct Triangle {
    corners: Corners,
    /// Derivatives of the weights of the second and third corner.
    gradients: [[f64; 2]; 2],
}

impl Triangle {
    /// Creates the triangle; returns `None` if it has no area.
    pub fn new(corners: Corners) -> Option<Self> {
        let [a, b, c] = corners;
        let (e, f) = (difference(b, a), difference(c, a));
        let area = e[0] * f[1] - e[1] * f[0];
        let inverse = 1.0 / area;
        inverse.is_finite().then_some(Self {
            corners,
            gradients: [
                [f[1] * inverse, -f[0] * inverse],
                [-e[1] * inverse, e[0] * inverse],
            ],
        })
    }

    /// Returns the weights at a place, some negative outside.
    pub fn weights(&self, at: [f64; 2]) -> Barycentric {
        let d = difference(at, self.corners[0]);
        let [s, t] = self.gradients.map(|g| g[0] * d[0] + g[1] * d[1]);
        [1.0 - s - t, s, t]
    }

    /// Returns the Jacobian of the affine map that takes the corners to `to`, row by row.
    pub fn jacobian(&self, to: &Corners) -> [[f64; 2]; 2] {
        let (e, f) = (difference(to[1], to[0]), difference(to[2], to[0]));
        let [g, h] = self.gradients;
        [0, 1].map(|row| [0, 1].map(|column| e[row] * g[column] + f[row] * h[column]))
    }

    /// Returns the weights at the triangle's point nearest to a place, and the square of its distance.
    pub fn nearest(&self, at: [f64; 2]) -> (Barycentric, f64) {
        let weights = self.weights(at);
        if weights.iter().all(|w| *w >= 0.0) {
            return (weights, 0.0);
        }
        nearest_on_edges(&self.corners, at)
    }
}

/// Returns the weights at the nearest point of a triangle's edges, and the square of its distance.
fn nearest_on_edges(corners: &Corners, at: [f64; 2]) -> (Barycentric, f64) {
    let mut nearest = ([0.0; 3], f64::INFINITY);
    for k in 0..3 {
        let next = (k + 1) % 3;
        let edge = difference(corners[next], corners[k]);
        let d = difference(at, corners[k]);
        let length2 = edge[0] * edge[0] + edge[1] * edge[1];
        let along = d[0] * edge[0] + d[1] * edge[1];
        let t = if length2 > 0.0 {
            (along / length2).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let off = [d[0] - t * edge[0], d[1] - t * edge[1]];
        let distance2 = off[0] * off[0] + off[1] * off[1];
        if distance2 < nearest.1 {
            let mut weights = [0.0; 3];
            weights[k] = 1.0 - t;
            weights[next] = t;
            nearest = (weights, distance2);
        }
    }
    nearest
}

/// Returns the weighted mean of the corners.
pub(super) fn blended(weights: Barycentric, corners: &Corners) -> [f64; 2] {
    [0, 1].map(|k| (0..3).map(|c| weights[c] * corners[c][k]).sum())
}

fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Sums of doubled areas of faces.
pub(super) struct Areas {
    /// Area in the source textures.
    pub sources: f64,
    /// Area in the new texture.
    pub targets: f64,
}

impl Areas {
    /// Sums the areas of faces, given by their corners in both. Faces without area in the new texture are left out.
    pub fn of<'a>(faces: impl Iterator<Item = (&'a Corners, &'a Corners)>) -> Self {
        let mut areas = Self {
            sources: 0.0,
            targets: 0.0,
        };
        for (source, target) in faces {
            let target = doubled_area(target);
            if target > 0.0 {
                areas.sources += doubled_area(source);
                areas.targets += target;
            }
        }
        areas
    }

    /// Returns the mean length, in the old texture, of a unit of the new one; 0 if there are no sources.
    pub fn length(&self) -> f64 {
        if self.targets > 0.0 {
            (self.sources / self.targets).sqrt()
        } else {
            0.0
        }
    }
}

pub(super) fn doubled_area([a, b, c]: &Corners) -> f64 {
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
}

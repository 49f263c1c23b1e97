//! Texels that stacked islands share.

use super::coverage::{Coverage, Triangle, blended};
use super::plane::{Plane, Sampled};
use super::texture::Texture;
use crate::document::Wrap;
use crate::picture::{spans, steps};
use rayon::prelude::*;

/// Greatest distance in source texels of two places that count as one. Bilinear filtering then differs by at most this
/// share of the difference between two neighboring texels, and stacks of equal shapes are less exact than it.
const SAME_PLACE: f64 = 1.0 / 8.0;
/// Greatest difference of two colors that count as one: that of two codes of 8 bits.
const SAME_COLOR: f32 = 1.0 / 255.0;

/// Returns whether all faces that lie over the center of a texel show one place of one texture, so that the texel is
/// right for each of them. Faces without a texture need no texel, but must not own one that others need.
pub fn stacks_agree(plane: &Plane, coverage: &Coverage) -> bool {
    (0..plane.faces.len() as u32)
        .into_par_iter()
        .all(|face| agrees(plane, coverage, face))
}

/// Returns whether a face shows what the face shows to which each of its texels belongs.
fn agrees(plane: &Plane, coverage: &Coverage, face: u32) -> bool {
    let Some(source) = FaceSource::new(plane, coverage, face) else {
        return true;
    };
    let size = [coverage.side(); 2];
    spans(steps(*coverage.corners(face)), size).all(|(row, columns)| {
        columns.into_iter().all(|column| {
            let owner = coverage.at(column, row).filter(|owner| *owner != face);
            let center = [column as f64 + 0.5, row as f64 + 0.5];
            owner.is_none_or(|owner| {
                let owner = FaceSource::new(plane, coverage, owner);
                owner.is_some_and(|owner| source.agrees_with(&owner, center))
            })
        })
    })
}

/// Source of a face.
struct FaceSource<'a> {
    plane: &'a Plane<'a>,
    face: usize,
    triangle: Triangle,
    sampled: &'a Sampled,
    texture: &'a Texture<'a>,
}

impl<'a> FaceSource<'a> {
    /// Returns the source; `None` if the face has no texture or no area.
    fn new(plane: &'a Plane, coverage: &Coverage, face: u32) -> Option<Self> {
        let sampled = plane.faces[face as usize].as_ref()?;
        Some(Self {
            plane,
            face: face as usize,
            triangle: Triangle::new(*coverage.corners(face))?,
            sampled,
            texture: &plane.textures[sampled.texture as usize],
        })
    }

    fn agrees_with(&self, other: &Self, center: [f64; 2]) -> bool {
        // The texels.
        if !self.texture.shows_as(other.texture) {
            return false;
        }
        let both = [self, other];
        let weights = both.map(|source| source.triangle.weights(center));
        let [a, b] = [0, 1].map(|k| blended(weights[k], &both[k].sampled.corners));
        let size = self.texture.size();
        let is_near = |axis: usize| {
            let apart = a[axis] - b[axis];
            let periodic = |period: f64| apart - period * (apart / period).round();
            let apart = match self.texture.wrap[axis] {
                Wrap::Repeat => periodic(size[axis]),
                Wrap::Mirror => periodic(2.0 * size[axis]),
                Wrap::Clamp => apart,
            };
            apart.abs() <= SAME_PLACE
        };
        let is_one_place = self.texture.is_constant() || (is_near(0) && is_near(1));
        if !is_one_place {
            return false;
        }
        // The colors that multiply them.
        let color = |k: usize| self.plane.colored(both[k].face, weights[k], [1.0; 4]);
        let [a, b] = [0, 1].map(color);
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME_COLOR)
    }
}

//! Islands that stay where they are put.

use unwrapd_maps::mesh::Resolution;

/// An island of given UVs that stays where it is put: it is moved, turned and scaled, and the others are packed around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Number of the island in errors.
    pub number: usize,
    /// One of its faces.
    pub face: u32,
    /// Translation, in UV.
    pub shift: [f64; 2],
    /// Turn about the pivot, in radians, counter-clockwise where v is up. Texels are square.
    pub turn: f64,
    /// Scale factor about the pivot, positive.
    pub scale: f64,
    /// Pivot of the turn and the scale, in UV; the middle of its bounding rectangle if absent.
    pub pivot: Option<[f64; 2]>,
}

impl Placement {
    /// Creates the placement of an island that stays where it is.
    pub(super) fn still(number: usize, face: u32) -> Self {
        Self {
            number,
            face,
            shift: [0.0; 2],
            turn: 0.0,
            scale: 1.0,
            pivot: None,
        }
    }

    /// Returns whether the island stays where it is.
    pub fn is_still(&self) -> bool {
        self.shift == [0.0; 2] && self.turn == 0.0 && self.scale == 1.0
    }

    /// Returns the new position of a point of the island, in longer sides of a page of `texture`; `middle` is the
    /// middle of the island.
    pub fn place(&self, uv: [f64; 2], middle: [f64; 2], texture: Resolution) -> [f64; 2] {
        let sides = texture.sides();
        let on_page = |uv: [f64; 2]| [uv[0] * sides[0], uv[1] * sides[1]];
        if self.is_still() {
            return on_page(uv);
        }
        let [point, pivot, shift] = [uv, self.pivot.unwrap_or(middle), self.shift].map(on_page);
        let [x, y] = [0, 1].map(|k| self.scale * (point[k] - pivot[k]));
        let (sin, cos) = self.turn.sin_cos();
        let turned = [cos * x - sin * y, sin * x + cos * y];
        [0, 1].map(|k| pivot[k] + turned[k] + shift[k])
    }
}

//! Islands that stay where they are put.

use super::seams::Seams;
use crate::certificate::chart_ids;
use crate::mesh::Resolution;
use crate::pipeline::island_error::IslandError;

/// An island of given UVs that stays where it is put: it is moved, turned and scaled, and the others are packed around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// What errors call it.
    pub number: usize,
    /// A face of it.
    pub face: u32,
    /// The way that it moves, in UV.
    pub shift: [f64; 2],
    /// The angle that it turns by about the pivot, in radians, counter-clockwise where v is up. Texels are square.
    pub turn: f64,
    /// The factor of its size, positive.
    pub scale: f64,
    /// What it is turned and scaled about, in UV; the middle of its bounding rectangle if absent.
    pub pivot: Option<[f64; 2]>,
}

impl Placement {
    /// Whether the island stays where it is.
    pub fn is_still(&self) -> bool {
        self.shift == [0.0; 2] && self.turn == 0.0 && self.scale == 1.0
    }

    /// Where a point of the island comes to lie, in longer sides of a page of such a texture; `middle` is that of the island.
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

/// Which faces belong to islands that stay.
pub struct PlacedFaces<'a> {
    placed: &'a [Placement],
    /// The island of each face.
    island: Vec<u32>,
    /// For each island the place of its placement in the list.
    of_island: Vec<Option<usize>>,
}

impl<'a> PlacedFaces<'a> {
    /// Finds the islands that are named; none where none is.
    pub fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        seams: &'a Seams,
    ) -> Result<Option<Self>, IslandError> {
        let placed = seams.placed.as_slice();
        let Some(uvs) = seams.uvs.as_ref().filter(|_| !placed.is_empty()) else {
            return Ok(None);
        };
        let island = chart_ids(positions, triangles, uvs);
        let n_islands = island.iter().max().map_or(0, |last| last + 1);
        let mut of_island: Vec<Option<usize>> = vec![None; n_islands as usize];
        for (index, placement) in placed.iter().enumerate() {
            let face = island.get(placement.face as usize);
            let face = face.ok_or(IslandError::UnknownFace(placement.number))?;
            if let Some(first) = of_island[*face as usize].replace(index) {
                return Err(IslandError::Twice(placed[first].number, placement.number));
            }
        }
        Ok(Some(Self {
            placed,
            island,
            of_island,
        }))
    }

    /// The place in the list of what is said of the island of a face.
    pub fn index_of(&self, face: u32) -> Option<usize> {
        self.of_island[self.island[face as usize] as usize]
    }

    /// The faces of islands that stay where they are, ascending.
    pub fn still(&self) -> Vec<u32> {
        let is_still = |face: &u32| {
            let index = self.index_of(*face);
            index.is_some_and(|index| self.placed[index].is_still())
        };
        (0..self.island.len() as u32).filter(is_still).collect()
    }
}

//! Faces of islands that stay where they are put.

use super::placement::Placement;
use super::seams::Seams;
use crate::island_error::IslandError;
use crate::options::Stacking;
use std::collections::HashMap;
use unwrapd_layout::atlas::GRID_BITS;
use unwrapd_maps::certificate::{chart_ids, outline};
use unwrapd_maps::mesh::CornerUvs;

/// Faces of islands that stay where they are put.
pub struct PlacedFaces {
    /// Placements from the caller's list, then one of all locked islands, if there are any.
    placed: Vec<Placement>,
    /// Number of placements in the caller's list.
    n_listed: usize,
    /// Island of each face.
    island: Vec<u32>,
    /// Index of each island's placement.
    of_island: Vec<Option<usize>>,
}

impl PlacedFaces {
    /// Finds the placed and the locked islands; returns `None` without UVs or without such islands. With [`Stacking::Keep`]
    /// islands that coincide exactly with a placed one go with it.
    pub fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        seams: &Seams,
        stacking: Stacking,
    ) -> Result<Option<Self>, IslandError> {
        let placed = seams.placed.as_slice();
        let control = seams.control.as_ref();
        let is_locked =
            |face: &u32| control.is_some_and(|control| control.of(*face).lock.is_some());
        let locked: Vec<u32> = (0..triangles.len() as u32).filter(is_locked).collect();
        let is_any = !placed.is_empty() || !locked.is_empty();
        let Some(uvs) = seams.uvs.as_ref().filter(|_| is_any) else {
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
        if stacking == Stacking::Keep {
            place_stacks(&mut of_island, &island, uvs, seams.materials.as_deref());
        }
        let n_listed = placed.len();
        let mut placed = placed.to_vec();
        for &face in &locked {
            of_island[island[face as usize] as usize].get_or_insert(n_listed);
        }
        placed.extend(locked.first().map(|&face| Placement::still(n_listed, face)));
        Ok(Some(Self {
            placed,
            n_listed,
            island,
            of_island,
        }))
    }

    /// Returns the placements.
    pub fn placements(&self) -> &[Placement] {
        &self.placed
    }

    /// Returns whether this is the placement of locked islands.
    pub fn is_locked(&self, index: usize) -> bool {
        index >= self.n_listed
    }

    /// Returns the index of the placement of a face's island.
    pub fn index_of(&self, face: u32) -> Option<usize> {
        self.of_island[self.island[face as usize] as usize]
    }

    /// Returns the faces of islands that stay where they are, in ascending order.
    pub fn still(&self) -> Vec<u32> {
        let is_still = |face: &u32| {
            let index = self.index_of(*face);
            index.is_some_and(|index| self.placed[index].is_still())
        };
        (0..self.island.len() as u32).filter(is_still).collect()
    }
}

/// Returns a coordinate of an island that stays: less than a step of the grid below the first page, it is on its border.
pub fn on_border(x: f64) -> f64 {
    let step = 1.0 / f64::from(1_u32 << GRID_BITS);
    if -step < x && x < 0.0 { 0.0 } else { x }
}

/// Gives islands without a placement that of the first placed island with the same outline and material.
fn place_stacks(
    of_island: &mut [Option<usize>],
    island: &[u32],
    uvs: &[CornerUvs],
    materials: Option<&[u32]>,
) {
    let stacks = stacks_of(island, of_island.len(), uvs, materials);
    let mut placed = HashMap::new();
    for (stack, index) in stacks.iter().zip(&*of_island) {
        if let Some(index) = index {
            placed.entry(stack).or_insert(*index);
        }
    }
    for (stack, index) in stacks.iter().zip(of_island) {
        *index = index.or_else(|| placed.get(stack).copied());
    }
}

/// Returns for each of `n_islands` islands the first one with the same outline and material.
pub fn stacks_of(
    island: &[u32],
    n_islands: usize,
    uvs: &[CornerUvs],
    materials: Option<&[u32]>,
) -> Vec<u32> {
    let mut faces: Vec<Vec<u32>> = vec![Vec::new(); n_islands];
    for (face, &island) in (0..).zip(island) {
        faces[island as usize].push(face);
    }
    let material = |faces: &[u32]| {
        let of_first = faces.first().zip(materials);
        of_first.map(|(face, materials)| materials[*face as usize])
    };
    let mut first_with = HashMap::new();
    let stack = |(island, faces): (u32, &Vec<u32>)| {
        let corners: Vec<CornerUvs> = faces.iter().map(|&face| uvs[face as usize]).collect();
        let key = (material(faces), outline(&corners));
        *first_with.entry(key).or_insert(island)
    };
    (0..).zip(&faces).map(stack).collect()
}

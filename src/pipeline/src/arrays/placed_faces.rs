//! Faces of islands that stay where they are put.

use super::placement::Placement;
use super::seams::Seams;
use crate::island_error::IslandError;
use crate::options::Stacking;
use std::collections::HashMap;
use unwrapd_maps::certificate::{chart_ids, outline};
use unwrapd_maps::mesh::CornerUvs;

/// Faces of islands that stay where they are put.
pub struct PlacedFaces<'a> {
    placed: &'a [Placement],
    /// Island of each face.
    island: Vec<u32>,
    /// Index of each island's placement in the list.
    of_island: Vec<Option<usize>>,
}

impl<'a> PlacedFaces<'a> {
    /// Finds the placed islands; returns `None` without UVs or without placements. With [`Stacking::Keep`] islands that
    /// coincide exactly with a placed one go with it.
    pub fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        seams: &'a Seams,
        stacking: Stacking,
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
        if stacking == Stacking::Keep {
            place_stacks(&mut of_island, &island, uvs, seams.materials.as_deref());
        }
        Ok(Some(Self {
            placed,
            island,
            of_island,
        }))
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

/// Gives islands without a placement that of the first placed island with the same outline and material.
fn place_stacks(
    of_island: &mut [Option<usize>],
    island: &[u32],
    uvs: &[CornerUvs],
    materials: Option<&[u32]>,
) {
    let mut faces: Vec<Vec<u32>> = vec![Vec::new(); of_island.len()];
    for (face, &island) in (0..).zip(island) {
        faces[island as usize].push(face);
    }
    let material = |faces: &[u32]| {
        let of_first = faces.first().zip(materials);
        of_first.map(|(face, materials)| materials[*face as usize])
    };
    let outlines: Vec<_> = (faces.iter())
        .map(|faces| {
            let corners: Vec<CornerUvs> = faces.iter().map(|&face| uvs[face as usize]).collect();
            (material(faces), outline(&corners))
        })
        .collect();
    let mut placed = HashMap::new();
    for (outline, index) in outlines.iter().zip(&*of_island) {
        if let Some(index) = index {
            placed.entry(outline).or_insert(*index);
        }
    }
    for (outline, index) in outlines.iter().zip(of_island) {
        *index = index.or_else(|| placed.get(outline).copied());
    }
}

//! Islands named by the user, located in the meshes of a document.

use crate::arrays::placement::Placement;
use crate::island_error::IslandError;
use crate::options::Island;
use unwrapd_files::document::{Document, Group};

/// Returns for each group its islands with fixed placements.
pub fn placements(
    document: &Document,
    groups: &[Group],
    islands: &[Island],
) -> Result<Vec<Vec<Placement>>, IslandError> {
    let primitives = document.primitives();
    let mut placed = vec![Vec::new(); groups.len()];
    for (number, island) in islands.iter().enumerate() {
        let unknown = || IslandError::UnknownFace(number);
        let index = island.primitive as usize;
        let primitive = primitives.get(index).ok_or_else(unknown)?;
        if island.face as usize >= primitive.triangles.len() {
            return Err(unknown());
        }
        let is_inside = |group: &Group| group.primitives.contains(&index);
        let group = groups.iter().position(is_inside).ok_or_else(unknown)?;
        let before = (groups[group].primitives.iter()).take_while(|&&own| own != index);
        let first: usize = before.map(|&own| primitives[own].triangles.len()).sum();
        let face = first as u32 + island.face;
        placed[group].push(island.placement((number, face), document.v_axis()));
    }
    Ok(placed)
}

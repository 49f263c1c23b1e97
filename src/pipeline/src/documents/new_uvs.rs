//! Atlases as UVs of a document.

use crate::PipelineError;
use crate::arrays::repeated::GridCorners;
use crate::arrays::unwrap::Unwrapped;
use crate::options::Options;
use unwrapd_files::document::{Corners, Document, Group, Layout, NewUvs};
use unwrapd_layout::atlas::GRID_BITS;
use unwrapd_maps::mesh::VAxis;

/// Converts the atlases to UVs of the document. Islands that stay in place keep the document's UVs.
pub fn new_uvs(
    document: &Document,
    groups: &[Group],
    atlases: &[Unwrapped],
    options: &Options,
) -> Result<NewUvs, PipelineError> {
    let primitives = document.primitives();
    let v_axis = document.v_axis();
    let mut corners = vec![None; primitives.len()];
    for (group, atlas) in groups.iter().zip(atlases) {
        let (mut rest, mut still) = (atlas.grid.as_slice(), atlas.still.as_slice());
        let mut first = 0;
        for &index in &group.primitives {
            let (own, others) = rest.split_at(primitives[index].triangles.len());
            let mut uvs: Vec<Corners> = own.iter().map(|face| from_grid(face, v_axis)).collect();
            let next = first + own.len() as u32;
            let (inside, beyond) = still.split_at(still.partition_point(|&face| face < next));
            if !inside.is_empty()
                && let Some(given) = document.corner_uvs(index, options.sets.source())?
            {
                for face in inside.iter().map(|face| (face - first) as usize) {
                    // What is less than a step below a page lies on its border.
                    uvs[face] = given[face].map(|uv| uv.map(|x| (x as f32).max(0.0)));
                }
            }
            corners[index] = Some(uvs);
            (rest, still, first) = (others, beyond, next);
        }
    }
    Ok(NewUvs {
        layout: Layout::New,
        pages: options.layout.pages,
        v_axis,
        corners,
    })
}

/// Converts grid coordinates to UVs, exactly in f32.
fn from_grid(corners: &GridCorners, v_axis: VAxis) -> Corners {
    let side = 1 << GRID_BITS;
    let unit = |i: i32| i as f32 / side as f32;
    corners.map(|[u, v]| match v_axis {
        VAxis::Up => [unit(u), unit(v)],
        VAxis::Down => [unit(u), unit(side - v)],
    })
}

//! Packing of the charts of one mesh around islands that stay where they are put.

use super::chart_maps::chart_maps;
use super::packing::atlas_options;
use super::placed_faces::PlacedFaces;
use super::placement::Placement;
use super::plan::Plan;
use super::settings::Settings;
use super::soup::Soup;
use crate::PipelineError;
use crate::island_error::IslandError;
use unwrapd_layout::atlas::{
    Atlas, AtlasOptions, ConstraintError, Constraints, OnRead, Rotation, Stay, pack_within,
};
use unwrapd_layout::charts::MappedChart;
use unwrapd_maps::mesh::{CornerUvs, Resolution};
use unwrapd_method::numerics::bounds::bounds_of;

/// Packs charts around those of the islands in `placed`. Returns the packed charts first, then those that stay.
pub fn arranged(
    charts: Vec<MappedChart>,
    mesh: &Soup,
    placed: &PlacedFaces,
    (settings, plan, n_atlases): (&Settings, &Plan, usize),
    on_read: &OnRead,
) -> Result<(Vec<MappedChart>, Atlas), PipelineError> {
    let (placements, uvs) = (&mesh.seams.placed, mesh.seams.uvs.as_deref());
    let mut islands: Vec<Vec<MappedChart>> = vec![Vec::new(); placements.len()];
    let mut free = Vec::new();
    for chart in charts {
        let face = chart.chart.corners.first().map(|[corner, ..]| corner / 3);
        match face.and_then(|face| placed.index_of(face)) {
            Some(index) => islands[index].push(chart),
            None => free.push(chart),
        }
    }
    let mut charts = free;
    let n_free = charts.len();
    let mut owners = Vec::new();
    for ((index, placement), mut island) in placements.iter().enumerate().zip(islands) {
        if island.is_empty() {
            return Err(IslandError::UnknownFace(placement.number).into());
        }
        let texture = settings.layout.resolution;
        put(&mut island, placement, uvs.unwrap_or_default(), texture);
        owners.resize(owners.len() + island.len(), index);
        charts.extend(island);
    }
    let (free, staying) = charts.split_at(n_free);
    let stays = chart_maps(staying).into_iter().zip(owners);
    let stays: Vec<Stay> = (stays.map(|(map, island)| Stay { map, island })).collect();
    let options = atlas_options((settings, plan), n_atlases, free);
    // Other islands keep their angles, up to quarter turns, while one is arranged by hand.
    let options = AtlasOptions {
        rotation: match options.rotation {
            Rotation::Any => Rotation::Quarter,
            rotation => rotation,
        },
        ..options
    };
    let constraints = Constraints {
        stays: &stays,
        ..Constraints::default()
    };
    let atlas = pack_within(&chart_maps(free), &constraints, &options, on_read);
    let number = |island: usize| placements[island].number;
    let atlas = atlas.map_err(|error| match error {
        ConstraintError::OffPage { island } => IslandError::OffPage(number(island)).into(),
        ConstraintError::TooNear { islands, texels } => IslandError::TooNear {
            islands: islands.map(number),
            texels,
            padding: options.padding_texels,
        }
        .into(),
        ConstraintError::NoRoom | ConstraintError::Region { .. } => IslandError::NoRoom.into(),
        ConstraintError::Atlas(error) => PipelineError::Atlas(error),
    })?;
    Ok((charts, atlas))
}

/// Moves the charts of an island from their position in the file to their placement.
fn put(island: &mut [MappedChart], placement: &Placement, uvs: &[CornerUvs], texture: Resolution) {
    for chart in island.iter_mut() {
        let of_chart = chart.chart.disk.triangles.iter().zip(&chart.chart.corners);
        for (triangle, corners) in of_chart {
            for (&vertex, &corner) in triangle.iter().zip(corners) {
                let uv = uvs[corner as usize / 3][corner as usize % 3];
                chart.embedding.uv[vertex as usize] = uv;
            }
        }
    }
    let points = island.iter().flat_map(|chart| &chart.embedding.uv);
    let [low, high] = bounds_of(&points.copied().collect::<Vec<_>>());
    let middle = [0, 1].map(|k| f64::midpoint(low[k], high[k]));
    for chart in island {
        for uv in &mut chart.embedding.uv {
            *uv = placement.place(*uv, middle, texture);
        }
    }
}

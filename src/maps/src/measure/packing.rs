//! Coverage of the texture.

use super::coverage::coverage;
use super::size::in_unit_square;
use crate::certificate::UvTopology;
use serde::Serialize;

/// Coverage of the texture, counted at texel centers of a raster over the unit square (over the square that holds the UVs where they
/// leave it). A center on a common edge counts once.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Packing {
    /// Side of the raster in texels.
    pub raster_res: u32,
    /// Texels that at least one face covers.
    pub covered_texels: u64,
    /// Texels that two or more faces cover, over covered ones.
    pub overlap_frac: Option<f64>,
    /// Texels that two or more faces cover.
    pub overlap_texels: u64,
    /// The most faces that cover one texel.
    pub overlap_max_layers: u32,
    /// Covered part of the unit square; null when UVs leave it.
    pub pack_unit: Option<f64>,
    /// Covered part of the smallest axis-aligned square that could hold the UV bounding box.
    pub pack_square: f64,
    /// Covered part of the UV bounding box.
    pub pack_rect: f64,
}

impl Packing {
    pub(super) fn new(topology: &UvTopology, texels: u32, aspect: f64) -> Packing {
        let [low, high] = topology.bounds;
        let extent = topology.extent();
        let unit = in_unit_square(topology, aspect);
        let (origin, side) = if unit {
            ([0.0; 2], aspect.max(1.0))
        } else {
            (low, extent)
        };
        let counts = coverage(&topology.uvs, texels, origin, side);
        let covered = counts.covered as f64 * (side / f64::from(texels)).powi(2);
        let [width, height] = [0, 1].map(|axis| (high[axis] - low[axis]).max(1e-100));
        Packing {
            raster_res: texels,
            covered_texels: counts.covered,
            overlap_frac: (counts.covered > 0)
                .then(|| counts.covered_twice as f64 / counts.covered as f64),
            overlap_texels: counts.covered_twice,
            overlap_max_layers: counts.most_layers,
            pack_unit: unit.then_some(covered / aspect),
            pack_square: covered / (extent * extent),
            pack_rect: covered / (width * height),
        }
    }
}

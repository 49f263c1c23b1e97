//! Quality figures of a UV map: size, seams, validity, distortion, texel density, packing, overlap, gaps between
//! charts.
//!
//! [`measure`] judges positions, triangles and corner UVs of any origin; reports consist of its figures. Keys and
//! definitions are those of an independent script in NumPy (`uvmetrics`), so that the figures can be checked against
//! it:
//!
//! - Positions are welded by equality; charts, seams and winding are those of [`certificate`](crate::certificate).
//! - With a texture that is not square u is first multiplied by its width over its height: lengths are those of texels.
//! - UVs are scaled by s = √(A₃d / A_uv) before distortion is computed, so that total areas agree; σ₁ ≥ σ₂ are the
//!   singular values of a face's scaled map from the surface to UV. Means and percentiles are weighted by surface
//!   area.
//! - If faces have weights, the intended densities, the surface is enlarged by them for distortion and density;
//!   areas, means and seams stay those of the surface.
//! - A face is degenerate in 3D if its area is 0, below 10⁻⁹ of its longest edge squared, or below 10⁻¹⁴ of the
//!   bounding box diagonal squared. Such faces and those of zero UV area are excluded from distortion, but counted
//!   separately, so that a collapse cannot hide.
//! - Orientation and overlap are exact; everything else is a sum of f64. Figures that do not exist for a mesh are
//!   `None`.
pub mod cost;
mod distortion;
mod faces;
mod packing;
mod validity;

use crate::certificate::{Overlap, UvTopology};
use crate::mesh::{CornerUvs, VAxis};
pub use cost::LayoutCost;
pub use distortion::{Density, Distortion, FaceDistortion, face_distortion};
use faces::FaceMeasures;
pub use faces::Seams;
pub use packing::{Gaps, Packing, Page, Size};
use serde::Serialize;
pub use validity::{Overlaps, Validity};

/// Options of a measurement.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct MeasureOptions<'a> {
    /// Side of the raster on which packing and `overlap_frac` are counted, in texels; at most
    /// [`MeasureOptions::MAX_RASTER`].
    pub raster_texels: u32,
    /// Enables the count of overlapping pairs of faces.
    pub overlap: Overlap,
    /// Width of the texture over its height: u is multiplied by it, so that all lengths are in its texels.
    pub aspect: f64,
    /// Intended density of each face: the surface is enlarged by it before it is compared with UVs. Equal for all faces
    /// if absent.
    pub weights: Option<&'a [f64]>,
}

impl MeasureOptions<'_> {
    /// Largest raster: with 16 bits per texel its coordinates have 30 bits, and a scan line's sums of two products 62.
    pub const MAX_RASTER: u32 = 1 << 14;
}

impl Default for MeasureOptions<'_> {
    fn default() -> Self {
        MeasureOptions {
            raster_texels: 4096,
            overlap: Overlap::Test,
            aspect: 1.0,
            weights: None,
        }
    }
}

/// All figures of one UV map; serialized as one flat object.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Measures {
    /// Counts, areas and extents.
    #[serde(flatten)]
    pub size: Size,
    /// Boundary, seams and charts.
    #[serde(flatten)]
    pub seams: Seams,
    /// Flips, mirrored charts and faces without UV area.
    #[serde(flatten)]
    pub validity: Validity,
    /// Deviation of the map from an isometry.
    #[serde(flatten)]
    pub distortion: Distortion,
    /// Texels per length, chart against chart.
    #[serde(flatten)]
    pub density: Density,
    /// Coverage of the texture.
    #[serde(flatten)]
    pub packing: Packing,
    /// Overlapping faces.
    #[serde(flatten)]
    pub overlaps: Overlaps,
    /// Distances between charts.
    #[serde(flatten)]
    pub gaps: Gaps,
    /// Cost of the layout.
    #[serde(flatten)]
    pub cost: LayoutCost,
    /// The pages that hold charts: one where UVs lie in the unit square.
    pub pages: Vec<Page>,
    /// No face is flipped, degenerate, collapsed or without finite UVs.
    pub locally_injective: bool,
    /// Locally injective, and no faces overlap by more than rounding; null when overlaps were not searched.
    pub bijective: Option<bool>,
}

/// Measures the UVs of a mesh: `uvs[f][c]` belongs to `positions[triangles[f][c]]`.
///
/// Never fails: faces with a number that is not finite, or an index out of range, are counted in `uv_nonfinite_faces`
/// and measured as if their UVs were 0.
pub fn measure(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    uvs: &[CornerUvs],
    v_axis: VAxis,
    options: &MeasureOptions,
) -> Measures {
    // Lengths in texels.
    let aspect = options.aspect;
    let uvs: Vec<CornerUvs> = (uvs.iter())
        .map(|face| face.map(|[u, v]| [u * aspect, v]))
        .collect();
    let topology = UvTopology::new(positions, triangles, &uvs);
    let faces = FaceMeasures::new(&topology, options.weights);
    // Figures that others depend on.
    let size = Size::new(triangles, &topology, &faces, aspect);
    let validity = Validity::new(&topology, &faces, v_axis);
    let overlaps = Overlaps::new(&topology, options.overlap);
    let locally_injective = validity.flipped == 0
        && validity.uv_degenerate == 0
        && validity.uv_collapsed == 0
        && size.uv_nonfinite_faces == 0;
    let seams = Seams::new(&topology, &faces);
    let raster_texels = options.raster_texels.clamp(1, MeasureOptions::MAX_RASTER);
    let packing = Packing::new(&topology, raster_texels, aspect);
    Measures {
        cost: LayoutCost::new(&topology, &seams, &packing),
        seams,
        distortion: Distortion::new(&topology, &faces),
        density: Density::new(&topology, &faces),
        packing,
        gaps: Gaps::new(&topology, &faces, aspect),
        pages: packing::pages(&topology, &faces, aspect, |v| match v_axis {
            VAxis::Up => v,
            VAxis::Down => 1.0 - v,
        }),
        bijective: overlaps
            .overlap_pairs
            .map(|pairs| locally_injective && pairs == 0),
        locally_injective,
        size,
        validity,
        overlaps,
    }
}

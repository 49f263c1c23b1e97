//! Packs charts on the pages of a texture, on an integer grid.
//!
//! Chart maps are in mesh units, all at one density. Packing has four steps:
//!
//! 1. Simulated annealing searches for an order of the charts and an angle of each. Each arrangement is placed greedily on a coarse
//!    raster ([`CoarseLayout`]).
//! 2. All charts of a page move and turn at once until the page cannot shrink any more (`squeeze`).
//! 3. The distances between charts are measured, and corrected to exactly the padding (`gap`). If this fails, or if there are many
//!    charts, they are placed on a raster that keeps the padding by construction (`layout`). Charts around islands that stay are
//!    placed on such a raster as well (`around`).
//! 4. Vertices are rounded to multiples of 2⁻²³, which `f32` represents exactly (`grid`). Rounding may flip a thin triangle. Its
//!    vertices are then moved, as little as possible, until all triangles are positive in exact integer arithmetic.
//!
//! A chart is rounded once, before it is turned by quarters and shifted by whole grid units, so its signs hold at any place. If a
//! vertex had to move farther than the padding allows, the charts are laid out again with more room.
//!
//! Layouts have square cells of one size, whatever the shape of the pages: the steps of the grid are equally long along u and v on
//! the surface, and multiples of 2⁻²³ in u and v. Pages farther to the right have coarser floating-point numbers, so all pages use
//! the steps of the last one.
//!
//! Charts are never mirrored. All have the same scale, except those below a texel in size for which the grid would be too coarse.
mod around;
mod coarse;
mod copies;
mod effort;
mod enough;
mod gap;
mod grid;
mod layout;
mod mask;
mod occupancy;
mod outline;
mod pack;
mod page;
mod plan;
mod relax;
mod squeeze;

use serde::{Deserialize, Serialize};
use thiserror::Error;

pub use around::{AroundError, Stay, pack_around};
pub use coarse::CoarseLayout;
pub(crate) use effort::UNHEARD;
pub use effort::{Effort, OnRead};
pub use enough::{Enough, enough};
pub use pack::{expected_words, fits, pack, pack_coarse};
pub use page::Texture;
pub use relax::cleared;

/// Bits of the side of a page. Atlas coordinates are integers up to 2^GRID_BITS, the steps of `f32` in the unit square.
pub const GRID_BITS: u32 = 23;
/// Side of a page in grid units.
const GRID_SIDE: f64 = (1 << GRID_BITS) as f64;

/// Map of a chart: triangles over vertices in mesh units, counter-clockwise unless the given map is faulty.
#[derive(Clone, Copy, Debug)]
pub struct ChartMap<'a> {
    /// Position of each vertex in the plane.
    pub uv: &'a [[f64; 2]],
    /// Vertex indices.
    pub triangles: &'a [[u32; 3]],
}

/// Permitted rotations of charts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum Rotation {
    /// Any angle.
    #[default]
    Any,
    /// Quarter turns.
    Quarter,
    /// No rotation.
    None,
}

/// Positions of the bounding rectangles of charts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Borders {
    /// Anywhere.
    #[default]
    Free,
    /// On borders of texels. Charts are widened by less than a texel to each side. The sides of the texture are powers of two.
    OnTexels,
}

/// Scale of the charts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scale {
    /// As large as the texture allows.
    #[default]
    Largest,
    /// Texels per mesh unit.
    TexelsPerUnit(f64),
}

/// Options of an atlas.
#[derive(Clone, Debug, PartialEq)]
pub struct AtlasOptions {
    /// Texture, in whose texels the padding is counted.
    pub texture: Texture,
    /// Scale of the charts.
    pub scale: Scale,
    /// Smallest distance between two charts, in texels. Half of it is kept to the borders of pages.
    pub padding_texels: u32,
    /// Permitted rotations of charts.
    pub rotation: Rotation,
    /// Positions of the bounding rectangles of charts.
    pub borders: Borders,
    /// Multiple of the usual number of searches for the best order and angles, which depends on the charts.
    pub patience: u64,
    /// Maximum number of words that the search reads, about 3·10⁸ per second. A layout is found in any case.
    pub budget_words: u64,
    /// Maximum number of cells along the side of the raster for a few charts. With fewer cells, charts are placed sooner and less
    /// densely.
    pub most_cells: u32,
}

impl Default for AtlasOptions {
    fn default() -> Self {
        Self {
            texture: Texture::square(1024),
            scale: Scale::Largest,
            padding_texels: 2,
            rotation: Rotation::Any,
            borders: Borders::Free,
            patience: 1,
            budget_words: 500_000_000,
            most_cells: u32::MAX,
        }
    }
}

impl AtlasOptions {
    /// Returns the padding that charts are packed with, in texels.
    fn packed_texels(&self) -> u32 {
        match self.borders {
            Borders::Free => self.padding_texels,
            Borders::OnTexels => self.padding_texels + grid::ROOM_TEXELS,
        }
    }
}

/// Chart in the atlas.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placed {
    /// Position of each vertex in units of 2^-[`GRID_BITS`], v up; exact in `f32`.
    pub grid: Vec<[i32; 2]>,
}

/// All charts on their pages.
#[derive(Clone, Debug, PartialEq)]
pub struct Atlas {
    /// Charts in the given order.
    pub placed: Vec<Placed>,
    /// UV units per mesh unit along the longer side of the texture.
    pub scale: f64,
    /// Share of all pages that triangles cover.
    pub utilization: f64,
    /// Distance kept between charts, in texels: the requested one, or less if many charts leave no room for it.
    pub padding_texels: f64,
    /// Number of charts that were enlarged because they are too small for the grid.
    pub enlarged_charts: usize,
    /// Number of vertices that are not at the grid point nearest to their exact position, because a triangle would have lost its area
    /// or overlapped another one.
    pub moved_vertices: usize,
    /// Largest distance between a vertex and its exact position, in steps of the grid.
    pub largest_move: f64,
}

/// Error of charts that cannot be packed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum AtlasError {
    /// A coordinate, or the area, is not a finite number.
    #[error("chart {chart} has coordinates that are not finite")]
    NonFinite {
        /// Index of the chart.
        chart: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("chart {chart} has a triangle with a vertex that does not exist")]
    IndexOutOfRange {
        /// Index of the chart.
        chart: usize,
    },
    /// The finest raster cannot keep this many charts apart.
    #[error("one atlas cannot hold {charts} charts")]
    TooManyCharts {
        /// Number of charts.
        charts: usize,
    },
    /// The charts do not fit at the prescribed scale.
    #[error("the charts do not fit at this scale")]
    TextureTooSmall,
}

/// Returns twice the signed area of a grid triangle, exact.
fn doubled_area([a, b, c]: [[i32; 2]; 3]) -> i64 {
    let [ax, ay] = a.map(i64::from);
    let [bx, by] = b.map(i64::from);
    let [cx, cy] = c.map(i64::from);
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

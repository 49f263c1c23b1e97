//! Charts placed on the pages of a texture, on an integer grid.
//!
//! Chart maps arrive in mesh units, all at one density. The order in which they are placed and the
//! angle of each are searched on a coarse raster, a [`CoarseLayout`]. All charts of a page are then moved and turned at
//! once until the page gets no smaller, and their distances are measured. Where there are many charts, and
//! where that fails, they are packed at one scale by a conservative raster, with a gap that is counted in texels. Every
//! vertex is rounded to a multiple of 2⁻²³, which `f32` holds exactly. Rounding may take the area of
//! a triangle that was positive in `f64`: such places are repaired, vertices moving no farther than
//! they must, and what leaves this module is positive in exact integer arithmetic.
//!
//! Rounding is done once per chart, before it is turned by quarters and shifted by whole grid units,
//! so its signs hold wherever the chart lies. A vertex that had to move farther than the gap allows
//! for makes the charts be laid out again with that much more room.
//!
//! Everything is laid out in square cells of one size, whatever the shape of the pages: the grid on which charts are rounded has steps
//! that are equally long along u and v on the surface, each a multiple of 2⁻²³ in its coordinate. Pages farther to the right have
//! coarser floating point, so the steps of several pages are those that `f32` has on the last.
//!
//! Charts are never mirrored. None is scaled against the others, except those so small (below a
//! texel) that the grid has fewer than a handful of cells for each of their triangles.
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

/// Atlas coordinates are integers, the side of a page is 2^GRID_BITS: in the unit square those are the steps `f32` represents.
pub const GRID_BITS: u32 = 23;
/// The side of a page in grid units.
const GRID_SIDE: f64 = (1 << GRID_BITS) as f64;

/// One chart's map: triangles over vertices in mesh units, counter-clockwise but for those of maps that are faulty as given.
#[derive(Clone, Copy, Debug)]
pub struct ChartMap<'a> {
    /// The position of each vertex in the plane.
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

/// Where charts may end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Borders {
    /// Anywhere.
    #[default]
    Free,
    /// The bounding rectangle of each chart on borders of texels; charts are widened for it by less than a texel to each side. The
    /// sides of the texture are powers of two.
    OnTexels,
}

/// How large charts become.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scale {
    /// As large as the texture allows.
    #[default]
    Largest,
    /// So many texels to the mesh unit.
    TexelsPerUnit(f64),
}

/// How the atlas is laid out.
#[derive(Clone, Debug, PartialEq)]
pub struct AtlasOptions {
    /// The texture, in whose texels the padding is counted.
    pub texture: Texture,
    /// How large charts become.
    pub scale: Scale,
    /// Smallest distance between two charts, in texels; half of it is kept to the borders of pages.
    pub padding_texels: u32,
    /// Permitted rotations of charts.
    pub rotation: Rotation,
    /// Where charts may end.
    pub borders: Borders,
    /// Multiple of the usual effort of the search for the best order and angles, which depends on the number of charts.
    pub patience: u64,
    /// Words that the search may read at most, about 3·10⁸ a second; a layout is found in any case.
    pub budget_words: u64,
    /// Cells along the side of the raster on which a few charts are placed, at most: on fewer they are placed sooner and less full.
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
    /// The padding that charts are packed with, in texels.
    fn packed_texels(&self) -> u32 {
        match self.borders {
            Borders::Free => self.padding_texels,
            Borders::OnTexels => self.padding_texels + grid::ROOM_TEXELS,
        }
    }
}

/// One chart in the atlas.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placed {
    /// The position of each vertex in units of 2^-[`GRID_BITS`], v up; exact in `f32`.
    pub grid: Vec<[i32; 2]>,
}

/// All charts on their pages.
#[derive(Clone, Debug, PartialEq)]
pub struct Atlas {
    /// The charts, in the order they were given.
    pub placed: Vec<Placed>,
    /// UV units per mesh unit along the longer side of the texture.
    pub scale: f64,
    /// Share of all pages that triangles cover.
    pub utilization: f64,
    /// The distance that is kept between charts, in texels: what was asked for, or less where so
    /// many charts leave no room for it.
    pub padding_texels: f64,
    /// Charts too small for the grid that were enlarged.
    pub enlarged_charts: usize,
    /// Vertices that do not lie on the grid point next to their exact position, because a triangle
    /// would have lost its area there.
    pub moved_vertices: usize,
    /// The largest distance between a vertex and its exact position, in steps of the grid.
    pub largest_move: f64,
}

/// Charts that cannot be placed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum AtlasError {
    /// A coordinate, or the area, is not a finite number.
    #[error("chart {chart} has coordinates that are not finite")]
    NonFinite {
        /// Its index.
        chart: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("chart {chart} has a triangle with a vertex that does not exist")]
    IndexOutOfRange {
        /// Its index.
        chart: usize,
    },
    /// There are more charts than the finest raster can keep apart.
    #[error("one atlas cannot hold {charts} charts")]
    TooManyCharts {
        /// Their number.
        charts: usize,
    },
    /// At the scale asked for the charts do not fit.
    #[error("the charts do not fit at this scale")]
    TextureTooSmall,
}

/// Twice the signed area of a grid triangle, exact.
fn doubled_area([a, b, c]: [[i32; 2]; 3]) -> i64 {
    let [ax, ay] = a.map(i64::from);
    let [bx, by] = b.map(i64::from);
    let [cx, cy] = c.map(i64::from);
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

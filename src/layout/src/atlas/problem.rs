//! Packing problems: charts, options, results and errors.
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::page::{Region, Texture};

/// Number of texels by which alignment may bring two charts nearer: each point moves by at most one texel along each axis.
const ROOM_TEXELS: u32 = 3;

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

/// Use of the positions of given maps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Positions {
    /// None: the maps have nothing to do with each other.
    #[default]
    Unrelated,
    /// The maps form a layout. It counts if it is fuller, once squeezed, than those that a search finds.
    Layout,
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
    /// Use of the positions of the given maps.
    pub positions: Positions,
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
            positions: Positions::Unrelated,
            patience: 1,
            budget_words: 500_000_000,
            most_cells: u32::MAX,
        }
    }
}

impl AtlasOptions {
    /// Returns the padding that charts are packed with, in longer sides of a page.
    pub(super) fn padding_share(&self) -> f64 {
        f64::from(self.packed_texels()) / f64::from(self.texture.resolution.longer())
    }

    /// Returns the padding that charts are packed with, in texels.
    pub(super) fn packed_texels(&self) -> u32 {
        match self.borders {
            Borders::Free => self.padding_texels,
            Borders::OnTexels => self.padding_texels + ROOM_TEXELS,
        }
    }
}

/// Constraints on the positions of charts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Constraints<'a> {
    /// Group of each chart, any number. Charts of one group keep their positions relative to each other: the group is turned and shifted
    /// as one. Empty if each chart is on its own.
    pub groups: &'a [usize],
    /// Region that each chart must not leave, or `None` for any page; empty if no chart has a region. A group has the region of its
    /// first chart. Half of the padding is kept to the sides of a region.
    pub regions: &'a [Option<Region>],
    /// Charts that stay where they are.
    pub stays: &'a [Stay<'a>],
}

/// Chart that stays where it is.
#[derive(Clone, Copy, Debug)]
pub struct Stay<'a> {
    /// Map of the chart. Its unit is the longer side of a page, its origin the lower left corner of the first page.
    pub map: ChartMap<'a>,
    /// Island that the chart belongs to. Charts of one island keep no distance from each other.
    pub island: usize,
}

/// Chart in the atlas.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placed {
    /// Position of each vertex in units of 2^-[`GRID_BITS`](super::GRID_BITS), v up; exact in `f32`.
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
    /// Chart that alone sets the scale because it is as long as a page, if there is one.
    pub limit: Option<Limit>,
}

/// Chart that alone sets the scale of an atlas. Only a cut through it, or pages of another shape, make the atlas fuller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Index of the chart.
    pub chart: usize,
    /// Upper bound of the share of all pages that any layout of these charts covers.
    pub utilization: f64,
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

/// Error of charts that cannot be packed within constraints.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ConstraintError {
    /// A chart that stays extends beyond the page that holds its middle, or lies on no page.
    #[error("island {island} leaves its page")]
    OffPage {
        /// Island of the chart.
        island: usize,
    },
    /// Two charts that stay are nearer than the padding, or overlap.
    #[error("islands {} and {} are {texels} texels apart", islands[0], islands[1])]
    TooNear {
        /// Islands of the charts.
        islands: [usize; 2],
        /// Their distance; 0 if they overlap.
        texels: f64,
    },
    /// A region is empty or does not lie on one page.
    #[error("the region of chart {chart} does not lie on one page")]
    Region {
        /// Index of the chart.
        chart: usize,
    },
    /// The other charts do not fit.
    #[error("the other charts do not fit")]
    NoRoom,
    /// The charts cannot be placed on any page.
    #[error(transparent)]
    Atlas(#[from] AtlasError),
}

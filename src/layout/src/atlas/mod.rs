//! Packs charts on the pages of a texture, on an integer grid.
//!
//! Chart maps are in mesh units, all at one density. Packing has four steps:
//!
//! 1. Simulated annealing searches for an order of the charts and an angle of each. Each arrangement is placed greedily on a coarse
//!    raster ([`CoarseLayout`]).
//! 2. All charts of a page move and turn at once until the page cannot shrink any more (`squeeze`).
//! 3. The distances between charts are measured, and corrected to exactly the padding (`gap`).
//! 4. Vertices are rounded to multiples of 2⁻²³, which `f32` represents exactly (`grid`). Rounding may flip a thin triangle. Its
//!    vertices are then moved, as little as possible, until all triangles are positive in exact integer arithmetic.
//!
//! Charts with constraints (regions, groups, islands that stay: `constraints`) and crowds are not annealed: they are placed on a raster
//! that keeps the padding by construction (`layout`), and then take the last three steps like others. So does a layout that is packed
//! again, from where its charts lie (`given`). Thousands of charts, and those that cannot be squeezed, stay where the raster has them.
//! While islands are dragged, the others take the second step only (`live`).
//!
//! A chart is rounded at its final angle and then shifted by whole grid units, so its signs hold at any place. If a vertex had to move
//! farther than the padding allows, the charts are laid out again with more room.
//!
//! Layouts have square cells of one size, whatever the shape of the pages: the steps of the grid are equally long along u and v on
//! the surface, and multiples of 2⁻²³ in u and v. Pages farther to the right have coarser floating-point numbers, so all pages use
//! the steps of the last one.
//!
//! Charts are never mirrored. All have the same scale, except those below a texel in size for which the grid would be too coarse.
mod coarse;
mod constraints;
mod copies;
mod effort;
mod enough;
mod gap;
mod given;
mod grid;
mod layout;
mod live;
mod mask;
mod occupancy;
mod outline;
mod pack;
mod page;
mod plan;
mod problem;
mod relax;
mod squeeze;

pub use coarse::CoarseLayout;
pub use constraints::pack_within;
pub use effort::{Effort, OnRead};
pub use enough::{Enough, enough};
pub use live::{Followers, LiveLayout, Room};
pub use pack::{expected_words, fits, pack, pack_coarse};
pub use page::{GRID_BITS, Region, Texture};
pub use problem::{
    Atlas, AtlasError, AtlasOptions, Borders, ChartMap, ConstraintError, Constraints, Limit,
    Placed, Positions, Rotation, Scale, Stay,
};
pub use relax::cleared;

//! Where to cut.
//!
//! [`charts`] divides a surface into charts, each a proven [`Disk`]. Every triangle is in exactly one of them, whatever is
//! wrong with the surface.
//!
//! [`Cut::Disk`] makes one chart of every component: each manifold piece is opened to a disk, and the pieces that
//! non-manifold edges part are joined again at single edges. [`Cut::Fast`] divides the surface into regions whose normals lie
//! within a cone, so that each chart is nearly flat and hardly ever overlaps itself. [`Cut::Auto`] is the task of the
//! [search](crate::search).
//!
//! Rough surfaces, such as noisy scans, are cut as what they are samples of (`rough`): smoothed; then the true surface is mapped.
//!
//! With [`Symmetry::Auto`] it looks for the plane in which a surface is its own mirror image, exactly or nearly, and cuts both
//! sides alike (`symmetry`): openings run in the plane, slits come in pairs, and both sides are parted alike.
//!
//! [`Cut::Keep`] and [`Cut::Seams`] take the pieces into which a caller has cut the surface.
//!
//! Few charts are spiky, and spiky charts leave much of a square empty. [`MappedChart::best_split`] says where to cut one so that
//! its parts fill their convex hulls; whether that pays the atlas has to tell.
//!
//! Degenerate faces decide nothing: surfaces are cut without their needles, which are put back at the end ([`with_needles`]).
//!
//! No map that leaves this module overlaps itself ([`map_chart`]). Where one does, slight folds are pushed apart; for the others the
//! chart is cut along the cheapest seam that parts two of its sheets, a minimum cut of the dual graph, as often as it takes. Where
//! floating point finds no valid map, a chart is cut into [`halves()`].
//!
//! Where a caller asks for it, borders that are straight on the surface, or nearly so, become straight along the axes ([`straightened`]).
//!
//! Where a mesh has polygons, seams along their diagonals are moved to their sides at last ([`with_whole_polygons`]).

mod chart;
mod compact;
mod crease;
mod distortion;
mod facets;
mod halves;
mod mapped;
mod min_cut;
mod needles;
mod observer;
mod opened;
mod parts;
mod polygons;
mod quality;
mod redrawn;
mod regions;
mod rough;
mod straighten;
mod symmetry;
mod unfold;
mod up;

pub use chart::{Chart, Cut};
pub use compact::split::{Split, parted_alike, seam_length};
pub use halves::halves;
pub use mapped::{Folds, MappedChart, map_chart, map_chart_from};
pub use min_cut::min_cut;
pub use needles::with_needles;
pub use observer::{MapUnderway, Observer, Unobserved};
pub use opened::charts;
pub use polygons::{PolygonHome, with_whole_polygons};
pub use quality::{Bound, Bounded, Quality};
pub use redrawn::parted_along;
pub use rough::smoothed_where_rough;
pub use straighten::{Straighten, Straightened, straightened};
pub use symmetry::Symmetry;
pub use symmetry::plane::MirrorPlane;

pub(crate) use mapped::map_chart_by;
pub(crate) use observer::{Planning, Watching};
pub(crate) use symmetry::opening::ways_to_open_alike;
pub(crate) use symmetry::search::mirror_plane;
pub(crate) use symmetry::sheet_mirror::SheetMirror;
pub(crate) use symmetry::way::{Way, along, vertices_at};
pub(crate) use unfold::overlaps::overlaps;
pub(crate) use unfold::push_apart::all_pushed_apart;

#[cfg(doc)]
use unwrapd_maps::mesh::Disk;

//! Where to cut.
//!
//! [`charts`] divides a surface into charts, each a proven [`Disk`]. Every triangle is in exactly one of them, whatever is
//! wrong with the surface.
//!
//! [`Cut::Disk`] makes one chart of every component: each manifold piece is opened to a disk, and the pieces that
//! non-manifold edges part are joined again at single edges. [`Cut::Auto`] first divides the surface into regions whose
//! normals lie within a cone, so that each chart is nearly flat and hardly ever overlaps itself.
//!
//! A chart that turns out not to be mappable is cut into [`halves()`].

mod chart;
mod cone;
mod facets;
mod halves;
mod merge;
mod regions;
mod smooth;

pub use chart::{Chart, Cut, charts};
pub use halves::halves;

#[cfg(doc)]
use crate::mesh::Disk;

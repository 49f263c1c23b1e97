//! Planar meshes from pictures and drawings.
//!
//! A picture's opaque part ([`of_image`]) or a drawing's filled shapes ([`of_svg`]) become an [`Outline`]: closed
//! polygons that neither cross nor touch. [`triangulate()`] fills it with triangles of bounded angles. Coordinates are
//! pixels or user units with y down, as in the source; "counter-clockwise" means positive area in these numbers.
mod contour;
mod drawing;
mod error;
mod frame;
mod nesting;
mod transform;
mod triangulate;

pub use contour::{ImageSettings, of_image};
pub use drawing::{SvgSettings, of_svg};
pub use error::OutlineError;
use frame::Frame;
pub use triangulate::{MeshSettings, Resolution, triangulate};
use unwrapd_maps::plane::{doubled_polygon_area, meeting_point};

/// Most boundary vertices; more is noise, not a shape.
const MOST_VERTICES: usize = 1_000_000;

/// Most pieces and holes; each is compared with each.
const MOST_LOOPS: usize = 4096;

/// A region of the plane, possibly in several pieces and with holes, given by its boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    loops: Vec<Vec<[f64; 2]>>,
    frame: Frame,
}

impl Outline {
    /// Creates the region bounded by these closed polygons: the points inside an odd number of them.
    ///
    /// Vertices are rounded to 2⁻³⁶ of the outline's size, and those that then repeat the one before are left out.
    /// Directions do not matter: pieces come out counter-clockwise, holes clockwise. Refuses polygons that cross or
    /// touch themselves or each other, exactly, and coordinates beyond 1e100.
    pub fn new(loops: Vec<Vec<[f64; 2]>>) -> Result<Self, OutlineError> {
        let frame = Frame::of(&loops)?;
        let mut loops: Vec<Vec<[f64; 2]>> = loops
            .into_iter()
            .map(|l| frame.polygon(l))
            .filter(|vertices| vertices.len() >= 3)
            .collect();
        let n_vertices: usize = loops.iter().map(Vec::len).sum();
        if loops.is_empty() {
            return Err(OutlineError::Empty);
        }
        if n_vertices > MOST_VERTICES || loops.len() > MOST_LOOPS {
            return Err(OutlineError::TooDetailed);
        }
        if let Some(at) = meeting_point(&loops) {
            return Err(OutlineError::SelfIntersecting { at });
        }
        nesting::orient(&mut loops);
        Ok(Self { loops, frame })
    }

    /// Returns the boundary polygons without their closing vertex, with the region on their left.
    pub fn loops(&self) -> &[Vec<[f64; 2]>] {
        &self.loops
    }

    /// Returns the area of the region.
    pub fn area(&self) -> f64 {
        0.5 * self
            .loops
            .iter()
            .map(|l| doubled_polygon_area(l))
            .sum::<f64>()
    }
}

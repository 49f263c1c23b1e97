//! Planar meshes from pictures and drawings.
//!
//! A picture's opaque part ([`of_image`]) or a drawing's filled shapes ([`of_svg`]) become an [`Outline`]: closed
//! polygons that neither cross nor touch. [`triangulate()`] fills it with triangles of bounded angles. Coordinates are
//! pixels or user units with y down, as in the source; "counter-clockwise" means positive area in these numbers.
mod contour;
mod drawing;
mod triangulate;

pub use contour::{ImageSettings, of_image};
pub use drawing::{SvgSettings, of_svg};
pub use triangulate::{MeshSettings, OutlineResolution, triangulate};
use unwrapd_files::picture::ImageError;
use unwrapd_maps::plane::{doubled_polygon_area, meeting_point};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of};

/// Most boundary vertices; more is noise, not a shape.
const MOST_VERTICES: usize = 1_000_000;

/// Most pieces and holes; each is compared with each.
const MOST_LOOPS: usize = 4096;

/// A region of the plane, possibly in several pieces and with holes, given by its boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    loops: Vec<Vec<[f64; 2]>>,
    frame: OutlineFrame,
}

impl Outline {
    /// Creates the region bounded by these closed polygons: the points inside an odd number of them.
    ///
    /// Vertices are rounded to 2⁻³⁶ of the outline's size, and those that then repeat the one before are left out.
    /// Directions do not matter: pieces come out counter-clockwise, holes clockwise. Refuses polygons that cross or
    /// touch themselves or each other, exactly, and coordinates beyond 1e100.
    pub fn new(loops: Vec<Vec<[f64; 2]>>) -> Result<Self, OutlineError> {
        let frame = OutlineFrame::of(&loops)?;
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
        orient(&mut loops);
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

/// Reason why a picture or drawing gives no mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// The picture cannot be decoded.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The picture has no pixel that is opaque enough, or the drawing no filled shape.
    #[error("there is nothing to outline")]
    Empty,
    /// The drawing is not SVG that can be read.
    #[error("invalid SVG: {0}")]
    InvalidSvg(String),
    /// A filled path has a part that does not return to its start.
    #[error("path {path} of the drawing is open")]
    OpenPath {
        /// Number of the shape, from 1 in the order of the document.
        path: usize,
    },
    /// Two boundary lines cross or touch.
    #[error("the outline crosses or touches itself near ({}, {})", at[0], at[1])]
    SelfIntersecting {
        /// A vertex of one of them.
        at: [f64; 2],
    },
    /// There are too many boundary vertices or pieces.
    #[error("the outline has too many vertices, pieces or holes")]
    TooDetailed,
    /// The requested resolution needs too many triangles, or cannot be reached.
    #[error("the mesh would have more than {0} triangles")]
    TooManyTriangles(usize),
    /// A number that must be positive is not.
    #[error("{0} must be a positive number")]
    InvalidSetting(&'static str),
    /// Triangles became flat by rounding: details too small for their distance from the origin.
    #[error("the details of the outline are too small for its coordinates")]
    TooFine,
}

impl OutlineError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Image(error) => error.code(),
            Self::Empty => "empty_outline",
            Self::InvalidSvg(_) => "invalid_svg",
            Self::OpenPath { .. } => "open_path",
            Self::SelfIntersecting { .. } => "self_intersecting_outline",
            Self::TooDetailed => "outline_too_detailed",
            Self::TooManyTriangles(_) => "too_many_triangles",
            Self::InvalidSetting(_) => "invalid_setting",
            Self::TooFine => "outline_too_fine",
        }
    }
}

// The square in which an outline is processed.

/// Steps of the grid of boundary vertices along the side of the frame.
const STEPS: f64 = (1_u64 << 36) as f64;
/// Upper limit of coordinates: products of two stay finite.
const LIMIT: f64 = 1e100;

/// A square around an outline, to be moved to [1, 2]²: no coordinate there is too small or too large for exact
/// predicates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OutlineFrame {
    low: [f64; 2],
    /// A power of two.
    pub side: f64,
}

impl OutlineFrame {
    pub fn of(loops: &[Vec<[f64; 2]>]) -> Result<Self, OutlineError> {
        let boxes: Vec<[f64; 2]> = loops.iter().flat_map(|l| bounds_of(l)).collect();
        let [low, high] = bounds_of(&boxes);
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        if !low.iter().chain(&high).all(|x| x.abs() < LIMIT) || extent <= 1.0 / LIMIT {
            return Err(if loops.is_empty() {
                OutlineError::Empty
            } else {
                OutlineError::TooFine
            });
        }
        // A little larger, as rounding may move vertices out.
        let side = (extent * (1.0 + 2.0 / STEPS)).log2().ceil().exp2();
        let step = side / STEPS;
        Ok(Self {
            low: low.map(|x| (x / step - 0.5).floor() * step),
            side,
        })
    }

    /// Returns a closed polygon on the grid, without vertices that equal the next. Far from the origin, where
    /// floating-point numbers are sparser than the grid, it is not rounded.
    pub fn polygon(&self, mut vertices: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        let step = self.side / STEPS;
        for p in &mut vertices {
            *p = p.map(|x| (x / step).round() * step);
        }
        vertices.dedup();
        while vertices.len() > 1 && vertices.first() == vertices.last() {
            vertices.pop();
        }
        vertices
    }

    /// Maps a rounded point into [1, 2]², without further rounding.
    pub fn enter(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| 1.0 + (p[k] - self.low[k]) / self.side)
    }

    /// Maps a point of [1, 2]² back.
    pub fn leave(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.low[k] + (p[k] - 1.0) * self.side)
    }
}

// Nesting of disjoint polygons.

/// Winding numbers of disjoint closed polygons around points that lie on no polygon.
pub(super) struct Windings<'a> {
    loops: &'a [Vec<[f64; 2]>],
    boxes: Vec<Bounds>,
}

impl<'a> Windings<'a> {
    pub fn new(loops: &'a [Vec<[f64; 2]>]) -> Self {
        let boxes = loops.iter().map(|l| bounds_of(l)).collect();
        Self { loops, boxes }
    }

    /// Returns the winding number of polygon `of` around a point that is not on it.
    pub fn around(&self, point: [f64; 2], of: usize) -> i32 {
        let [low, high] = self.boxes[of];
        if (0..2).any(|k| point[k] < low[k] || high[k] < point[k]) {
            return 0;
        }
        let vertices = &self.loops[of];
        (0..vertices.len())
            .map(|k| crossing(point, vertices[k], vertices[(k + 1) % vertices.len()]))
            .sum()
    }
}

/// Returns +1 where an edge passes upwards to the right of the point, −1 downwards; half open, so that a vertex counts
/// once.
fn crossing(point: [f64; 2], a: [f64; 2], b: [f64; 2]) -> i32 {
    use unwrapd_method::numerics::predicates::orient2d_sign;
    match (a[1] <= point[1], b[1] <= point[1]) {
        (true, false) => i32::from(orient2d_sign(a, b, point) > 0),
        (false, true) => -i32::from(orient2d_sign(a, b, point) < 0),
        _ => 0,
    }
}

/// Turns disjoint polygons so that the region inside an odd number of them lies on their left.
fn orient(loops: &mut [Vec<[f64; 2]>]) {
    let windings = Windings::new(loops);
    let is_hole: Vec<bool> = (0..loops.len())
        .map(|k| {
            let around = (0..loops.len()).filter(|&other| other != k);
            let n: i32 = around.map(|o| windings.around(loops[k][0], o).abs()).sum();
            n % 2 == 1
        })
        .collect();
    for (vertices, is_hole) in loops.iter_mut().zip(is_hole) {
        if (doubled_polygon_area(vertices) < 0.0) != is_hole {
            vertices.reverse();
        }
    }
}

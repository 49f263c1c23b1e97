//! Pictures pulled by handles.
//!
//! [`picture_grid`] makes the mesh on which a picture is deformed; [`picture::warped`](unwrapd_files::picture::warped)
//! draws the deformed picture. [`warp_picture`] does both.

use super::body::{Boundary, locate};
use super::handle::{self, Handle};
use crate::body::Body;
use crate::line::{HeldPoint, held_points};
use crate::problem::Model;
use crate::problem_error::ProblemError;
use crate::pull::{Grip, Holds, How, PullSummary, pull};
use crate::region::{Line, Region};
use serde::{Deserialize, Serialize};
use unwrapd_files::picture::{Deformation, Extent, Image, ImageError, Warped, warped};
use unwrapd_maps::mesh::PlanarMesh;
use unwrapd_method::solver::Watch;

// A picture pulled by handles.

/// Most handles: each is looked for in every triangle of the grid.
const MOST_HANDLES: usize = 1000;
/// Largest coordinate of a target, in pixels.
const FARTHEST: f64 = 1e9;

/// Settings of a warp.
#[derive(Clone, Debug, PartialEq)]
pub struct WarpOptions {
    /// Cells along the longer side, 1 to 512.
    pub grid: usize,
    /// Treatment of the picture's border. If it is free, the result shows all of the warped picture; if it is fixed, no
    /// two places of the picture can come to lie on each other, and the result is as large as the picture.
    pub boundary: Boundary,
    /// Energy and barrier, for a mean triangle of an area from ½ to 2.
    pub model: Model,
    /// See [`Problem::search`](crate::Problem::search).
    pub search: bool,
}

impl Default for WarpOptions {
    fn default() -> Self {
        Self {
            grid: 40,
            boundary: Boundary::Free,
            model: Model::default(),
            search: false,
        }
    }
}

/// A part of a picture and where it goes, in pixels, (0, 0) the upper left corner, y down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(untagged, deny_unknown_fields)]
pub enum PictureHandle {
    /// A point.
    Point {
        /// A place in the picture.
        #[serde(deserialize_with = "handle::planar")]
        at: [f64; 2],
        /// Where it goes.
        #[serde(deserialize_with = "handle::planar")]
        to: [f64; 2],
        /// Strength of a soft handle, greater than 0; without it the handle comes to its target
        /// exactly. The energy grows by `weight` times the mean squared distance of what the handle
        /// holds from its targets, for a mean triangle of area 1.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// A disc, a box or an outline that keeps its shape.
    Region(Region),
    /// A line.
    Line(Line),
}

impl PictureHandle {
    /// Returns the strength of a soft handle.
    fn weight(&self) -> Option<f64> {
        match self {
            Self::Point { weight, .. } => *weight,
            Self::Region(region) => region.weight(),
            Self::Line(line) => line.weight,
        }
    }
}

/// Returns the handle of the grid, a body in pixels.
impl From<PictureHandle> for Handle {
    fn from(handle: PictureHandle) -> Self {
        match handle {
            PictureHandle::Point { at, to, weight } => Self::Point {
                at: at.to_vec(),
                to: to.to_vec(),
                weight,
            },
            // y points down.
            PictureHandle::Region(region) => region.mirrored().into(),
            PictureHandle::Line(line) => line.into(),
        }
    }
}

/// Parses `{"handles": [{"at": [x, y], "to": [x, y]}, {"center": [x, y], "radius": r, "to": [x, y], "turn": degrees},
/// {"low": [x, y], "high": [x, y], "to": [x, y]}, {"outline": [[x, y], …], "to": [x, y]}, {"line": [[x, y], …], "to":
/// [[x, y], …]}, …]}`.
pub fn parse_handles(json: &[u8]) -> Result<Vec<PictureHandle>, WarpError> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct PictureHandlesFile {
        handles: Vec<PictureHandle>,
    }
    let file: PictureHandlesFile =
        unwrapd_api::from_json(json).map_err(|error| WarpError::Malformed(error.to_string()))?;
    Ok(file.handles)
}

/// Reason why a picture cannot be warped.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WarpError {
    /// The file is not a list of handles.
    #[error("the handles cannot be parsed: {0}")]
    Malformed(String),
    /// There are no handles, or too many.
    #[error("there are {0} handles; 1 to {MOST_HANDLES} are allowed")]
    HandleCount(usize),
    /// A handle is not in the picture.
    #[error("handle {0} lies outside the picture")]
    HandleOutside(usize),
    /// The target of a handle is not a position, or a region has no size or turns too far.
    #[error(
        "handle {0} must have finite numbers up to 1e9 pixels, low below high, a positive weight and enough corners, and turn by at most 180 degrees"
    )]
    BadTarget(usize),
    /// A region holds no vertex that may move.
    #[error("handle {0} holds no part of the grid inside its border; it needs more cells")]
    EmptyRegion(usize),
    /// All vertices of the grid are on its border, which is fixed.
    #[error("the grid has no vertex inside its border")]
    NothingInside,
    /// There is no grid of this size.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The picture cannot be read or becomes too large.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The handles contradict each other, or a number is out of range.
    #[error(transparent)]
    Problem(#[from] ProblemError),
}

impl WarpError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Malformed(_) => "malformed_handles",
            Self::HandleCount(_) => "handle_count",
            Self::HandleOutside(_) => "handle_outside",
            Self::BadTarget(_) => "bad_target",
            Self::EmptyRegion(_) => "empty_region",
            Self::NothingInside => "grid_too_coarse",
            Self::Grid(error) => error.code(),
            Self::Image(error) => error.code(),
            Self::Problem(error) => error.code(),
        }
    }
}

/// A warped picture and the map by which it was warped.
#[derive(Clone, Debug)]
pub struct PictureWarp {
    /// Warped picture.
    pub picture: Warped,
    /// The grid on the original, in pixels, y down.
    pub grid: PlanarMesh,
    /// Vertices of the grid after the warp, in pixels.
    pub deformed: Vec<[f64; 2]>,
    /// Summary of the pull.
    pub summary: PullSummary,
}

/// Warps a picture: deforms a grid over it without inverting a triangle while the handles go to their targets.
///
/// A point pulls itself, a region the vertices of the grid inside it, but not those of a fixed border. Only next to a fixed
/// border, where most of a point's weight is fixed, it pulls the nearest free vertex instead, whose target is the handle's
/// shifted by the same offset. Handles at one place must
/// agree. Targets that cannot be reached end in
/// [`Status::TargetsUnreachable`](unwrapd_method::solver::Status::TargetsUnreachable) with a valid map, and
/// [`PullSummary::unreached`] names their handles.
pub fn warp_picture(
    image: &Image,
    handles: &[PictureHandle],
    options: &WarpOptions,
    watch: &dyn Watch,
) -> Result<PictureWarp, WarpError> {
    warp_picture_from(image, None, handles, options, watch)
}

/// Like [`warp_picture`], but the pull starts where a session left the vertices of the grid.
pub fn warp_picture_from(
    image: &Image,
    start: Option<&[[f64; 2]]>,
    handles: &[PictureHandle],
    options: &WarpOptions,
    watch: &dyn Watch,
) -> Result<PictureWarp, WarpError> {
    let grid = picture_grid(image.width, image.height, options.grid)?;
    let start = start.unwrap_or(grid.vertices());
    let (deformed, summary) = warp_grid(&grid, start, handles, options, watch)?;
    let deformation = Deformation {
        rest: grid.vertices(),
        deformed: &deformed,
        triangles: grid.triangles(),
    };
    let extent = match options.boundary {
        Boundary::Free => Extent::Mesh,
        Boundary::Fixed => Extent::Source,
    };
    Ok(PictureWarp {
        picture: warped(image, &deformation, extent)?,
        grid,
        deformed,
        summary,
    })
}

/// Returns the deformed vertices of a picture's grid and a summary.
fn warp_grid(
    grid: &PlanarMesh,
    start: &[[f64; 2]],
    handles: &[PictureHandle],
    options: &WarpOptions,
    watch: &dyn Watch,
) -> Result<(Vec<[f64; 2]>, PullSummary), WarpError> {
    if !(1..=MOST_HANDLES).contains(&handles.len()) {
        return Err(WarpError::HandleCount(handles.len()));
    }
    let size = grid.vertices().last().copied().unwrap_or_default();
    // A power of two, so that nothing is rounded on the way there and back.
    let unit = mean_area(grid).sqrt().log2().round().exp2();
    let to_unit = |p: [f64; 2]| p.map(|x| x / unit);
    let scale =
        |places: &[[f64; 2]]| -> Vec<[f64; 2]> { places.iter().map(|&p| to_unit(p)).collect() };
    let body = Body::planar(&scale(grid.vertices()), grid.triangles());
    // Hold the border, then let each handle take hold of its place.
    let mut holds = Holds::new(
        options
            .boundary
            .held(grid.vertices().len(), grid.triangles()),
    );
    let is_line = |handle: &PictureHandle| matches!(handle, PictureHandle::Line(_));
    let (lines, others): (Vec<_>, Vec<_>) = handles
        .iter()
        .enumerate()
        .partition(|(_, handle)| is_line(handle));
    // Lines come last: they leave out what other handles hold.
    for (index, handle) in others.into_iter().chain(lines) {
        let weight = handle.weight();
        let (place, is_valid) = match handle {
            PictureHandle::Point { at, to, .. } => (*at, to.iter().all(|x| x.abs() <= FARTHEST)),
            PictureHandle::Region(region) => (region.center(), region.is_valid(FARTHEST)),
            PictureHandle::Line(line) => {
                let first = line.line.first().copied();
                (first.unwrap_or_default(), line.is_valid(FARTHEST))
            }
        };
        if !(0..2).all(|k| (0.0..=size[k]).contains(&place[k])) {
            return Err(WarpError::HandleOutside(index));
        }
        if !is_valid || weight.is_some_and(|w| !(w > 0.0 && w.is_finite())) {
            return Err(WarpError::BadTarget(index));
        }
        let held = match handle {
            PictureHandle::Point { at, to, .. } => {
                vec![held_at(&holds, &body, to_unit(*at), to_unit(*to))?]
            }
            PictureHandle::Region(region) => {
                let region = region.clone().mirrored();
                let places = (0..).zip(grid.vertices());
                let inside = places.filter(|&(v, &p)| !holds.is_fixed(v) && region.contains(p));
                inside
                    .map(|(v, &p)| (vec![(v, 1.0)], to_unit(region.moved(p))))
                    .collect()
            }
            PictureHandle::Line(line) => {
                let is_taken = holds.taken(grid.vertices().len());
                let (line, to) = (scale(&line.line), scale(&line.to));
                held_points(&body, &line, &to, |v| is_taken[v as usize])
                    .ok_or(WarpError::BadTarget(index))?
            }
        };
        if held.is_empty() {
            return Err(WarpError::EmptyRegion(index));
        }
        holds.pull(index, held, weight);
    }
    // Pull, and convert back to pixels.
    let how = How {
        model: &options.model,
        search: options.search,
        unit,
    };
    let pulled = pull(body, &scale(start), &holds, &how, watch)?;
    let deformed = pulled.vertices.iter().map(|p| p.map(|x| x * unit));
    Ok((deformed.collect(), pulled.summary))
}

fn mean_area(grid: &PlanarMesh) -> f64 {
    let size = grid.vertices().last().map_or(1.0, |p| p[0] * p[1]);
    size / grid.triangles().len() as f64
}

/// Returns what a handle at a place holds, and its target.
fn held_at(
    holds: &Holds,
    body: &Body,
    at: [f64; 2],
    to: [f64; 2],
) -> Result<HeldPoint<2>, WarpError> {
    let vertices: &[[f64; 2]] = body.rest.as_chunks().0;
    let nearest = || nearest(vertices, |v| !holds.is_fixed(v), at).ok_or(WarpError::NothingInside);
    let vertex = match locate(body, at).map_or(Grip::Fixed, |row| holds.grip(row)) {
        Grip::Point(row) => return Ok((row, to)),
        Grip::Vertex(vertex) => vertex,
        Grip::Fixed => nearest()?,
    };
    let place = vertices[vertex as usize];
    let target = [0, 1].map(|k| to[k] + (place[k] - at[k]));
    Ok((vec![(vertex, 1.0)], target))
}

/// Returns the free vertex nearest to a point; the first of equally near ones.
fn nearest(vertices: &[[f64; 2]], is_free: impl Fn(u32) -> bool, point: [f64; 2]) -> Option<u32> {
    let distance = |v: u32| {
        let [dx, dy] = [0, 1].map(|k| vertices[v as usize][k] - point[k]);
        dx * dx + dy * dy
    };
    let free = (0..vertices.len() as u32).filter(|&v| is_free(v));
    free.min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
}

// The mesh on which a picture is deformed.

/// Most cells along the longer side: half a million triangles.
const MOST_CELLS: usize = 512;

/// Reason why a picture gets no grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GridError {
    /// The picture has no pixel.
    #[error("the picture has no pixels")]
    Empty,
    /// The number of cells is zero or too large.
    #[error("`grid` must be between 1 and 512 cells, not {0}")]
    Cells(usize),
}

impl GridError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Empty => "empty_image",
            Self::Cells(_) => "invalid_setting",
        }
    }
}

/// Creates a grid of nearly square cells over a picture, `n_cells` along its longer side, two triangles each.
///
/// In pixels, with (0, 0) at the picture's upper left corner and y down; vertices row by row. The diagonals alternate,
/// so that no direction is preferred.
pub fn picture_grid(width: usize, height: usize, n_cells: usize) -> Result<PlanarMesh, GridError> {
    if width == 0 || height == 0 {
        return Err(GridError::Empty);
    }
    if !(1..=MOST_CELLS).contains(&n_cells) {
        return Err(GridError::Cells(n_cells));
    }
    let [w, h] = [width as f64, height as f64];
    let cells = |side: f64| ((side / w.max(h) * n_cells as f64).round() as u32).max(1);
    let (columns, rows) = (cells(w), cells(h));
    let place = |side: f64, k: u32, n: u32| side * f64::from(k) / f64::from(n);
    let vertices = (0..=rows)
        .flat_map(|j| (0..=columns).map(move |i| [place(w, i, columns), place(h, j, rows)]))
        .collect();
    let triangles = (0..rows)
        .flat_map(|j| (0..columns).map(move |i| (i, j)))
        .flat_map(|(i, j)| {
            let a = j * (columns + 1) + i;
            let (b, c, d) = (a + 1, a + columns + 2, a + columns + 1);
            if (i + j).is_multiple_of(2) {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            }
        })
        .collect();
    PlanarMesh::new(vertices, triangles).map_err(|_| GridError::Cells(n_cells))
}

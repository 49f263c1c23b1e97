//! Readers of triangle, polygon and tetrahedral meshes in text and binary files.
//!
//! Bytes in, plain arrays or a [`ReadError`] out; nothing is opened, nothing panics, and memory is bounded by a small
//! multiple of the input: a count that a file claims is never trusted, it only says when to stop. Polygons become
//! triangles inside them ([`polygon`](super::polygon)), in the order of the file. Coordinates are parsed as `f64` and,
//! for surfaces to unwrap, rounded to `f32` once, −0 becoming 0: the positions that are welded, mapped and measured are
//! those that are written. Meshes to deform ([`Elements`]) keep their `f64`.
mod cursor;
mod detect;
mod elements;
mod faces;
pub mod gmsh;
pub mod medit;
pub mod obj;
pub mod off;
pub mod ply;
pub mod stl;
pub mod tet;
pub mod vtu;

use cursor::{lines, number, three_numbers, words};
pub use detect::{ElementFormat, detect, format_of_content};
pub use elements::{Elements, text_positions};
use faces::{Coordinate, Faces, any_position, position};
pub use faces::{Fanned, IndexedTriangles, ReadError};
pub use unwrapd_api::{Content, Format, SEARCHED_BYTES, extension, without_mark};
pub use vtu::CellData;

//! Readers of triangle, polygon and tetrahedral meshes in text and binary files.
//!
//! Bytes in, plain arrays or a [`ReadError`] out; nothing is opened, nothing panics, and memory is bounded by a small
//! multiple of the input: a count that a file claims is never trusted, it only says when to stop. Polygons become
//! triangles inside them ([`polygon`](super::polygon)), in the order of the file. Coordinates are parsed as `f64` and,
//! for surfaces to unwrap, rounded to `f32` once, −0 becoming 0: the positions that are welded, mapped and measured are
//! those that are written. Meshes to deform ([`Elements`]) keep their `f64`.
mod cursor;
mod detect;
mod element_format;
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

pub use detect::{detect, format_of_content};
pub use element_format::ElementFormat;
pub use elements::{Elements, text_positions};
use faces::Faces;
pub use faces::Fanned;
pub use unwrapd_api::{Content, Format, SEARCHED_BYTES, extension, without_mark};
pub use vtu::CellData;

/// Positions and triangles of one file, in the file's order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct IndexedTriangles<T = f32> {
    /// Vertex positions.
    pub positions: Vec<[T; 3]>,
    /// Three vertex indices for each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Polygons without an inside.
    pub fanned: Fanned,
}

/// Reason why a file cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    /// The file does not follow its format.
    #[error("{format}, {place} {at}: {cause}")]
    Malformed {
        /// Name of the format.
        format: &'static str,
        /// Unit of `at`: `line` or `byte`.
        place: &'static str,
        /// Position of the error; lines count from 1.
        at: usize,
        /// Description of the error.
        cause: &'static str,
    },
    /// A coordinate is NaN, infinite or, if stored as `f32`, beyond its range.
    #[error("vertex {vertex} has a coordinate that is not a finite number")]
    NonFinitePosition {
        /// Index of the vertex, from 0.
        vertex: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("a face names vertex {index}, but there are only {n_vertices}")]
    IndexOutOfRange {
        /// Index of the vertex, from 0.
        index: i64,
        /// Number of vertices in the file.
        n_vertices: usize,
    },
}

impl ReadError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Malformed { .. } => "invalid_mesh",
            Self::NonFinitePosition { .. } => "non_finite_position",
            Self::IndexOutOfRange { .. } => "index_out_of_range",
        }
    }
}

/// Number types of coordinates.
trait Coordinate: Copy + Default {
    const NAN: Self;

    /// Returns the nearest such number, without a negative zero; `None` if that is not finite.
    fn nearest(x: f64) -> Option<Self>;

    fn to_f64(self) -> f64;
}

impl Coordinate for f32 {
    const NAN: Self = Self::NAN;

    fn nearest(x: f64) -> Option<Self> {
        Some(x as f32 + 0.0).filter(|x| x.is_finite())
    }

    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

impl Coordinate for f64 {
    const NAN: Self = Self::NAN;

    fn nearest(x: f64) -> Option<Self> {
        Some(x + 0.0).filter(|x| x.is_finite())
    }

    fn to_f64(self) -> f64 {
        self
    }
}

/// Converts a position of a file, without negative zeros; coordinates that are not finite become NaN. [`Faces::filled`]
/// refuses faces with such a corner: a vertex that no face uses may hold anything.
fn any_position<T: Coordinate>(coordinates: [f64; 3]) -> [T; 3] {
    coordinates.map(|x| T::nearest(x).unwrap_or(T::NAN))
}

/// Converts a position of a file, which must be finite, without negative zeros.
fn position<T: Coordinate>(coordinates: [f64; 3], vertex: usize) -> Result<[T; 3], ReadError> {
    match coordinates.map(T::nearest) {
        [Some(x), Some(y), Some(z)] => Ok([x, y, z]),
        _ => Err(ReadError::NonFinitePosition { vertex }),
    }
}

/// Iterates over the lines of a text, numbered from 1; `\n`, `\r\n` and `\r` all end a line.
fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut rest = bytes;
    let mut number = 0;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let end = rest.iter().position(|&b| b == b'\n' || b == b'\r');
        let line = &rest[..end.unwrap_or(rest.len())];
        let ending = match end {
            None => 0,
            Some(e) if rest[e..].starts_with(b"\r\n") => 2,
            Some(_) => 1,
        };
        rest = &rest[line.len() + ending..];
        number += 1;
        Some((number, line))
    })
}

/// Iterates over the words of a line, separated by blanks.
fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// Parses a number in a text; `nan` and `inf` count as numbers here, [`position`] refuses them.
fn number<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Parses three numbers from the next three words.
fn three_numbers<'a>(words: &mut impl Iterator<Item = &'a [u8]>) -> Option<[f64; 3]> {
    Some([
        number(words.next()?)?,
        number(words.next()?)?,
        number(words.next()?)?,
    ])
}

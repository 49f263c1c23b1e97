//! Frames and meshes as bytes, little-endian.
//!
//! ```text
//! frame   0  u8   2                          mesh   0  u8   1
//!         1  u8   bytes of a coordinate: 4, 8       1  u8   coordinates of a vertex: 2, 3
//!         2  u8   0 moving, 1 settled, 2 unreached  2  u8   corners of an element: 3, 4
//!         3  u8   coordinates of a vertex: 2, 3     3  u8   1 with a skin
//!         4  u32  iterations of the session         4  u32  vertices
//!         8  u32  last message contained            8  u32  elements
//!        12  u32  flips                            12  u32  triangles
//!        16  f64  energy                           16  u32  vertices of the skin
//!        24  f64  smallest element                 20  u32  columns of the picture
//!        32  u32  vertices                         24  u32  rows of the picture
//!        36  u32  0                                28  u32  0
//!        40  coordinates, f32 or f64               32  rest coordinates f64; corners of elements, of triangles,
//!                                                      of the skin's vertices u32; their weights f32
//! ```

use unwrapd_deform::{Body, BodyElements};
use unwrapd_method::numerics::predicates::{orient2d_sign, orient3d_sign};
use unwrapd_method::solver::Stage;
use unwrapd_pipeline::Skin;

/// First byte of a mesh.
const MESH: u8 = 1;
/// First byte of a frame.
const FRAME: u8 = 2;

/// Elements. Triangles may have required signs of their areas, 0 for any; without signs all must be positive.
pub(super) enum FrameElements<'a> {
    Triangles(&'a [[u32; 3]], Option<Vec<i8>>),
    Tetrahedra(&'a [[u32; 4]]),
}

/// Data that a client needs once.
pub(super) struct Drawn<'a> {
    /// Coordinates at rest.
    pub rest: Vec<f64>,
    /// Triangles to draw.
    pub triangles: &'a [[u32; 3]],
    /// Skin that follows the elements.
    pub skin: Option<&'a Skin>,
    /// Columns and rows of the picture.
    pub picture: Option<[usize; 2]>,
}

/// Header of a frame.
pub(super) struct FrameHeader {
    pub stage: Stage,
    pub step: u32,
    pub message: u32,
    pub energy: f64,
    pub smallest: f64,
}

impl<'a> FrameElements<'a> {
    /// Returns the elements of a body, which must all be positive.
    pub fn of_body(body: &'a Body) -> Self {
        match &body.elements {
            BodyElements::Triangles { corners, .. } => Self::Triangles(corners, None),
            BodyElements::Tetrahedra { corners, .. } => Self::Tetrahedra(corners),
        }
    }

    fn dim(&self) -> usize {
        match self {
            Self::Triangles(..) => 2,
            Self::Tetrahedra(_) => 3,
        }
    }

    /// Counts the elements without their required orientation, exactly.
    fn flips(&self, x: &[f64]) -> u32 {
        let flips = match self {
            Self::Triangles(triangles, signs) => {
                let points: &[[f64; 2]] = x.as_chunks().0;
                let flipped = triangles.iter().enumerate().filter(|(index, t)| {
                    let [a, b, c] = t.map(|v| points[v as usize]);
                    let sign = signs.as_ref().map_or(1, |signs| signs[*index]);
                    sign != 0 && orient2d_sign(a, b, c) != sign
                });
                flipped.count()
            }
            Self::Tetrahedra(tets) => {
                let points: &[[f64; 3]] = x.as_chunks().0;
                let flipped = tets.iter().filter(|t| {
                    let [a, b, c, d] = t.map(|v| points[v as usize]);
                    orient3d_sign(a, b, c, d) <= 0
                });
                flipped.count()
            }
        };
        flips as u32
    }
}

/// Encodes a frame. Rounds coordinates to f32 unless that would flip an element; `flips` counts the encoded numbers.
pub(super) fn frame(header: &FrameHeader, elements: &FrameElements, x: &[f64]) -> Vec<u8> {
    // Choose the precision, and count flips on the coordinates that are sent.
    let rounded: Vec<f64> = x.iter().map(|&x| f64::from(x as f32)).collect();
    let mut flips = elements.flips(&rounded);
    let width = if flips == 0 { 4 } else { 8 };
    if flips > 0 {
        flips = elements.flips(x);
    }
    let stage = match header.stage {
        Stage::Moving => 0,
        Stage::Settled => 1,
        Stage::Unreachable => 2,
    };
    let dim = elements.dim();
    // Write the header, then the coordinates.
    let mut bytes = Vec::with_capacity(40 + width * x.len());
    bytes.extend([FRAME, width as u8, stage, dim as u8]);
    for number in [header.step, header.message, flips] {
        bytes.extend(number.to_le_bytes());
    }
    for number in [header.energy, header.smallest] {
        bytes.extend(number.to_le_bytes());
    }
    for number in [(x.len() / dim) as u32, 0] {
        bytes.extend(number.to_le_bytes());
    }
    match width {
        4 => bytes.extend(x.iter().flat_map(|&x| (x as f32).to_le_bytes())),
        _ => bytes.extend(x.iter().flat_map(|x| x.to_le_bytes())),
    }
    bytes
}

/// Encodes a mesh.
pub(super) fn mesh(drawn: &Drawn, elements: &FrameElements) -> Vec<u8> {
    let (corners, n_corners): (&[u32], usize) = match elements {
        FrameElements::Triangles(triangles, _) => (triangles.as_flattened(), 3),
        FrameElements::Tetrahedra(tets) => (tets.as_flattened(), 4),
    };
    let dim = elements.dim();
    let skin: (&[_], &[_]) = match drawn.skin {
        Some(skin) => (&skin.corners, &skin.weights),
        None => (&[], &[]),
    };
    // Write the header.
    let mut bytes = vec![
        MESH,
        dim as u8,
        n_corners as u8,
        u8::from(drawn.skin.is_some()),
    ];
    let picture = drawn.picture.unwrap_or_default();
    let counts = [
        drawn.rest.len() / dim,
        corners.len() / n_corners,
        drawn.triangles.len(),
        skin.0.len(),
        picture[0],
        picture[1],
        0,
    ];
    for count in counts {
        bytes.extend((count as u32).to_le_bytes());
    }
    // Write coordinates, then indices, then weights.
    bytes.extend(drawn.rest.iter().flat_map(|x| x.to_le_bytes()));
    let skin_corners: &[[u32; 4]] = skin.0;
    for list in [
        corners,
        drawn.triangles.as_flattened(),
        skin_corners.as_flattened(),
    ] {
        bytes.extend(list.iter().flat_map(|v| v.to_le_bytes()));
    }
    let weights: &[[f64; 4]] = skin.1;
    let weights = weights.as_flattened().iter();
    bytes.extend(weights.flat_map(|&w| (w as f32).to_le_bytes()));
    bytes
}

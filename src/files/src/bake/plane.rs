//! Sources of a texture for a new UV map.

use super::{Corners, Frames, Texture};
use crate::document::Encoding;

/// Texture of a face and, for each of its corners, the place in it, in texels.
#[derive(Clone, Copy)]
pub struct Sampled {
    /// Index of the texture.
    pub texture: u32,
    /// Places of the corners.
    pub corners: Corners,
}

/// Textures on the old map that are merged into one on the new map.
pub struct Plane<'a> {
    /// Encoding of the texels.
    pub encoding: Encoding,
    /// Old textures.
    pub textures: Vec<Texture<'a>>,
    /// Source of each face; `None` for faces without a texture.
    pub faces: Vec<Option<Sampled>>,
    /// Frames to which directions are relative; only for normal maps.
    pub frames: Option<Frames>,
}

//! What a texture for a new UV map is made from.

use super::{Corners, Frames, Texture};
use crate::document::Encoding;

/// What a face shows: a texture and, for each of its corners, the place in it, in texels.
#[derive(Clone, Copy)]
pub struct Sampled {
    /// Index of the texture.
    pub texture: u32,
    /// Places of the corners.
    pub corners: Corners,
}

/// Textures on the old map, which go together into one on the new map.
pub struct Plane<'a> {
    /// What the texels are.
    pub encoding: Encoding,
    /// The old textures.
    pub textures: Vec<Texture<'a>>,
    /// What each face shows; `None` shows nothing.
    pub faces: Vec<Option<Sampled>>,
    /// For directions, the frames they are relative to.
    pub frames: Option<Frames>,
}

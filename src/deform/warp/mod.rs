//! Pictures pulled by handles.
//!
//! [`picture_grid`] makes the mesh on which a picture is deformed; what the picture looks like afterward is drawn by
#![cfg_attr(
    feature = "files",
    doc = "[`picture::warped`](crate::picture::warped). [`warp_picture`] does both."
)]
#![cfg_attr(not(feature = "files"), doc = "the feature `files`.")]

mod grid;
#[cfg(feature = "files")]
mod picture;

pub use grid::{GridError, picture_grid};
#[cfg(feature = "files")]
pub use picture::{
    PictureHandle, PictureWarp, WarpError, WarpOptions, parse_handles, warp_picture,
    warp_picture_from,
};

//! Pictures pulled by handles.
//!
//! [`picture_grid`] makes the mesh on which a picture is deformed; [`picture::warped`](unwrapd_files::picture::warped)
//! draws the deformed picture. [`warp_picture`] does both.

mod grid;
mod picture;

pub use grid::{GridError, picture_grid};
pub use picture::{
    PictureHandle, PictureWarp, WarpError, WarpOptions, parse_handles, warp_picture,
    warp_picture_from,
};

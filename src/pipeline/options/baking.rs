//! Whether textures are resampled, and into what.

use crate::options::options;
use crate::pipeline::rebake::{ImageFormat, MOST_SIDE};

options! {
    /// Whether textures are resampled, and into what.
    #[derive(Copy)]
    pub struct Baking under "UV sets and textures" {
        /// Resample the textures for the new UVs, which then replace set 0 unless `texcoord` names
        /// another.
        ///
        /// Textures that cannot be read or are of an unknown kind stay, and so do the UVs that they
        /// sample; the report lists them.
        pub rebake: bool, arg(help_heading = None::<&'static str>);
        /// Texels along the sides of resampled textures. If absent, `resolution`, or the power of
        /// two up to 4096 at which the surface has as many texels as it had, whichever is more.
        pub bake_size: Option<u32>, in 16..=8192, value "TEXELS";
        /// The format of resampled textures: that of the images that they are made of, or one for
        /// all.
        pub image_format: ImageFormat = ImageFormat::Source;
    }
}

const _: () = assert!(MOST_SIDE == 8192);

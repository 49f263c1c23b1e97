//! Options of texture resampling.

use crate::rebake::{ImageFormat, MOST_SIDE};
use unwrapd_api::options::options;

options! {
    /// Resampling of textures.
    #[derive(Copy)]
    pub struct Baking under "UV sets and textures" {
        /// Resample the textures for the new UVs, which then replace set 0 unless `texcoord` names
        /// another.
        ///
        /// Textures that cannot be read, or of an unknown kind, stay as they are and keep their
        /// UVs. The report lists them.
        pub rebake: bool, arg(help_heading = None::<&'static str>);
        /// Side of the resampled textures, in texels. The default is `resolution`, or more if the
        /// surface would lose texels: a power of two up to 4096.
        pub bake_size: Option<u32>, in 16..=8192, value "TEXELS";
        /// File format of the resampled textures: that of the source images, or one format for all.
        pub image_format: ImageFormat = ImageFormat::Source;
    }
}

const _: () = assert!(MOST_SIDE == 8192);

//! Which UVs are read and written.

use crate::options::options;

options! {
    /// Which UV sets are read and written.
    #[derive(Copy)]
    pub struct Sets under "UV sets and textures" {
        /// The UV set whose islands are kept; 0 if absent.
        pub source_texcoord: Option<u32>, in 0..=7, value "N";
        /// The UV set to write; if absent 0 where no texture samples it, else the next free one.
        pub texcoord: Option<u32>, in 0..=7, value "N";
        /// Replace the UV set even if textures sample it.
        pub overwrite: bool;
    }
}

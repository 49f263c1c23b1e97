//! Options for the UV sets that are read and written.

use unwrapd_api::options::options;

options! {
    /// UV sets to read and write.
    #[derive(Copy)]
    pub struct Sets under "UV sets and textures" {
        /// The UV set that provides the islands. The default is 0.
        pub source_texcoord: Option<u32>, in 0..=7, value "N";
        /// The UV set to write. The default is set 0 if no texture samples it, otherwise the next
        /// free set.
        pub texcoord: Option<u32>, in 0..=7, value "N";
        /// Replace the UV set even if textures sample it.
        pub overwrite: bool;
    }
}

impl Sets {
    /// Returns the UV set that provides the islands.
    pub(crate) fn source(self) -> u32 {
        self.source_texcoord.unwrap_or(0)
    }
}

//! Options of the atlas layout.

use serde::{Deserialize, Serialize};

use unwrapd_api::options::{options, within};
use unwrapd_layout::atlas::Texture;
use unwrapd_maps::mesh::Resolution;

/// Search budget for the fullest layout.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum PackingMode {
    /// The default search budget: at most a few processor seconds per mesh.
    #[default]
    Fast,
    /// Ten times that budget.
    Tight,
}

impl PackingMode {
    /// Returns the factor on the usual search budget.
    pub(crate) fn passes(self) -> u64 {
        match self {
            Self::Fast => 1,
            Self::Tight => 10,
        }
    }
}

options! {
    /// Layout of the charts on a texture.
    #[derive(Copy)]
    pub struct Layout under "Atlas" {
        /// Texture size that `padding` refers to: the side in texels, or width and height. The
        /// ratio of the sides must be a power of two.
        ///
        /// Texels are square on the surface.
        pub resolution: Resolution = Resolution::square(1024), value "N|WxH", arg(help_heading = None::<&'static str>);
        /// Minimum distance between two charts, in texels. Charts keep half of it from the borders
        /// of a page. At most an eighth of the shorter side.
        pub padding: u32 = 2, in 0..=8192, value "TEXELS",
            arg(help_heading = None::<&'static str>, value_parser = padding_texels);
        /// Number of texture pages. Page k covers u from k to k + 1, the UDIM tile 1001 + k. All
        /// pages have the same texel density.
        pub pages: u32 = 1, in 1..=10, value "N";
        /// Mean number of texels per unit of length of the mesh. The default is the highest density
        /// that fits. A texture that is too small is an error.
        pub texels_per_unit: Option<f64>, in 1e-9..=1e9, value "T";
        /// Search budget for the fullest layout.
        pub packing: PackingMode = PackingMode::Fast;
    }
}

const _: () = assert!(Texture::MOST_PAGES == 10);

impl Layout {
    /// Checks dependencies between options. The error names the option.
    pub(crate) fn check(&self) -> Result<(), String> {
        check_texels(self.resolution, self.padding)
    }
}

/// Checks a resolution, and a padding in its texels.
pub(super) fn check_texels(resolution: Resolution, padding: u32) -> Result<(), String> {
    for side in [resolution.width, resolution.height] {
        within("resolution", f64::from(side), 16.0, 65_536.0)?;
    }
    if !resolution.is_regular() {
        let most = Resolution::MOST_ELONGATED;
        return Err(format!(
            "the sides of `resolution` must differ by a power of two up to {most}, not {resolution}"
        ));
    }
    let most = f64::from(most_padding(resolution));
    within("padding", f64::from(padding), 0.0, most)
        .map_err(|text| format!("{text}: at `resolution` {resolution}, {MOST_PADDING}"))
}

/// Bound on the padding, in words.
const MOST_PADDING: &str = "an eighth of the shorter side is the most";

/// Parses a padding as it is typed. Its upper bound depends on the resolution and is checked with it.
#[cfg(feature = "schema")]
pub(super) fn padding_texels(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| {
        format!("a padding is a whole number of texels from 0 on; {MOST_PADDING}, 128 at 1024")
    })
}

/// Returns the maximum padding in texels.
fn most_padding(resolution: Resolution) -> u32 {
    resolution.shorter() / 8
}

/// Checks a padding that holds for `mips` further mip levels.
pub(super) fn check_mips(padding: u32, mips: u32, resolution: Resolution) -> Result<(), String> {
    check_texels(resolution, padding)?;
    let (texels, most) = (u64::from(padding) << mips, most_padding(resolution));
    if texels <= u64::from(most) {
        return Ok(());
    }
    Err(format!(
        "`mips` {mips} turns `padding` {padding} into {texels} texels at `resolution` {resolution}, \
         which allows {most}: use `mips` up to {}, a smaller `padding` or a larger `resolution`",
        (most / padding).ilog2()
    ))
}

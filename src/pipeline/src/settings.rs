//! Options of the atlas layout.

use serde::{Deserialize, Serialize};
use std::sync::Arc;
use unwrapd_api::options::{options, within};
use unwrapd_layout::atlas::{Rotation, Texture};
use unwrapd_layout::charts::{Bound, Bounded, Cut, Quality, Symmetry};
use unwrapd_maps::embed;
use unwrapd_maps::mesh::Resolution;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::{Density, DensityKind};

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

/// Islands that share their texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum Stacking {
    /// None: islands that lie on each other are separated.
    #[default]
    Off,
    /// Islands that coincide stay together.
    Keep,
    /// Parts and charts that are equal but for a rigid motion are mapped once and stacked, too.
    Identical,
    /// Parts that are mirror images of each other, too.
    Mirrored,
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
        /// Islands that share their texels, stacked on each other. off: none. keep: those that
        /// coincide stay together, which requires `cut` keep and `kept_maps` as-given. identical:
        /// parts of one shape and material are mapped once, too; parts are what is connected, and
        /// the charts into which that is cut. Shapes may differ by a rigid motion, by the triangles
        /// of flat areas, and by a ten-thousandth of their radius or what the rounding of their
        /// coordinates explains, up to a thousandth. mirrored: mirror images, too. The default is
        /// keep for `repack`, otherwise off.
        pub stack: Option<Stacking>;
        /// Move all islands of a stack but the first by one tile along u, so that baking tools draw
        /// the first one alone. Textures repeat, so they still share its texels, and the report is
        /// about the UVs with that tile taken off again.
        ///
        /// Requires `pages` 1, and `stack` keep, identical or mirrored.
        pub stack_offset: bool;
        /// Permitted rotations of charts in the layout. Without rotation, new charts have the top of
        /// the mesh up, and islands keep their angles.
        pub rotate: Rotation = Rotation::Any;
    }
}

const _: () = assert!(Texture::MOST_PAGES == 10);

impl Layout {
    /// Checks dependencies between options. The error names the option.
    pub(crate) fn check(&self) -> Result<(), String> {
        check_texels(self.resolution, self.padding)?;
        let is_stacked = self.stack.is_some_and(|stack| stack != Stacking::Off);
        if self.stack_offset && !(is_stacked && self.pages == 1) {
            let text = "`stack_offset` requires `pages` 1, and `stack` keep, identical or mirrored";
            return Err(text.to_owned());
        }
        Ok(())
    }

    /// Returns the number of tiles that charts may lie on.
    pub(crate) fn tiles(&self) -> u32 {
        self.pages + u32::from(self.stack_offset)
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

// Options of cutting.

/// Treatment of the maps of kept islands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum KeptMaps {
    /// Optimize each map from its present position.
    #[default]
    Optimized,
    /// Keep the shape of each map: it is rotated, shifted and scaled by one common factor. Its defects stay, too.
    AsGiven,
}

options! {
    /// Where to cut.
    #[derive(Copy)]
    pub struct Cutting under "Where to cut" {
        /// Where to cut. auto: few charts under a distortion bound. fast: more charts in less time.
        /// disk: one chart per component. keep: the present UV islands. seams: along `seams`.
        pub cut: Cut = Cut::Auto, arg(help_heading = None::<&'static str>);
        /// Distortion bound of `cut` auto: a mean symmetric Dirichlet energy of at most 4.05, 4.1
        /// or 4.5. An isometry has 4.
        ///
        /// Where a surface is rough, as a noisy scan is, the bound is one on the smoothed surface,
        /// unless `max_distortion` or `max_stretch` is given. The report says so.
        pub quality: Quality = Quality::Balanced, arg(help_heading = None::<&'static str>);
        /// Slit each component to this many cone singularities with `cut` disk: where the scale of
        /// its map differs most. More cones lower the distortion, and their slits lengthen the
        /// seams.
        ///
        /// A closed component of genus 0 has at least two. A hole that does not lie flat counts as
        /// one. There are fewer where nothing is distorted. A map that overlaps itself is parted.
        /// `max_distortion` chooses their number instead.
        pub cones: Option<u32>, in 0..=10_000, value "N";
        /// Treatment of the map of each island with `cut` keep.
        pub kept_maps: KeptMaps = KeptMaps::Optimized;
        /// Maximum number of charts that `cut` auto makes per atlas. If more are needed, it allows
        /// more distortion, up to one chart per component.
        pub max_charts: Option<u32>, in 1..=1e9, value "N";
        /// Bound on the mean symmetric Dirichlet energy, in place of the one that `quality` sets.
        /// An isometry has 4.
        ///
        /// With `cut` disk, components are slit to as many cone singularities as keep it. Requires
        /// `cut` auto or disk. The report says whether the bound was kept.
        pub max_distortion: Option<f64>, in 4.0001..=1e6, value "E";
        /// Bound on the 99th percentile of the stretch max(σ₁, 1/σ₂), weighted by area. Charts are
        /// cut until they keep it.
        ///
        /// Requires `cut` auto. The report says whether the bound was kept.
        pub max_stretch: Option<f64>, in 1.001..=1e6, value "S";
        /// Price of seams that are cut only to fill the atlas better. With 0 every gain is taken; a
        /// large number prevents such cuts.
        pub seam_weight: f64 = 1.0, in 0..=1e6, value "W";
        /// Let `cut` auto cut both sides of a mirror plane alike. auto: where a surface is its own
        /// mirror image, exactly or nearly, and does not consist of panels. off: nowhere.
        pub symmetry: Symmetry = Symmetry::Auto;
    }
}

impl Cutting {
    /// Returns the bound on the distortion of the atlas.
    pub fn bound(&self) -> Bound {
        Bound {
            mean: self.max_distortion.unwrap_or(self.quality.bound()),
            stretch: self.max_stretch,
            of: match (self.max_distortion, self.max_stretch) {
                (None, None) => Bounded::Smoothed,
                _ => Bounded::Surface,
            },
        }
    }

    /// Checks dependencies between options. The error names the option.
    pub(crate) fn check(&self) -> Result<(), String> {
        if self.cones.is_some() && self.cut != Cut::Disk {
            return Err("`cones` requires `cut` disk".to_owned());
        }
        if self.cones.is_some() && self.max_distortion.is_some() {
            return Err("`cones` and `max_distortion` exclude each other".to_owned());
        }
        if self.max_distortion.is_some() && !matches!(self.cut, Cut::Auto | Cut::Disk) {
            return Err("`max_distortion` requires `cut` auto or disk".to_owned());
        }
        if self.max_stretch.is_some() && self.cut != Cut::Auto {
            return Err("`max_stretch` requires `cut` auto".to_owned());
        }
        Ok(())
    }
}

// Options of chart mapping.

options! {
    /// Mapping of the charts.
    pub struct Mapping under "Energy and barrier" {
        /// Distortion energy to minimize: a name, or a formula of the singular values of a triangle,
        /// s1 and s2, as `(s1 - 1)^2 + (s2 - 1)^2`. A formula must be symmetric, and smooth and
        /// minimal at 1. Bounds on distortion are bounds on the symmetric Dirichlet energy, whichever
        /// energy is minimized.
        pub energy: DensityKind = DensityKind::SymmetricDirichlet, arg(value_parser = unwrapd_api::options::WordOrText::<DensityKind>::new());
        /// Barrier that keeps every triangle from inverting. With none, for comparison, flipped
        /// triangles are written and the result is not certified.
        pub barrier: BarrierKind = BarrierKind::InverseSpline;
        /// Barrier strength β. The default is 0.01, for symmetric-dirichlet 0.02, and 1e-8 for
        /// conformal energies (lscm, mips): at their minimum triangles are far from the rest sizes
        /// that the barrier prefers.
        pub barrier_strength: Option<f64>, in 1e-9..=1e9, value "BETA";
        /// Support s of the inverse-spline barrier, relative to the rest area of an element.
        pub barrier_support: f64 = 1.0, in 1e-6..=1e6, value "S";
        /// Lower the barrier strength as long as the energy without the barrier falls.
        pub barrier_continuation: bool;
        /// Vertices of each chart to hold fixed, on the boundary and far apart: 0 or 2.
        /// Least-squares conformal maps (`energy` lscm) need 2, which requires `cut` disk.
        pub pin: u32 = 0, value "N", schema(maximum = 2);
        /// Keep the map bijective when tools round texture coordinates to this many bits: 12, 14 or
        /// 16. Thin triangles and narrow gaps are opened as far as possible.
        ///
        /// The report says whether that is proven, and which faces are in doubt. Requires a single
        /// page.
        pub quantization_safe: Option<u32>, value "BITS", arg(help_heading = "Atlas"),
            schema(minimum = 12, maximum = 16, multiple_of = 2);
    }
}

/// β beside the symmetric Dirichlet energy: the paper's 0.01 is meant for energies that have half of its curvature.
const SYMMETRIC_DIRICHLET_BETA: f64 = 0.02;

impl Mapping {
    /// Returns β: the one given, or that which fits the energy and its density.
    pub(crate) fn beta(&self, density: &dyn Density<2>) -> f64 {
        self.barrier_strength.unwrap_or(match self.energy {
            DensityKind::SymmetricDirichlet => SYMMETRIC_DIRICHLET_BETA,
            _ => embed::default_beta(density),
        })
    }

    /// Returns the energy of a triangle. The error names the option.
    pub(crate) fn density(&self) -> Result<Arc<dyn Density<2>>, String> {
        self.energy.planar().map_err(|error| {
            format!("`energy` is neither the name of an energy nor the formula of one: {error}")
        })
    }

    /// Checks the energy and dependencies between options. The error names the option.
    pub(crate) fn check(&self, cut: Cut) -> Result<(), String> {
        self.density()?;
        match self.quantization_safe {
            None | Some(12 | 14 | 16) => {}
            Some(bits) => {
                return Err(format!(
                    "`quantization_safe` must be 12, 14 or 16, not {bits}"
                ));
            }
        }
        match (self.pin, cut) {
            (0, _) | (2, Cut::Disk) => Ok(()),
            (2, _) => Err("`pin` 2 requires `cut` disk".to_owned()),
            (pin, _) => Err(format!("`pin` must be 0 or 2, not {pin}")),
        }
    }
}

// Options for threads and time.

options! {
    /// Number of threads.
    #[derive(Copy)]
    pub struct Workers under "Time" {
        /// Number of threads. The default is all that are allowed. The result does not depend on
        /// it.
        pub threads: Option<usize>, in 1..=1024, value "N";
    }
}

options! {
    /// Time limit.
    #[derive(Copy)]
    pub struct Budget under "Time" {
        /// Time limit in seconds. When it is reached, the current map, which is valid, becomes the
        /// result.
        pub time_budget: Option<f64>, in 0..=1e6, value "SECONDS";
    }
}

//! How a mesh given as arrays is unwrapped.

use serde::{Deserialize, Serialize};

use crate::atlas::{Borders, Texture};
use crate::barrier::BarrierKind;
use crate::charts::{Bound, Cut, Quality};
use crate::energy::EnergyKind;
use crate::mesh::Resolution;

/// How long the fullest layout of an atlas is searched for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub enum PackingMode {
    /// Two to three seconds of the processor.
    #[default]
    Fast,
    /// Ten times as long.
    Tight,
}

impl PackingMode {
    /// How often the words that a fast search reads.
    pub(super) fn passes(self) -> u64 {
        match self {
            Self::Fast => 1,
            Self::Tight => 10,
        }
    }
}

/// What becomes of the maps of islands that are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub enum KeptMaps {
    /// They are optimized from where they lie.
    #[default]
    Optimized,
    /// They stay as they are but for quarter turns, shifts and one scale; whatever is wrong with them stays too.
    AsGiven,
}

/// How a mesh given as arrays is unwrapped.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Distortion energy to minimize.
    pub energy: EnergyKind,
    /// Barrier that keeps every triangle from inverting.
    pub barrier: BarrierKind,
    /// Weight β of the barrier.
    pub barrier_strength: f64,
    /// Support s of the barrier, relative to an element's rest area.
    pub barrier_support: f64,
    /// Where to cut.
    pub cut: Cut,
    /// What becomes of the maps of islands with [`Cut::Keep`].
    pub kept_maps: KeptMaps,
    /// Vertices of each chart's boundary that are held, far from each other: 0, or with [`Cut::Disk`] 2.
    pub pin: u32,
    /// How distorted the atlas may be with [`Cut::Auto`].
    pub quality: Quality,
    /// The largest mean symmetric Dirichlet energy with [`Cut::Auto`] in the place of what `quality` says; 4 is an isometry.
    pub max_distortion: Option<f64>,
    /// The largest stretch max(σ₁, 1/σ₂) of all but a hundredth of the area with [`Cut::Auto`], cut for where it can be had.
    pub max_stretch: Option<f64>,
    /// How long the fullest layout is searched for.
    pub packing: PackingMode,
    /// The price of a seam where charts are cut so that the atlas becomes fuller: 0 cuts wherever that gains anything, a
    /// large number never.
    pub seam_weight: f64,
    /// Charts that [`Cut::Auto`] may make of a mesh; for that it allows more distortion.
    pub max_charts: Option<u32>,
    /// The texture that `padding` is counted in.
    pub resolution: Resolution,
    /// Pages of that texture that charts may lie on: page k covers u from k to k + 1.
    pub pages: u32,
    /// Texels along one unit of length of the mesh; as many as fit if absent.
    pub texels_per_unit: Option<f64>,
    /// Least distance of two charts, in texels; half of it is kept to the borders of pages.
    pub padding: u32,
    /// Where charts may end; on borders of texels only where the sides of the texture are powers of two.
    pub borders: Borders,
    /// Bits that texture coordinates will be rounded to, 12, 14 or 16: thin triangles and narrow gaps are opened so that the map stays
    /// bijective, as far as that is possible.
    pub quantization_safe: Option<u32>,
    /// Threads to use; all cores if absent. The result does not depend on it.
    pub threads: Option<usize>,
    /// Seconds after which the current valid map is taken as it is.
    pub time_budget: Option<f64>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            energy: EnergyKind::SymmetricDirichlet,
            barrier: BarrierKind::InverseSpline,
            barrier_strength: 0.01,
            barrier_support: 1.0,
            cut: Cut::Auto,
            kept_maps: KeptMaps::Optimized,
            pin: 0,
            quality: Quality::default(),
            max_distortion: None,
            max_stretch: None,
            packing: PackingMode::default(),
            seam_weight: 1.0,
            max_charts: None,
            resolution: Resolution::square(1024),
            pages: 1,
            texels_per_unit: None,
            padding: 2,
            borders: Borders::Free,
            quantization_safe: None,
            threads: None,
            time_budget: None,
        }
    }
}

/// The least that [`Settings::max_distortion`] and [`Settings::max_stretch`] may be: at their minima, 4 and 1, each face would have
/// to be a chart.
const LEAST_DISTORTION: f64 = 4.0001;
const LEAST_STRETCH: f64 = 1.001;

impl Settings {
    /// How distorted the atlas may be.
    pub fn bound(&self) -> Bound {
        Bound {
            mean: self.max_distortion.unwrap_or(self.quality.bound()),
            stretch: self.max_stretch,
        }
    }

    /// Checks every number against its range; the text names the option.
    pub fn validate(&self) -> Result<(), String> {
        within("barrier_strength", self.barrier_strength, 1e-9, 1e9)?;
        within("barrier_support", self.barrier_support, 1e-6, 1e6)?;
        within("seam_weight", self.seam_weight, 0.0, 1e6)?;
        check_texels(self.resolution, self.padding)?;
        check_pages(self.pages)?;
        if let Some(texels) = self.texels_per_unit {
            within("texels_per_unit", texels, 1e-9, 1e9)?;
        }
        if self.pages > 1 && self.quantization_safe.is_some() {
            return Err(
                "`quantization_safe` goes with one page: of several, tools round to fewer bits of each".to_owned(),
            );
        }
        within(
            "max_charts",
            f64::from(self.max_charts.unwrap_or(1)),
            1.0,
            1e9,
        )?;
        if self.borders == Borders::OnTexels && !self.resolution.shorter().is_power_of_two() {
            let given = self.resolution;
            return Err(format!(
                "charts of a lightmap end where texels end: its `resolution` is a power of two, not {given}"
            ));
        }
        for (name, given, least) in [
            ("max_distortion", self.max_distortion, LEAST_DISTORTION),
            ("max_stretch", self.max_stretch, LEAST_STRETCH),
        ] {
            within(name, given.unwrap_or(least), least, 1e6)?;
            if given.is_some() && self.cut != Cut::Auto {
                return Err(format!("`{name}` goes with `cut` auto"));
            }
        }
        match self.quantization_safe {
            None | Some(12 | 14 | 16) => {}
            Some(bits) => {
                return Err(format!(
                    "`quantization_safe` must be 12, 14 or 16, not {bits}"
                ));
            }
        }
        match (self.pin, self.cut) {
            (0, _) | (2, Cut::Disk) => {}
            (2, _) => return Err("`pin` 2 goes with `cut` disk".to_owned()),
            (pin, _) => return Err(format!("`pin` must be 0 or 2, not {pin}")),
        }
        if let Some(threads) = self.threads {
            within("threads", threads as f64, 1.0, 1024.0)?;
        }
        if let Some(seconds) = self.time_budget {
            within("time_budget", seconds, 0.0, 1e6)?;
        }
        Ok(())
    }
}

/// A number and its range. The text names the option as all texts about options do, in backticks: a command line tells its user of
/// `--name` instead.
pub(super) fn within(name: &str, value: f64, low: f64, high: f64) -> Result<(), String> {
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(format!(
            "`{name}` must lie between {low} and {high}, not {value}"
        ))
    }
}

/// A resolution and a padding in its texels.
pub(super) fn check_texels(resolution: Resolution, padding: u32) -> Result<(), String> {
    for side in [resolution.width, resolution.height] {
        within("resolution", f64::from(side), 16.0, 65_536.0)?;
    }
    if !resolution.is_regular() {
        let most = Resolution::MOST_ELONGATED;
        return Err(format!(
            "`resolution` must have one side that is the other times a power of two up to {most}, not {resolution}"
        ));
    }
    let most = f64::from(most_padding(resolution));
    within("padding", f64::from(padding), 0.0, most)
}

/// The largest padding, in texels.
pub(super) fn most_padding(resolution: Resolution) -> u32 {
    resolution.shorter() / 8
}

/// A number of pages.
pub(super) fn check_pages(pages: u32) -> Result<(), String> {
    within(
        "pages",
        f64::from(pages),
        1.0,
        f64::from(Texture::MOST_PAGES),
    )
}

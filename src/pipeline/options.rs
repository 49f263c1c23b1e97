//! What a caller may choose, with defaults and limits.

use serde::{Deserialize, Serialize};

#[cfg(feature = "files")]
use super::{Limits, PipelineError};
use crate::barrier::BarrierKind;
#[cfg(feature = "files")]
use crate::certificate::{Claims, Overlap, Padding};
use crate::charts::{Cut, Quality};
#[cfg(feature = "files")]
use crate::document::{GroupBy, OutputFormat};
use crate::energy::EnergyKind;
#[cfg(feature = "files")]
use crate::picture::HeatmapMeasure;

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
    /// Charts that [`Cut::Auto`] may make of a mesh; for that it allows more distortion.
    pub max_charts: Option<u32>,
    /// Texels along the side of the texture that `padding` is counted in.
    pub resolution: u32,
    /// Least distance of two charts, in texels.
    pub padding: u32,
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
            max_charts: None,
            resolution: 1024,
            padding: 2,
            quantization_safe: None,
            threads: None,
            time_budget: None,
        }
    }
}

impl Settings {
    /// Checks every number against its range; the text names the option.
    pub fn validate(&self) -> Result<(), String> {
        within("barrier_strength", self.barrier_strength, 1e-9, 1e9)?;
        within("barrier_support", self.barrier_support, 1e-6, 1e6)?;
        check_texels(self.resolution, self.padding)?;
        within(
            "max_charts",
            f64::from(self.max_charts.unwrap_or(1)),
            1.0,
            1e9,
        )?;
        match self.quantization_safe {
            None | Some(12 | 14 | 16) => {}
            Some(bits) => {
                return Err(format!(
                    "quantization_safe must be 12, 14 or 16, not {bits}"
                ));
            }
        }
        match (self.pin, self.cut) {
            (0, _) | (2, Cut::Disk) => {}
            (2, Cut::Auto) => return Err("pin 2 goes with cut disk".to_owned()),
            (pin, _) => return Err(format!("pin must be 0 or 2, not {pin}")),
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

fn within(name: &str, value: f64, low: f64, high: f64) -> Result<(), String> {
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(format!(
            "{name} must lie between {low} and {high}, not {value}"
        ))
    }
}

fn check_texels(resolution: u32, padding: u32) -> Result<(), String> {
    within("resolution", f64::from(resolution), 16.0, 65_536.0)?;
    let most = f64::from(resolution / 8);
    within("padding", f64::from(padding), 0.0, most)
}

/// Edges of a document that are cut in any case.
#[cfg(feature = "files")]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(untagged)]
pub enum GivenSeams {
    /// By a word.
    Named(NamedSeams),
    /// Those between these pairs of vertices, counted over the triangle primitives of the file as they follow each other.
    Edges(Vec<[u32; 2]>),
}

/// Seams that the document itself tells.
#[cfg(feature = "files")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum NamedSeams {
    /// Edges at which the normals of two faces differ.
    Normals,
}

/// How a document is unwrapped: [`Settings`] and what concerns the file. The command line's long names in snake case.
#[cfg(feature = "files")]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// Distortion energy to minimize.
    pub energy: EnergyKind,
    /// Barrier that keeps every triangle from inverting; `none` is for comparison and never certified.
    pub barrier: BarrierKind,
    /// Weight β of the barrier.
    #[cfg_attr(feature = "service", schema(minimum = 1e-9, maximum = 1e9))]
    pub barrier_strength: f64,
    /// Support s of the barrier, relative to an element's rest area.
    #[cfg_attr(feature = "service", schema(minimum = 1e-6, maximum = 1e6))]
    pub barrier_support: f64,
    /// Where to cut: few charts under a bound on their distortion, more in less time, one per component, the islands of the present
    /// UVs, or along given seams.
    pub cut: Cut,
    /// Edges that are cut in any case: `normals` for those with hard normals, or pairs of vertices, counted over the triangle
    /// primitives of the file as they follow each other.
    pub seams: Option<GivenSeams>,
    /// Cut along the borders of materials too.
    pub material_borders: bool,
    /// The UV set whose islands `cut` `keep` takes; 0 if absent.
    #[cfg_attr(feature = "service", schema(maximum = 7))]
    pub source_texcoord: Option<u32>,
    /// What becomes of the maps of islands with `cut` `keep`.
    pub kept_maps: KeptMaps,
    /// Vertices of each chart's boundary that are held, far from each other: 0, or with `disk` 2, as least-squares conformal maps
    /// need them.
    #[cfg_attr(feature = "service", schema(maximum = 2))]
    pub pin: u32,
    /// The bound on the mean symmetric Dirichlet energy that `cut` `auto` keeps: 4.05, 4.1 or 4.5; 4 is an isometry.
    pub quality: Quality,
    /// Charts that `cut` `auto` may make for an atlas: where it needs more it allows more distortion, up to one chart per component.
    #[cfg_attr(feature = "service", schema(minimum = 1))]
    pub max_charts: Option<u32>,
    /// What shares one atlas.
    pub group_by: GroupBy,
    /// The UV set to write; chosen so that no texture breaks if absent.
    #[cfg_attr(feature = "service", schema(maximum = 7))]
    pub texcoord: Option<u32>,
    /// Replace the UV set even if textures sample it.
    pub overwrite: bool,
    /// Texels along the side of the texture that `padding` is counted in.
    #[cfg_attr(feature = "service", schema(minimum = 16, maximum = 65536))]
    pub resolution: u32,
    /// Least distance of two charts, in texels; at most an eighth of the resolution.
    #[cfg_attr(feature = "service", schema(maximum = 8192))]
    pub padding: u32,
    /// Bits that tools will round the texture coordinates to, 12, 14 or 16: thin triangles and narrow gaps are opened so that the map
    /// stays bijective. The report says whether that is proven, and which faces are in doubt.
    #[cfg_attr(
        feature = "service",
        schema(minimum = 12, maximum = 16, multiple_of = 2)
    )]
    pub quantization_safe: Option<u32>,
    /// Threads to use; all that are allowed if absent. The result does not depend on it.
    #[cfg_attr(feature = "service", schema(minimum = 1, maximum = 1024))]
    pub threads: Option<usize>,
    /// Seconds after which the current valid map is taken as it is.
    #[cfg_attr(feature = "service", schema(minimum = 0, maximum = 1e6))]
    pub time_budget: Option<f64>,
    /// What the heat map shows.
    pub heatmap_measure: HeatmapMeasure,
    /// Format of the result.
    pub format: OutputFormat,
    /// Name of the written files without extension; the input's if absent. Not an option over HTTP.
    #[serde(skip)]
    pub stem: Option<String>,
    /// What may be used of all this. Not an option over HTTP.
    #[serde(skip)]
    pub limits: Limits,
}

#[cfg(feature = "files")]
impl Default for Options {
    fn default() -> Self {
        let settings = Settings::default();
        Self {
            energy: settings.energy,
            barrier: settings.barrier,
            barrier_strength: settings.barrier_strength,
            barrier_support: settings.barrier_support,
            cut: settings.cut,
            seams: None,
            material_borders: false,
            source_texcoord: None,
            kept_maps: settings.kept_maps,
            pin: settings.pin,
            quality: settings.quality,
            max_charts: settings.max_charts,
            group_by: GroupBy::Mesh,
            texcoord: None,
            overwrite: false,
            resolution: settings.resolution,
            padding: settings.padding,
            quantization_safe: settings.quantization_safe,
            threads: settings.threads,
            time_budget: settings.time_budget,
            heatmap_measure: HeatmapMeasure::SymmetricDirichlet,
            format: OutputFormat::Glb,
            stem: None,
            limits: Limits::default(),
        }
    }
}

#[cfg(feature = "files")]
impl Options {
    /// Whether the result has to be valid: not without a barrier, nor where maps stay as they are.
    pub(super) fn is_promised(&self) -> bool {
        let is_given = self.cut == Cut::Keep && self.kept_maps == KeptMaps::AsGiven;
        self.barrier != BarrierKind::None && !is_given
    }

    /// The part that concerns the geometry, within the limits.
    pub fn settings(&self) -> Settings {
        Settings {
            energy: self.energy,
            barrier: self.barrier,
            barrier_strength: self.barrier_strength,
            barrier_support: self.barrier_support,
            cut: self.cut,
            kept_maps: self.kept_maps,
            pin: self.pin,
            quality: self.quality,
            max_charts: self.max_charts,
            resolution: self.resolution,
            padding: self.padding,
            quantization_safe: self.quantization_safe,
            threads: self.limits.threads(self.threads),
            time_budget: self.limits.time_budget(self.time_budget),
        }
    }

    /// What the certificate is asked to speak of.
    pub(super) fn claims(&self) -> Claims {
        Claims {
            overlap: Overlap::Test,
            padding: Some(Padding {
                texels: self.padding,
                resolution: self.resolution,
            }),
            bits: self.quantization_safe,
            ..Claims::default()
        }
    }

    /// Checks every number against its range; the error names the option.
    pub fn check(&self) -> Result<(), PipelineError> {
        self.validate().map_err(PipelineError::InvalidOptions)
    }

    fn validate(&self) -> Result<(), String> {
        self.settings().validate()?;
        if self.cut == Cut::Seams && self.seams.is_none() {
            return Err("cut seams needs seams".to_owned());
        }
        match self.texcoord {
            Some(set) if set > MAX_TEXCOORD => Err(format!(
                "texcoord must lie between 0 and {MAX_TEXCOORD}, not {set}"
            )),
            _ => Ok(()),
        }
    }
}

/// Highest UV set that may be asked for; no engine reads more than eight.
#[cfg(feature = "files")]
const MAX_TEXCOORD: u32 = 7;

/// Which UVs of a document are measured or verified.
#[cfg(feature = "files")]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct MeasureOptions {
    /// The UV set.
    pub texcoord: u32,
    /// What shares one atlas.
    pub group_by: GroupBy,
    /// Least distance of two charts to prove, in texels; not judged if absent.
    #[cfg_attr(feature = "service", schema(maximum = 8192))]
    pub padding: Option<u32>,
    /// Texels along the side of the texture that `padding` is counted in.
    #[cfg_attr(feature = "service", schema(minimum = 16, maximum = 65536))]
    pub resolution: u32,
    /// Bits b at which to prove that the map stays bijective however each coordinate moves by up to 1/(2(2ᵇ−1)) + 2⁻¹⁶.
    #[cfg_attr(feature = "service", schema(minimum = 8, maximum = 16))]
    pub bits: Option<u32>,
    /// What may be used for it. Not an option over HTTP.
    #[serde(skip)]
    pub limits: Limits,
}

#[cfg(feature = "files")]
impl Default for MeasureOptions {
    fn default() -> Self {
        Self {
            texcoord: 0,
            group_by: GroupBy::Mesh,
            padding: None,
            resolution: Settings::default().resolution,
            bits: None,
            limits: Limits::default(),
        }
    }
}

#[cfg(feature = "files")]
impl MeasureOptions {
    /// Checks every number against its range; the error names the option.
    pub fn check(&self) -> Result<(), PipelineError> {
        let checked = check_texels(self.resolution, self.padding.unwrap_or(0)).and_then(|()| {
            let bits = self.bits.unwrap_or(12);
            within("bits", f64::from(bits), 8.0, 16.0)
        });
        checked.map_err(PipelineError::InvalidOptions)
    }

    /// What the certificate is asked to speak of.
    pub(super) fn claims(&self, overlap: Overlap) -> Claims {
        Claims {
            overlap,
            padding: self.padding.map(|texels| Padding {
                texels,
                resolution: self.resolution,
            }),
            bits: self.bits,
            ..Claims::default()
        }
    }
}

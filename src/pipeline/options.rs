//! How a document is unwrapped.

use serde::{Deserialize, Serialize};

use super::idle;
use super::nodes::Nodes;
use super::preset::Preset;
use super::rebake::{ImageFormat, MOST_SIDE};
use super::settings::{KeptMaps, PackingMode, Settings, check_texels, most_padding, within};
use super::texel_weight::TexelWeight;
use super::{Limits, PipelineError};
use crate::atlas::Borders;
use crate::barrier::BarrierKind;
use crate::certificate::{Claims, Overlap, Padding};
use crate::charts::{Cut, Quality};
use crate::document::{GroupBy, OutputFormat, Terms};
use crate::energy::EnergyKind;
use crate::mesh::Resolution;
use crate::picture::HeatmapMeasure;

/// Edges of a document that are cut in any case.
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum NamedSeams {
    /// Edges at which the normals of two faces differ.
    Normals,
}

/// How a document is unwrapped: [`Settings`] and what concerns the file. The command line's long names in snake case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// What the UVs are for.
    pub preset: Preset,
    /// Distortion energy to minimize.
    pub energy: EnergyKind,
    /// Barrier that keeps every triangle from inverting; `none` is for comparison: what flips without it is written, and is not certified.
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
    /// The bound on the mean symmetric Dirichlet energy in the place of what `quality` says. With `cut` `auto`; the report says whether
    /// it was kept.
    #[cfg_attr(feature = "service", schema(minimum = 4.0001, maximum = 1e6))]
    pub max_distortion: Option<f64>,
    /// A bound on the stretch max(σ₁, 1/σ₂) that all but a hundredth of the area keeps: more is cut until it does. With `cut` `auto`;
    /// the report says whether it was kept.
    #[cfg_attr(feature = "service", schema(minimum = 1.001, maximum = 1e6))]
    pub max_stretch: Option<f64>,
    /// How long the fullest layout is searched for.
    pub packing: PackingMode,
    /// The price of a seam where charts are cut so that the atlas becomes fuller: 0 cuts wherever that gains anything, a
    /// large number never. With `cut` `disk` no chart is cut.
    #[cfg_attr(feature = "service", schema(minimum = 0, maximum = 1e6))]
    pub seam_weight: f64,
    /// Charts that `cut` `auto` may make for an atlas: where it needs more it allows more distortion, up to one chart per component.
    #[cfg_attr(feature = "service", schema(minimum = 1))]
    pub max_charts: Option<u32>,
    /// What shares one atlas. If absent each mesh of a glTF file has its own, and all of another file one; a lightmap and an OBJ file
    /// have one for the scene in any case.
    pub group_by: Option<GroupBy>,
    /// The UV set to write; chosen so that no texture breaks if absent.
    #[cfg_attr(feature = "service", schema(maximum = 7))]
    pub texcoord: Option<u32>,
    /// Replace the UV set even if textures sample it.
    pub overwrite: bool,
    /// Resample the textures of the materials for the new UVs, which then replace set 0 unless `texcoord` names another. Textures
    /// that cannot be read or are of an unknown kind stay, and so do the UVs that they sample; the report lists them.
    pub rebake: bool,
    /// Texels along the sides of resampled textures. If absent, `resolution`, or the power of two up to 4096 at which the surface has
    /// as many texels as it had, whichever is more.
    #[cfg_attr(feature = "service", schema(minimum = 16, maximum = 8192))]
    pub bake_size: Option<u32>,
    /// The format of resampled textures: that of the images that they are made of, or one for all.
    pub image_format: ImageFormat,
    /// The texture that `padding` is counted in. One side is the other times a power of two; texels are square on the surface.
    pub resolution: Resolution,
    /// Pages that charts may lie on: page k covers u from k to k + 1, the tile 1001 + k of UDIM. All have the resolution and one
    /// density. Not with `rebake` or `quantization_safe`.
    #[cfg_attr(feature = "service", schema(minimum = 1, maximum = 10))]
    pub pages: u32,
    /// Texels along one unit of length of the mesh. If absent as many as fit; a texture that is too small is an error.
    #[cfg_attr(feature = "service", schema(minimum = 1e-9, maximum = 1e9))]
    pub texels_per_unit: Option<f64>,
    /// Materials of a glTF that get so many times as many texels along a line as the others, as `MATERIAL=W` with a name or an index.
    /// Borders between different weights are cut, `texels_per_unit` is that of weight 1, and distortion is measured against
    /// the density intended.
    #[cfg_attr(feature = "service", schema(value_type = Vec<String>))]
    pub texel_weights: Vec<TexelWeight>,
    /// Least distance of two charts, in texels of the coarsest of the mip levels that count; at most an eighth of its side.
    #[cfg_attr(feature = "service", schema(maximum = 8192))]
    pub padding: u32,
    /// Mip levels beyond the first in which charts keep the padding; none if absent, two of a lightmap.
    #[cfg_attr(feature = "service", schema(maximum = 12))]
    pub mips: Option<u32>,
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

impl Default for Options {
    fn default() -> Self {
        let settings = Settings::default();
        Self {
            preset: Preset::Material,
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
            max_distortion: settings.max_distortion,
            max_stretch: settings.max_stretch,
            packing: settings.packing,
            seam_weight: settings.seam_weight,
            max_charts: settings.max_charts,
            group_by: None,
            texcoord: None,
            overwrite: false,
            rebake: false,
            bake_size: None,
            image_format: ImageFormat::Source,
            resolution: settings.resolution,
            pages: settings.pages,
            texels_per_unit: settings.texels_per_unit,
            texel_weights: Vec::new(),
            padding: settings.padding,
            mips: None,
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

impl Options {
    /// Whether the result has to be valid: not without a barrier, nor where maps stay as they are.
    pub(super) fn is_promised(&self) -> bool {
        let is_given = self.cut == Cut::Keep && self.kept_maps == KeptMaps::AsGiven;
        self.barrier != BarrierKind::None && !is_given
    }

    /// With what follows from the preset.
    pub(super) fn resolved(&self) -> Self {
        let options = Self {
            mips: Some(self.mips()),
            ..self.clone()
        };
        match self.preset {
            Preset::Material => options,
            Preset::Lightmap => Self {
                group_by: Some(GroupBy::Scene),
                texcoord: self.texcoord.or(Some(1)),
                ..options
            },
        }
    }

    /// Mip levels beyond the first in which charts keep the padding.
    fn mips(&self) -> u32 {
        self.mips.unwrap_or(match self.preset {
            Preset::Material => 0,
            Preset::Lightmap => LIGHTMAP_MIPS,
        })
    }

    /// What counts as a surface.
    pub(super) fn nodes(&self) -> Nodes {
        match self.preset {
            Preset::Material => Nodes::Shared,
            Preset::Lightmap => Nodes::Separate,
        }
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
            max_distortion: self.max_distortion,
            max_stretch: self.max_stretch,
            packing: self.packing,
            seam_weight: self.seam_weight,
            max_charts: self.max_charts,
            resolution: self.resolution,
            pages: self.pages,
            texels_per_unit: self.texels_per_unit,
            padding: self.padding << self.mips(),
            borders: match self.preset {
                Preset::Material => Borders::Free,
                Preset::Lightmap => Borders::OnTexels,
            },
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
                texels: self.padding << self.mips(),
                resolution: self.resolution,
            }),
            aligned: (self.preset == Preset::Lightmap).then_some(self.resolution),
            pages: Some(self.pages),
            bits: self.quantization_safe,
            ..Claims::default()
        }
    }

    /// What the written file says of its UVs, with what shares an atlas in it.
    pub(super) fn terms(&self, group_by: GroupBy) -> Terms {
        Terms {
            group_by,
            separate_nodes: self.nodes() == Nodes::Separate,
            padding: Some(self.padding),
            resolution: self.resolution,
            pages: Some(self.pages),
            mips: self.mips(),
            aligned: self.preset == Preset::Lightmap,
            bits: self.quantization_safe,
            overlaps: false,
            charts: None,
        }
    }

    /// Checks every number against its range; the error names the option.
    pub fn check(&self) -> Result<(), PipelineError> {
        self.validate().map_err(PipelineError::InvalidOptions)
    }

    fn validate(&self) -> Result<(), String> {
        check_mips(self.padding, self.mips(), self.resolution)?;
        self.settings().validate()?;
        idle::check(self)?;
        self.texel_weights.iter().try_for_each(TexelWeight::check)?;
        if self.cut == Cut::Seams && self.seams.is_none() {
            return Err("`cut` seams needs `seams`".to_owned());
        }
        if self.rebake && (self.pages > 1 || self.resolution.aspect() != 1.0) {
            return Err(
                "`rebake` makes one square texture: it needs `pages` 1 and a square `resolution`"
                    .to_owned(),
            );
        }
        within(
            "bake_size",
            f64::from(self.bake_size.unwrap_or(MOST_SIDE)),
            16.0,
            f64::from(MOST_SIDE),
        )?;
        match self.texcoord {
            Some(set) => within("texcoord", f64::from(set), 0.0, MAX_TEXCOORD),
            None => Ok(()),
        }
    }
}

/// Mip levels for which padding of a lightmap holds: of a distant room a quarter of the texels is shown along a side.
const LIGHTMAP_MIPS: u32 = 2;

/// Highest UV set that may be asked for; no engine reads more than eight.
const MAX_TEXCOORD: f64 = 7.0;

/// Mip levels for which padding holds, and that this is no more texels than can be.
pub(super) fn check_mips(padding: u32, mips: u32, resolution: Resolution) -> Result<(), String> {
    within("mips", f64::from(mips), 0.0, 12.0)?;
    check_texels(resolution, padding)?;
    let (texels, most) = (u64::from(padding) << mips, most_padding(resolution));
    if texels <= u64::from(most) {
        return Ok(());
    }
    Err(format!(
        "`mips` {mips} makes of `padding` {padding} {texels} texels of `resolution` {resolution}, which allows {most}: take `mips` \
         up to {}, less `padding` or more `resolution`",
        (most / padding).ilog2()
    ))
}

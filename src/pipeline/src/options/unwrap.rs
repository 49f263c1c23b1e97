//! Options of unwrapping.

use super::{
    Action, Budget, Caller, Cutting, IslandControl, KeptMaps, Layout, Mapping, Stacking, Workers,
};
use crate::arrays::settings::Settings;
use crate::arrays::whole_texels::ROOM_TEXELS;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;
use unwrapd_api::options::{options, within};
use unwrapd_files::document::gltf::GltfDocument;
use unwrapd_files::document::{
    BakePlane, Document, DocumentError, GroupBy, MaterialMerge, OutputFormat, Primitive, Terms,
};
use unwrapd_files::io::{Content, Format, format_of_content};
use unwrapd_files::picture::{HeatmapMeasure, Picture};
use unwrapd_layout::atlas::{Borders, Rotation};
use unwrapd_layout::charts::Cut;
use unwrapd_maps::certificate::{Claims, Overlap, Padding, Stacks};

/// Maximum side of a texture in texels.
pub(crate) const MOST_SIDE: u32 = 8192;

/// Edges of a document to cut in any mode.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(untagged)]
pub enum GivenSeams {
    /// Seams named by a word.
    Named(NamedSeams),
    /// The edges between these pairs of vertices, counted over the triangle primitives of the file
    /// in order.
    Edges(Vec<[u32; 2]>),
}

/// Seams that the document itself defines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum NamedSeams {
    /// Hard edges: those where the normals of two faces differ.
    Normals,
}

options! {
    /// Options of unwrapping a document: its [`Settings`], and the options that concern the file.
    /// They have the command line's long names in snake case.
    pub struct Options under "Atlas" {
        /// Purpose of the UVs.
        pub preset: Preset = Preset::Material;
        /// Parts of the document that share an atlas and a texel density. The default for glTF is
        /// one atlas per material; a mesh without a material has its own. Other files have one
        /// atlas.
        ///
        /// A lightmap and an OBJ file always have one atlas for the scene.
        pub group_by: Option<GroupBy>;
        /// Give a material, by name or index, W times the linear texel density of the others in its
        /// atlas.
        ///
        /// The surface is cut between materials of different weight. `texels_per_unit` refers to
        /// weight 1, and distortion is measured against the intended density. Repeat the option for
        /// several materials; JSON takes a list.
        pub texel_weight: Vec<TexelWeight>, value "MATERIAL=W", also "texel_weights", schema(value_type = Vec<String>);
        /// Replace materials by one: `all`, or NAME=MATERIAL,MATERIAL for some, by name or index.
        ///
        /// Implies `rebake`. Factors are drawn into the textures, and the merged material has one atlas.
        /// Primitives of a mesh that then agree in everything but their vertices are joined. Materials stay
        /// apart, and the report says why, if they differ in alpha mode, culling, filtering or
        /// extensions, or are animated. Repeat the option for several materials; JSON takes a list.
        pub merge_materials: Vec<MaterialMerge>, value "all|NAME=MATERIAL,…", arg(help_heading = "UV sets and textures"), schema(value_type = Vec<String>);
        /// Number of mip levels beyond the first in which charts keep the padding, counted in
        /// texels of each level. The default is 0, for a lightmap 2.
        pub mips: Option<u32>, in 0..=12, value "N";
        /// Also cut along the borders between materials.
        pub material_borders: bool, arg(help_heading = "Where to cut");
        /// Distortion to show in the heat map.
        pub heatmap_measure: HeatmapMeasure = HeatmapMeasure::SymmetricDirichlet,
            arg(help_heading = "Files and messages", requires = "heatmap");
    }
    files {
        /// Edges to cut in any mode: normals for hard edges, or a list [[v, w], …] of vertex pairs.
        /// Vertices are counted over the triangle primitives of the file in order.
        pub seams: Option<GivenSeams>;
        /// Vertices at which `cut` disk puts cone singularities, instead of `cones` that it chooses. Each
        /// component is slit through them, along short paths; one without any is only opened. A map that
        /// overlaps itself is parted. Vertices are counted over the triangle primitives of the file in
        /// order.
        pub cone_vertices: Option<Vec<u32>>;
        /// Format of the result.
        pub format: OutputFormat = OutputFormat::Glb;
    }
    groups {
        /// Where to cut.
        pub cutting: Cutting;
        /// Layout of the charts on a texture.
        pub layout: Layout;
        /// Rules for islands.
        pub control: IslandControl;
        /// UV sets to read and write.
        pub sets: Sets;
        /// Resampling of textures.
        pub baking: Baking;
        /// Mapping of the charts.
        pub mapping: Mapping;
        /// Number of threads.
        pub workers: Workers;
        /// Time limit.
        pub budget: Budget;
    }
    untold {
        /// Settings of the caller.
        pub caller: Caller;
    }
}

impl Options {
    /// Returns the options with the settings of the preset filled in.
    pub(crate) fn resolved(&self) -> Self {
        let mut options = Self {
            mips: Some(self.mips()),
            ..self.clone()
        };
        options.baking.rebake = self.rebakes();
        if self.preset == Preset::Lightmap {
            options.group_by = Some(GroupBy::Scene);
            options.sets.texcoord = self.sets.texcoord.or(Some(1));
        }
        options
    }

    /// Returns whether textures are resampled: on request, for vertex colors, or to merge materials.
    pub(crate) fn rebakes(&self) -> bool {
        self.baking.rebake || self.baking.bake_colors || !self.merge_materials.is_empty()
    }

    /// Returns whether islands may lie on each other.
    pub(crate) fn stacks(&self) -> bool {
        let stack = self.layout.stack;
        stack.is_some_and(|stack| stack != Stacking::Off)
    }

    /// Returns the side of the texture on whose whole texels islands are put, so that resampling copies them: if islands
    /// of the file keep their density and turn by quarters only.
    pub(crate) fn whole_texels(&self) -> Option<u32> {
        let is_given = self.cutting.cut == Cut::Keep
            && self.cutting.kept_maps == KeptMaps::AsGiven
            && self.layout.rotate != Rotation::Any;
        let mut rules = self.control.control.iter();
        let is_kept = is_given && rules.any(|rule| rule.action == Action::KeepDensity);
        (self.rebakes() && is_kept).then(|| {
            let side = self.baking.bake_size;
            side.unwrap_or(self.layout.resolution.longer())
        })
    }

    /// Returns the padding between charts that the result has, in texels.
    pub(crate) fn padding(&self) -> u32 {
        self.layout.padding << self.mips()
    }

    /// Returns the distance that charts are packed with beyond the padding, in texels.
    fn room(&self) -> u32 {
        let texels = |side: u32| {
            let texel = f64::from(self.layout.resolution.longer()) / f64::from(side);
            (ROOM_TEXELS * texel).ceil() as u32
        };
        self.whole_texels().map_or(0, texels)
    }

    /// Returns the number of mip levels beyond the first in which charts keep the padding.
    pub(crate) fn mips(&self) -> u32 {
        self.mips.unwrap_or(match self.preset {
            Preset::Material => 0,
            Preset::Lightmap => LIGHTMAP_MIPS,
        })
    }

    /// Returns the definition of surfaces.
    pub(crate) fn nodes(&self) -> Nodes {
        match self.preset {
            Preset::Material => Nodes::Shared,
            Preset::Lightmap => Nodes::Separate,
        }
    }

    /// Returns the geometry part of the options, within the limits.
    pub fn settings(&self) -> Settings {
        Settings {
            cutting: self.cutting,
            mapping: self.mapping.clone(),
            layout: Layout {
                padding: self.padding() + self.room(),
                ..self.layout
            },
            borders: match self.preset {
                Preset::Material => Borders::Free,
                Preset::Lightmap => Borders::OnTexels,
            },
            straighten: self.control.straighten.clone(),
            workers: self.caller.workers(self.workers),
            budget: self.caller.budget(self.budget),
        }
    }

    /// Returns the claims to certify.
    pub(crate) fn claims(&self) -> Claims {
        let layout = &self.layout;
        Claims {
            overlap: Overlap::Test,
            stacks: match layout.stack {
                None | Some(Stacking::Off) => Stacks::Refused,
                Some(Stacking::Keep | Stacking::Identical | Stacking::Mirrored) => Stacks::Accepted,
            },
            padding: Some(Padding {
                texels: self.padding(),
                resolution: layout.resolution,
            }),
            aligned: (self.preset == Preset::Lightmap).then_some(layout.resolution),
            pages: Some(layout.pages),
            bits: self.mapping.quantization_safe,
            ..Claims::default()
        }
    }

    /// Returns the record about the UVs for the written file; `group_by` is the actual grouping.
    pub(crate) fn terms(&self, group_by: GroupBy) -> Terms {
        Terms {
            group_by,
            separate_nodes: self.nodes() == Nodes::Separate,
            padding: Some(self.layout.padding),
            resolution: self.layout.resolution,
            pages: Some(self.layout.tiles()),
            mips: self.mips(),
            aligned: self.preset == Preset::Lightmap,
            bits: self.mapping.quantization_safe,
            overlaps: false,
        }
    }
}

/// Number of mip levels for which the padding of a lightmap holds: a distant room shows a quarter of the texels along
/// a side.
const LIGHTMAP_MIPS: u32 = 2;

// Purposes of UVs.

/// Purpose of the UVs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum Preset {
    /// Textures of materials.
    #[default]
    Material,
    /// Lighting of the whole scene: one atlas in UV set 1; other sets stay unchanged. Each node
    /// that shows a mesh gets its own copy and region, sized by its area in the scene. Padding
    /// holds for two more mip levels, and charts end on texel borders.
    Lightmap,
}

// Options for the UV sets that are read and written.

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

// Options of texture resampling.

options! {
    /// Resampling of textures.
    #[derive(Copy)]
    pub struct Baking under "UV sets and textures" {
        /// Resample the textures for the new UVs, which then replace set 0 unless `texcoord` names
        /// another.
        ///
        /// PNG, JPEG, `WebP` and KTX2 images are read; PNG of 16 bits per channel stays so. Texels are
        /// copied where an island moves by whole texels, quarter turns and flips. Textures that
        /// repeat, that cannot be read, or of an unknown kind, stay as they are and keep their UVs.
        /// The report lists them.
        pub rebake: bool, arg(help_heading = None::<&'static str>);
        /// Resample textures that repeat on an island, too. Every repetition then has texels of its
        /// own; a warning tells how many remain.
        pub bake_tiled: bool;
        /// Draw vertex colors into the base-color texture, and remove them. A surface without one
        /// gets a texture of its colors.
        ///
        /// Implies `rebake`.
        pub bake_colors: bool;
        /// Side of the resampled textures, in texels. The default is `resolution`, or more if the
        /// surface would lose texels: a power of two up to 4096.
        pub bake_size: Option<u32>, in 16..=8192, value "TEXELS";
        /// File format of the resampled textures: that of the source images, or one format for all.
        pub image_format: ImageFormat = ImageFormat::Source;
    }
}

const _: () = assert!(MOST_SIDE == 8192);

// File format of resampled textures.

/// The format of the files of resampled textures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum ImageFormat {
    /// JPEG or `WebP` if all source images are, otherwise PNG.
    #[default]
    Source,
    /// PNG, lossless.
    Png,
    /// JPEG, or PNG if a texel is transparent.
    Jpeg,
    /// `WebP`, lossless.
    Webp,
}

// The longest side of a JPEG file is 65,535 pixels.
const _: () = assert!(MOST_SIDE <= u16::MAX as u32);

impl ImageFormat {
    /// Encodes the texture that `plane` produced.
    pub fn file(
        self,
        document: &GltfDocument,
        plane: &BakePlane,
        picture: &Picture,
    ) -> Result<Vec<u8>, DocumentError> {
        let Picture::Eight(image) = picture else {
            return Ok(picture.png());
        };
        let format = match self {
            Self::Source if is_all(document, plane, Format::Jpeg)? => Self::Jpeg,
            Self::Source if is_all(document, plane, Format::Webp)? => Self::Webp,
            other => other,
        };
        let file = match format {
            Self::Jpeg => image.jpeg(),
            Self::Webp => image.webp(),
            Self::Source | Self::Png => None,
        };
        Ok(file.unwrap_or_else(|| image.png()))
    }

    /// Returns whether files of this format can have 16 bits per channel.
    pub fn keeps_16_bits(self) -> bool {
        matches!(self, Self::Source | Self::Png)
    }
}

/// Returns whether a texture has source images, and all are files of one format.
fn is_all(
    document: &GltfDocument,
    plane: &BakePlane,
    format: Format,
) -> Result<bool, DocumentError> {
    let mut textures = plane.textures().peekable();
    if textures.peek().is_none() {
        return Ok(false);
    }
    for source in textures {
        let file = document.image(source.image)?;
        if format_of_content(&file, file.len() as u64, Content::Texture) != Some(format) {
            return Ok(false);
        }
    }
    Ok(true)
}

// Definition of the surfaces of a scene.

/// Definition of the surfaces of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nodes {
    /// Each mesh in its own space, however often and wherever nodes show it.
    Shared,
    /// Each instance of a mesh at its place in the scene.
    Separate,
}

impl Nodes {
    /// Returns the document with one mesh per surface.
    pub fn prepared(self, document: Document) -> Result<Document, DocumentError> {
        match self {
            Self::Shared => Ok(document),
            Self::Separate => document.with_separate_meshes(),
        }
    }

    /// Returns the primitives with the shapes of the surfaces.
    pub fn primitives(self, document: &Document) -> Result<Cow<'_, [Primitive]>, DocumentError> {
        match self {
            Self::Shared => Ok(Cow::Borrowed(document.primitives())),
            Self::Separate => document.primitives_in_scene().map(Cow::Owned),
        }
    }
}

// Materials with a higher or lower texel density.

/// Factor on the linear texel density of a material, relative to materials without a weight; written `MATERIAL=W`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct TexelWeight {
    /// Name of the material, or its index in the file.
    pub material: String,
    /// The factor.
    pub weight: f64,
}

impl TexelWeight {
    pub(crate) fn check(&self) -> Result<(), String> {
        within("texel_weight", self.weight, 1e-3, 1e3)
    }
}

impl FromStr for TexelWeight {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("{text:?} is not a material weight of the form MATERIAL=W");
        let (material, weight) = text.rsplit_once('=').ok_or_else(wrong)?;
        Ok(Self {
            material: material.to_owned(),
            weight: weight.parse().map_err(|_| wrong())?,
        })
    }
}

impl TryFrom<String> for TexelWeight {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<TexelWeight> for String {
    fn from(weight: TexelWeight) -> Self {
        weight.to_string()
    }
}

impl fmt::Display for TexelWeight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.material, self.weight)
    }
}

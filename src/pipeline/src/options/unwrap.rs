//! Options of unwrapping.

use serde::{Deserialize, Serialize};

use super::{Baking, Budget, Caller, Cutting, Layout, Mapping, Preset, Sets, Workers};
use crate::arrays::settings::Settings;
use crate::documents::nodes::Nodes;
use crate::documents::texel_weight::TexelWeight;
use unwrapd_api::options::options;
use unwrapd_files::document::{GroupBy, OutputFormat, Terms};
use unwrapd_files::picture::HeatmapMeasure;
use unwrapd_layout::atlas::Borders;
use unwrapd_maps::certificate::{Claims, Overlap, Padding};

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
        /// Give a material of a glTF, by name or index, W times the linear texel density of the
        /// others in its atlas.
        ///
        /// The surface is cut between materials of different weight. `texels_per_unit` refers to
        /// weight 1, and distortion is measured against the intended density. Repeat the option for
        /// several materials; JSON takes a list.
        pub texel_weight: Vec<TexelWeight>, value "MATERIAL=W", also "texel_weights", schema(value_type = Vec<String>);
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
        /// Format of the result.
        pub format: OutputFormat = OutputFormat::Glb;
    }
    groups {
        /// Where to cut.
        pub cutting: Cutting;
        /// Layout of the charts on a texture.
        pub layout: Layout;
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
        if self.preset == Preset::Lightmap {
            options.group_by = Some(GroupBy::Scene);
            options.sets.texcoord = self.sets.texcoord.or(Some(1));
        }
        options
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
                padding: self.layout.padding << self.mips(),
                ..self.layout
            },
            borders: match self.preset {
                Preset::Material => Borders::Free,
                Preset::Lightmap => Borders::OnTexels,
            },
            workers: self.caller.workers(self.workers),
            budget: self.caller.budget(self.budget),
        }
    }

    /// Returns the claims to certify.
    pub(crate) fn claims(&self) -> Claims {
        let layout = &self.layout;
        Claims {
            overlap: Overlap::Test,
            padding: Some(Padding {
                texels: layout.padding << self.mips(),
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
            pages: Some(self.layout.pages),
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

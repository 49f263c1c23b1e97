//! How a document is unwrapped.

use serde::{Deserialize, Serialize};

use super::{Baking, Budget, Caller, Cutting, Layout, Mapping, Preset, Sets, Workers};
use crate::atlas::Borders;
use crate::barrier::BarrierKind;
use crate::certificate::{Claims, Overlap, Padding};
use crate::document::{GroupBy, OutputFormat, Terms};
use crate::options::options;
use crate::picture::HeatmapMeasure;
use crate::pipeline::arrays::settings::Settings;
use crate::pipeline::documents::nodes::Nodes;
use crate::pipeline::documents::texel_weight::TexelWeight;

/// Edges of a document that are cut in any case.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(untagged)]
pub enum GivenSeams {
    /// By a word.
    Named(NamedSeams),
    /// Those between these pairs of vertices, counted over the triangle primitives of the file as
    /// they follow each other.
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

options! {
    /// How a document is unwrapped: what [`Settings`] consist of, and what concerns the file. The
    /// command line's long names in snake case.
    pub struct Options under "Atlas" {
        /// What the UVs are for, and what follows from that.
        pub preset: Preset = Preset::Material;
        /// What shares one atlas and one density. If absent, the meshes of a glTF file that have
        /// one material, and each mesh without one by itself; all of another file.
        ///
        /// A lightmap and an OBJ file have one atlas for the scene in any case.
        pub group_by: Option<GroupBy>;
        /// Materials of a glTF, by name or index, that get W times as many texels along a line as
        /// the others of their atlas.
        ///
        /// Borders between different weights are cut, `texels_per_unit` is that of weight 1, and
        /// distortion is measured against the density intended. The command line takes one at a
        /// time, JSON a list.
        pub texel_weight: Vec<TexelWeight>, value "MATERIAL=W", schema(value_type = Vec<String>);
        /// Mip levels beyond the first in which charts keep the padding, in texels of each; 0 if
        /// absent, 2 of a lightmap.
        pub mips: Option<u32>, in 0..=12, value "N";
        /// Cut along the borders of materials too.
        pub material_borders: bool, arg(help_heading = "Where to cut");
        /// What the heat map shows.
        pub heatmap_measure: HeatmapMeasure = HeatmapMeasure::SymmetricDirichlet,
            arg(help_heading = "Files and messages", requires = "heatmap");
    }
    files {
        /// Edges to cut in any case: normals for those with hard normals, or a list [[v, w], …] of
        /// pairs of vertices, counted over the triangle primitives of the file as they follow each
        /// other.
        pub seams: Option<GivenSeams>;
        /// Format of the result.
        pub format: OutputFormat = OutputFormat::Glb;
    }
    groups {
        /// Where to cut.
        pub cutting: Cutting;
        /// How charts are laid out on a texture.
        pub layout: Layout;
        /// Which UV sets are read and written.
        pub sets: Sets;
        /// Whether textures are resampled, and into what.
        pub baking: Baking;
        /// How charts are mapped.
        pub mapping: Mapping;
        /// What works.
        pub workers: Workers;
        /// How long it may take.
        pub budget: Budget;
    }
    untold {
        /// What the code that unwraps says.
        pub caller: Caller;
    }
}

impl Options {
    /// Whether the result has to be valid: not without a barrier, nor where maps stay as they are.
    pub(in crate::pipeline) fn is_promised(&self) -> bool {
        self.mapping.barrier != BarrierKind::None && !self.cutting.are_maps_given()
    }

    /// With what follows from the preset.
    pub(in crate::pipeline) fn resolved(&self) -> Self {
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

    /// Mip levels beyond the first in which charts keep the padding.
    pub(super) fn mips(&self) -> u32 {
        self.mips.unwrap_or(match self.preset {
            Preset::Material => 0,
            Preset::Lightmap => LIGHTMAP_MIPS,
        })
    }

    /// What counts as a surface.
    pub(in crate::pipeline) fn nodes(&self) -> Nodes {
        match self.preset {
            Preset::Material => Nodes::Shared,
            Preset::Lightmap => Nodes::Separate,
        }
    }

    /// The part that concerns the geometry, within the limits.
    pub fn settings(&self) -> Settings {
        Settings {
            cutting: self.cutting,
            mapping: self.mapping,
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

    /// What the certificate is asked to speak of.
    pub(in crate::pipeline) fn claims(&self) -> Claims {
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

    /// What the written file says of its UVs, with what shares an atlas in it.
    pub(in crate::pipeline) fn terms(&self, group_by: GroupBy) -> Terms {
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
            charts: None,
        }
    }
}

/// Mip levels for which padding of a lightmap holds: of a distant room a quarter of the texels is
/// shown along a side.
const LIGHTMAP_MIPS: u32 = 2;

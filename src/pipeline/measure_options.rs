//! What of a document is measured.

use serde::{Deserialize, Serialize};

use super::nodes::Nodes;
use super::options::check_mips;
use super::settings::{Settings, check_pages, within};
use super::{Limits, PipelineError};
use crate::certificate::{Claims, Overlap, Padding, Resolution};
use crate::document::GroupBy;

/// Which UVs of a document are measured or verified.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct MeasureOptions {
    /// The UV set.
    pub texcoord: u32,
    /// What shares one atlas.
    pub group_by: GroupBy,
    /// Judge what each node shows of a mesh by itself, where it is in the scene: nodes that show one mesh show the same UVs.
    pub separate_nodes: bool,
    /// Least distance of two charts to prove, in texels of the coarsest of the mip levels that count; not judged if absent.
    #[cfg_attr(feature = "service", schema(maximum = 8192))]
    pub padding: Option<u32>,
    /// The texture that `padding` is counted in, and texels per unit.
    pub resolution: Resolution,
    /// Prove that each chart lies on one of so many pages side by side, the tiles of UDIM from 1001 on; not judged if absent.
    #[cfg_attr(feature = "service", schema(minimum = 1, maximum = 10))]
    pub pages: Option<u32>,
    /// Mip levels beyond the first in which charts are to keep the padding.
    #[cfg_attr(feature = "service", schema(maximum = 12))]
    pub mips: u32,
    /// Prove that the bounding rectangles of charts end where texels of `resolution` end.
    pub aligned: bool,
    /// Bits b at which to prove that the map stays bijective however each coordinate moves by up to 1/(2(2ᵇ−1)) + 2⁻¹⁶.
    #[cfg_attr(feature = "service", schema(minimum = 8, maximum = 16))]
    pub bits: Option<u32>,
    /// What may be used for it. Not an option over HTTP.
    #[serde(skip)]
    pub limits: Limits,
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self {
            texcoord: 0,
            group_by: GroupBy::Mesh,
            separate_nodes: false,
            padding: None,
            resolution: Settings::default().resolution,
            pages: None,
            mips: 0,
            aligned: false,
            bits: None,
            limits: Limits::default(),
        }
    }
}

impl MeasureOptions {
    /// Checks every number against its range; the error names the option.
    pub fn check(&self) -> Result<(), PipelineError> {
        let padding = self.padding.unwrap_or(0);
        let checked = check_mips(padding, self.mips, self.resolution).and_then(|()| {
            check_pages(self.pages.unwrap_or(1))?;
            let bits = self.bits.unwrap_or(12);
            within("bits", f64::from(bits), 8.0, 16.0)
        });
        checked.map_err(PipelineError::InvalidOptions)
    }

    /// What counts as a surface.
    pub(super) fn nodes(&self) -> Nodes {
        if self.separate_nodes {
            Nodes::Separate
        } else {
            Nodes::Shared
        }
    }

    /// What the certificate is asked to speak of.
    pub(super) fn claims(&self, overlap: Overlap) -> Claims {
        Claims {
            overlap,
            padding: self.padding.map(|texels| Padding {
                texels: texels << self.mips,
                resolution: self.resolution,
            }),
            aligned: self.aligned.then_some(self.resolution),
            pages: self.pages,
            bits: self.bits,
            ..Claims::default()
        }
    }
}

//! What of a document is measured.

use serde::{Deserialize, Serialize};

use super::nodes::Nodes;
use super::options::check_mips;
use super::settings::{Settings, check_pages, within};
use super::{Limits, PipelineError};
use crate::certificate::{Claims, Overlap, Padding};
use crate::document::{GroupBy, Terms};
use crate::mesh::Resolution;

/// Which UVs of a document are measured or verified.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct MeasureOptions {
    /// The UV set. If absent it is the one that the file says was written, and what else is absent is what it was written for; set 0
    /// of a file that says nothing, or whose UVs were changed since.
    pub texcoord: Option<u32>,
    /// What shares one atlas; if absent each mesh has its own.
    pub group_by: Option<GroupBy>,
    /// Judge what each node shows of a mesh by itself, where it is in the scene: nodes that show one mesh show the same UVs.
    pub separate_nodes: bool,
    /// Least distance of two charts to prove, in texels of the coarsest of the mip levels that count; not judged if absent.
    #[cfg_attr(feature = "service", schema(maximum = 8192))]
    pub padding: Option<u32>,
    /// The texture that `padding` is counted in, and texels per unit; 1024 texels square if absent.
    pub resolution: Option<Resolution>,
    /// Prove that each chart lies on one of so many pages side by side, the tiles of UDIM from 1001 on; not judged if absent.
    #[cfg_attr(feature = "service", schema(minimum = 1, maximum = 10))]
    pub pages: Option<u32>,
    /// Mip levels beyond the first in which charts are to keep the padding; none if absent.
    #[cfg_attr(feature = "service", schema(maximum = 12))]
    pub mips: Option<u32>,
    /// Prove that the bounding rectangles of charts end where texels of `resolution` end.
    pub aligned: bool,
    /// Bits b at which to prove that the map stays bijective however each coordinate moves by up to 1/(2(2ᵇ−1)) + 2⁻¹⁶.
    #[cfg_attr(feature = "service", schema(minimum = 8, maximum = 16))]
    pub bits: Option<u32>,
    /// What may be used for it. Not an option over HTTP.
    #[serde(skip)]
    pub limits: Limits,
}

impl MeasureOptions {
    /// Checks every number against its range; the error names the option.
    pub fn check(&self) -> Result<(), PipelineError> {
        let (padding, mips) = (self.padding.unwrap_or(0), self.mips.unwrap_or(0));
        let checked = check_mips(padding, mips, self.resolution()).and_then(|()| {
            check_pages(self.pages.unwrap_or(1))?;
            let bits = self.bits.unwrap_or(12);
            within("bits", f64::from(bits), 8.0, 16.0)
        });
        checked.map_err(PipelineError::InvalidOptions)
    }

    /// The texture that is judged.
    pub(super) fn resolution(&self) -> Resolution {
        self.resolution.unwrap_or(Settings::default().resolution)
    }

    /// What shares one UV space, and what counts as a surface.
    pub(super) fn spaces(&self) -> (GroupBy, Nodes) {
        let nodes = if self.separate_nodes {
            Nodes::Separate
        } else {
            Nodes::Shared
        };
        (self.group_by.unwrap_or_default(), nodes)
    }

    /// What the certificate is asked to speak of.
    pub(super) fn claims(&self, overlap: Overlap) -> Claims {
        Claims {
            overlap,
            padding: self.padding.map(|texels| Padding {
                texels: texels << self.mips.unwrap_or(0),
                resolution: self.resolution(),
            }),
            aligned: self.aligned.then_some(self.resolution()),
            pages: self.pages,
            bits: self.bits,
            ..Claims::default()
        }
    }

    /// With what the UVs of a file were made for where these options say nothing. Surfaces are those of the options where these say
    /// what shares a UV space.
    pub(super) fn with_terms(&self, terms: &Terms) -> Self {
        Self {
            group_by: self.group_by.or(Some(terms.group_by)),
            separate_nodes: self.separate_nodes || self.group_by.is_none() && terms.separate_nodes,
            padding: self.padding.or(terms.padding),
            resolution: self.resolution.or(Some(terms.resolution)),
            pages: self.pages.or(terms.pages),
            mips: self.mips.or(Some(terms.mips)),
            aligned: self.aligned || terms.aligned,
            bits: self.bits.or(terms.bits),
            ..self.clone()
        }
    }
}

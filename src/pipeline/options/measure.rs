//! What of a document is measured.

use super::layout::check_mips;
use super::{Caller, CommandOptions, Layout, Workers};
use crate::certificate::{Claims, Overlap, Padding};
use crate::document::{GroupBy, Terms};
use crate::mesh::Resolution;
use crate::options::{OptionSet, options};
use crate::pipeline::PipelineError;
use crate::pipeline::documents::nodes::Nodes;

options! {
    /// Which UVs of a document are measured or verified. What is absent is what the file says that
    /// its UVs were written for.
    pub struct MeasureOptions {
        /// The UV set. If absent it is the one that the file says was written, and what else is
        /// absent is what it was written for; set 0 of a file that says nothing, or whose UVs were
        /// changed since.
        pub texcoord: Option<u32>, value "N";
        /// What shares one atlas; if absent what the file says, else each mesh has its own.
        pub group_by: Option<GroupBy>;
        /// Judge what each node shows of a mesh by itself, where it is in the scene: nodes that
        /// show one mesh show the same UVs.
        pub separate_nodes: bool;
        /// Least distance of two charts to prove, in texels of the coarsest of the mip levels that
        /// count; not judged if absent.
        pub padding: Option<u32>, in 0..=8192, value "TEXELS";
        /// The texture that `padding` is counted in, and texels per unit: texels along its side, or
        /// along both; 1024 texels square if absent.
        pub resolution: Option<Resolution>, value "N|WxH";
        /// Prove that each chart lies on one of so many pages side by side, the tiles of UDIM from
        /// 1001 on; not judged if absent.
        pub pages: Option<u32>, in 1..=10, value "N";
        /// Mip levels beyond the first in which charts are to keep the padding; none if absent.
        pub mips: Option<u32>, in 0..=12, value "N";
        /// Prove that the bounding rectangles of charts end where texels of `resolution` end.
        pub aligned: bool;
        /// Bits b at which to prove that the map stays bijective however each coordinate moves by
        /// up to 1/(2(2ᵇ−1)) + 2⁻¹⁶.
        pub bits: Option<u32>, in 8..=16, value "B";
    }
    groups {
        /// What works.
        pub workers: Workers;
    }
    untold {
        /// What the code that measures says.
        pub caller: Caller;
    }
}

impl CommandOptions for MeasureOptions {
    fn check(&self) -> Result<(), PipelineError> {
        let (padding, mips) = (self.padding.unwrap_or(0), self.mips.unwrap_or(0));
        (self.check_ranges())
            .and_then(|()| check_mips(padding, mips, self.resolution()))
            .map_err(PipelineError::InvalidOptions)
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

impl MeasureOptions {
    /// The texture that is judged.
    pub(in crate::pipeline) fn resolution(&self) -> Resolution {
        self.resolution.unwrap_or(Layout::default().resolution)
    }

    /// What shares one UV space, and what counts as a surface.
    pub(in crate::pipeline) fn spaces(&self) -> (GroupBy, Nodes) {
        let nodes = if self.separate_nodes {
            Nodes::Separate
        } else {
            Nodes::Shared
        };
        (self.group_by.unwrap_or_default(), nodes)
    }

    /// What the certificate is asked to speak of.
    pub(in crate::pipeline) fn claims(&self, overlap: Overlap) -> Claims {
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

    /// With what the UVs of a file were made for where these options say nothing. Surfaces are
    /// those of the options where these say what shares a UV space.
    pub(in crate::pipeline) fn with_terms(&self, terms: &Terms) -> Self {
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

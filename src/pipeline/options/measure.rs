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
    /// Which UVs of a document to measure or verify. Absent options take the values that the file
    /// records.
    pub struct MeasureOptions {
        /// The UV set. By default the file tells: unwrapd records the set it wrote and its options.
        /// Without such a record, or if the UVs changed since, it is set 0.
        pub texcoord: Option<u32>, value "N";
        /// What shares an atlas. The default is what the file records, otherwise one atlas per
        /// mesh.
        pub group_by: Option<GroupBy>;
        /// Judge each node that shows a mesh separately, with its transform in the scene. Nodes
        /// that share a mesh share its UVs.
        pub separate_nodes: bool;
        /// Prove this minimum distance between charts, in texels of the coarsest mip level that
        /// counts. Not judged by default.
        pub padding: Option<u32>, in 0..=8192, value "TEXELS";
        /// Texture size that `padding` and texel densities refer to: the side in texels, or width
        /// and height. The default is 1024.
        pub resolution: Option<Resolution>, value "N|WxH";
        /// Prove that each chart lies on one of this many pages side by side, the UDIM tiles from
        /// 1001 on. Not judged by default.
        pub pages: Option<u32>, in 1..=10, value "N";
        /// Number of mip levels beyond the first in which charts must keep the padding. The default
        /// is 0.
        pub mips: Option<u32>, in 0..=12, value "N";
        /// Prove that the bounding rectangle of every chart ends on texel borders of `resolution`.
        pub aligned: bool;
        /// Prove that the map stays bijective when texture coordinates are rounded to b bits: when
        /// each moves by up to 1/(2(2ᵇ−1)) + 2⁻¹⁶.
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

//! Options of measurement.

use super::unwrap::Nodes;
use super::{Caller, CommandOptions, Layout, Workers};
use crate::PipelineError;
#[cfg(feature = "schema")]
use crate::settings::padding_texels;
use crate::settings::{check_mips, check_texels};
use unwrapd_api::options::{OptionSet, options};
use unwrapd_files::document::{Document, GroupBy, Terms};
use unwrapd_maps::certificate::{Claims, Overlap, Padding};
use unwrapd_maps::mesh::Resolution;

options! {
    /// Which UVs of a document to measure or verify. A record that unwrapd left in the file names
    /// the UV set and adds what was promised of it; it never takes anything out of the judgment.
    pub struct MeasureOptions {
        /// The UV set. By default the file tells: unwrapd records the set it wrote and its options.
        /// Without such a record, or if the UVs changed since, it is set 0.
        pub texcoord: Option<u32>, value "N";
        /// Parts of the document that share an atlas. By default, the file's materials decide, as
        /// for `unwrap`: one atlas per material, and a mesh without a material has its own; an OBJ,
        /// OFF, PLY or STL is one atlas.
        pub group_by: Option<GroupBy>;
        /// Judge each node that shows a mesh separately, with its transform in the scene. Nodes
        /// that share a mesh share its UVs.
        pub separate_nodes: bool;
        /// Leave out primitives that lack the UV set, and faces of an OBJ without UVs, and count
        /// them. By default such a file is refused.
        pub skip_missing: bool;
        /// Prove this minimum distance between charts, in texels of the coarsest mip level that
        /// counts. The default is what the file records, otherwise nothing.
        pub padding: Option<u32>, in 0..=8192, value "TEXELS", arg(value_parser = padding_texels);
        /// Texture size that `padding`, `aligned` and texel densities refer to: the side in texels,
        /// or width and height. The default is what the file records, unless `padding` or `aligned`
        /// is given; otherwise 1024.
        pub resolution: Option<Resolution>, value "N|WxH";
        /// Prove that each chart lies on one of this many pages side by side, the UDIM tiles from
        /// 1001 on. The default is what the file records, otherwise nothing.
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
        /// Number of threads.
        pub workers: Workers;
    }
    untold {
        /// Settings of the caller.
        pub caller: Caller;
    }
}

impl CommandOptions for MeasureOptions {
    fn check(&self) -> Result<(), PipelineError> {
        let (padding, mips) = (self.padding.unwrap_or(0), self.mips.unwrap_or(0));
        // Before the ranges: that of the padding depends on the resolution.
        check_texels(self.resolution(), padding)
            .and_then(|()| self.check_ranges())
            .and_then(|()| check_mips(padding, mips, self.resolution()))
            .map_err(PipelineError::InvalidOptions)
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

impl MeasureOptions {
    /// Returns the texture in whose texels UVs are judged.
    pub(crate) fn resolution(&self) -> Resolution {
        self.resolution.unwrap_or(Layout::default().resolution)
    }

    /// Returns the grouping into UV spaces, and the definition of surfaces.
    pub(crate) fn spaces(&self, document: &Document) -> (GroupBy, Nodes) {
        let nodes = if self.separate_nodes {
            Nodes::Separate
        } else {
            Nodes::Shared
        };
        (self.group_by.unwrap_or(document.grouping()), nodes)
    }

    /// Returns the claims to certify.
    pub(crate) fn claims(&self, overlap: Overlap) -> Claims {
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

    /// Adds the requirements of a file's record. Distances in texels are one requirement: the options' replace the
    /// record's, so that a file cannot choose the texture in which a caller's padding is counted.
    pub(crate) fn with_terms(&self, terms: &Terms) -> Self {
        let mut required = Self {
            pages: self.pages.or(terms.pages),
            bits: self.bits.or(terms.bits),
            ..self.clone()
        };
        if self.padding.is_none() && !self.aligned {
            required.padding = terms.padding;
            required.resolution = self.resolution.or(Some(terms.resolution));
            required.mips = self.mips.or(Some(terms.mips));
            required.aligned = terms.aligned;
        }
        required
    }
}

// Options of verification.

options! {
    /// Options of verifying the UVs of a document.
    pub struct VerifyOptions {
        /// Also prove that no two faces overlap.
        pub bijective: bool;
        /// Also prove that no two faces overlap except in stacks: islands that coincide, so that they share their
        /// texels. What is accepted is said first. Without it, stacked islands count as overlaps.
        pub stacks: bool;
        /// Also prove that no chart is mirrored.
        pub unmirrored: bool;
    }
    groups {
        /// The UVs to judge, and further properties to prove.
        pub judged: MeasureOptions;
    }
}

impl CommandOptions for VerifyOptions {
    fn check(&self) -> Result<(), PipelineError> {
        self.judged.check()
    }

    fn caller_mut(&mut self) -> &mut Caller {
        self.judged.caller_mut()
    }
}

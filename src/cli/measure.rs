//! `unwrapd measure`: what existing UVs are worth.

use std::path::PathBuf;

use super::console::{print_json, warn};
use super::failure::Failure;
use super::input::read_upload;
use super::words::{GROUPS, word};
use crate::certificate::Certificate;
use crate::document::GroupBy;
use crate::mesh::Resolution;
use crate::pipeline::{self, MeasureOptions};

/// Which UVs of a file, and what is judged of them.
#[derive(clap::Args)]
pub(super) struct Which {
    /// Mesh with UVs: .glb, .gltf or .obj; `-` is standard input
    #[arg(value_name = "IN")]
    pub(super) input: PathBuf,
    /// UV set [default: the one that the file says was written, judged by what it says it was written for; else 0]
    #[arg(long, value_name = "N")]
    texcoord: Option<u32>,
    /// What shares one atlas [default: what the file says, else mesh]
    #[arg(long, value_parser = word::<GroupBy>(GROUPS))]
    group_by: Option<GroupBy>,
    /// Judge what each node shows by itself, where it is in the scene: nodes that show one mesh show the same UVs
    #[arg(long)]
    separate_nodes: bool,
    /// Least distance of two charts to prove, in texels
    #[arg(long, value_name = "TEXELS")]
    padding: Option<u32>,
    /// Texels along the side of the texture that the padding is counted in, or along both [default: what the file says, else 1024]
    #[arg(long, value_name = "N|WxH")]
    resolution: Option<Resolution>,
    /// Prove that each chart lies on one of so many pages side by side
    #[arg(long, value_name = "N")]
    pages: Option<u32>,
    /// Mip levels beyond the first in which to prove the padding, in texels of each [default: what the file says, else 0]
    #[arg(long, value_name = "N")]
    mips: Option<u32>,
    /// Prove that the bounding rectangles of charts end where texels end
    #[arg(long)]
    aligned: bool,
    /// Bits b at which to prove that the map stays bijective: however each coordinate moves by up to 1/(2(2ᵇ−1)) + 2⁻¹⁶
    #[arg(long, value_name = "B")]
    bits: Option<u32>,
}

impl Which {
    pub(super) fn options(&self) -> MeasureOptions {
        MeasureOptions {
            texcoord: self.texcoord,
            group_by: self.group_by,
            separate_nodes: self.separate_nodes,
            mips: self.mips,
            aligned: self.aligned,
            padding: self.padding,
            resolution: self.resolution,
            pages: self.pages,
            bits: self.bits,
            ..MeasureOptions::default()
        }
    }
}

/// Measures the UVs of a file: distortion, seams, packing, overlaps.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    which: Which,
    /// Print the whole report as JSON
    #[arg(long)]
    json: bool,
}

/// Runs `measure`.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let upload = read_upload(&args.which.input)?;
    let report = pipeline::measure_document(&upload, &args.which.options())?;
    if args.json {
        print_json(&report)?;
    } else {
        super::table::print(&report.groups);
        warn(&report.warnings);
    }
    Ok(())
}

/// Faces and faults.
pub(super) fn certificate_text(certificate: &Certificate) -> String {
    let overlap = certificate
        .overlapping_pairs
        .map_or(String::new(), |n| format!(", {n} overlapping pairs"));
    format!(
        "{} faces ({} exempt), {} flipped, {} degenerate{overlap}",
        certificate.faces, certificate.exempt_faces, certificate.flipped, certificate.degenerate
    )
}

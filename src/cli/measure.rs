//! `unwrapd measure`: what existing UVs are worth.

use std::path::PathBuf;

use super::console::{print_json, say, warn};
use super::failure::Failure;
use super::input::read_upload;
use super::words::{GROUPS, word};
use crate::certificate::{Certificate, Resolution};
use crate::document::GroupBy;
use crate::measure::Page;
use crate::pipeline::{self, GroupReport, MeasureOptions};

/// Which UVs of a file, and what is judged of them.
#[derive(clap::Args)]
pub(super) struct Which {
    /// Mesh with UVs: .glb, .gltf or .obj; `-` is standard input
    #[arg(value_name = "IN")]
    pub(super) input: PathBuf,
    /// UV set
    #[arg(long, default_value_t = 0, value_name = "N")]
    texcoord: u32,
    /// What shares one atlas
    #[arg(long, default_value = "mesh", value_parser = word::<GroupBy>(GROUPS))]
    group_by: GroupBy,
    /// Judge what each node shows by itself, where it is in the scene: nodes that show one mesh show the same UVs
    #[arg(long)]
    separate_nodes: bool,
    /// Least distance of two charts to prove, in texels
    #[arg(long, value_name = "TEXELS")]
    padding: Option<u32>,
    /// Texels along the side of the texture that the padding is counted in, or along both
    #[arg(long, default_value = "1024", value_name = "N|WxH")]
    resolution: Resolution,
    /// Prove that each chart lies on one of so many pages side by side
    #[arg(long, value_name = "N")]
    pages: Option<u32>,
    /// Mip levels beyond the first in which to prove the padding, in texels of each
    #[arg(long, default_value_t = 0, value_name = "N")]
    mips: u32,
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
        report.groups.iter().for_each(print_group);
        warn(&report.warnings);
    }
    Ok(())
}

/// One line per atlas.
pub(super) fn print_group(group: &GroupReport) {
    let m = &group.measures;
    let number = |x: Option<f64>| x.map_or("-".into(), |x| format!("{x:.4}"));
    let packed = match m.packing.pack_unit {
        None if !m.pages.is_empty() => {
            let page = |page: &Page| format!("{} {:.4}", page.udim, page.fill);
            m.pages.iter().map(page).collect::<Vec<_>>().join(", ")
        }
        packed => number(packed),
    };
    say(format_args!(
        "{}: {} faces, {} charts, seam/√area {}, symmetric Dirichlet {}, packed {}, texels per unit {}; {}",
        group.name,
        m.size.faces,
        m.seams.charts,
        number(m.seams.seam_over_sqrt_area),
        number(m.distortion.sym_dirichlet_mean),
        packed,
        number(group.texels_per_unit),
        certificate_text(&group.certificate)
    ));
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

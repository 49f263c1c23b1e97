//! `unwrapd measure` and `unwrapd verify`: what existing UVs are worth.

use std::path::PathBuf;

use super::failure::Failure;
use super::files::{json, read_upload, say};
use super::words::{GROUPS, word};
use crate::certificate::{Certificate, Overlap};
use crate::document::GroupBy;
use crate::pipeline::{self, GroupReport, MeasureOptions};

/// Which UVs of a file.
#[derive(clap::Args)]
struct Which {
    /// Mesh with UVs: .glb, .gltf or .obj
    input: PathBuf,
    /// UV set
    #[arg(long, default_value_t = 0, value_name = "N")]
    texcoord: u32,
    /// What shares one atlas
    #[arg(long, default_value = "mesh", value_parser = word::<GroupBy>(GROUPS))]
    group_by: GroupBy,
}

impl Which {
    fn options(&self) -> MeasureOptions {
        MeasureOptions {
            texcoord: self.texcoord,
            group_by: self.group_by,
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

/// Checks exactly that every face of a file's UVs is positive relative to its chart.
#[derive(clap::Args)]
pub(super) struct VerifyArgs {
    #[command(flatten)]
    which: Which,
    /// Also check that no face overlaps another
    #[arg(long)]
    bijective: bool,
}

/// Runs `measure`.
pub(super) fn measure(args: &Args) -> Result<(), Failure> {
    let upload = read_upload(&args.which.input)?;
    let report = pipeline::measure_document(&upload, &args.which.options())?;
    if args.json {
        say(format_args!("{}", String::from_utf8_lossy(&json(&report)?)));
    } else {
        report.groups.iter().for_each(print_group);
    }
    Ok(())
}

/// Runs `verify`; a file that does not hold ends with exit status 4.
pub(super) fn verify(args: &VerifyArgs) -> Result<(), Failure> {
    let upload = read_upload(&args.which.input)?;
    let overlap = if args.bijective {
        Overlap::Test
    } else {
        Overlap::Skip
    };
    let certificates = pipeline::verify_document(&upload, &args.which.options(), overlap)?;
    for (name, certificate) in &certificates {
        say(format_args!("{name}: {}", certificate_text(certificate)));
    }
    if certificates
        .iter()
        .all(|(_, certificate)| certificate.is_valid())
    {
        say(format_args!("valid"));
        Ok(())
    } else {
        Err(Failure::uncertified("not valid"))
    }
}

/// One line per atlas.
pub(super) fn print_group(group: &GroupReport) {
    let m = &group.measures;
    let number = |x: Option<f64>| x.map_or("-".into(), |x| format!("{x:.4}"));
    say(format_args!(
        "{}: {} faces, {} charts, seam/√area {}, symmetric Dirichlet {}, packed {}; {}",
        group.name,
        m.size.faces,
        m.seams.charts,
        number(m.seams.seam_over_sqrt_area),
        number(m.distortion.sym_dirichlet_mean),
        number(m.packing.pack_unit),
        certificate_text(&group.certificate)
    ));
}

fn certificate_text(certificate: &Certificate) -> String {
    let overlap = certificate
        .overlapping_pairs
        .map_or(String::new(), |n| format!(", {n} overlapping pairs"));
    format!(
        "{} faces ({} exempt), {} flipped, {} degenerate{overlap}",
        certificate.faces, certificate.exempt_faces, certificate.flipped, certificate.degenerate
    )
}

//! `unwrapd warp`: a picture pulled by handles.

use std::path::PathBuf;

use serde::Serialize;

use super::failure::Failure;
use super::files::{json, read_file, say, write_atomically};
use super::words::{BARRIERS, DEFORMATIONS, word};
use crate::barrier::BarrierKind;
use crate::deform::warp::{WarpOptions, parse_handles, warp_picture};
use crate::deform::{Boundary, DeformationEnergy, Model, PullReport};
use crate::picture::Image;
use crate::solver::{Control, Iterate};

/// Warps a picture by handles without folding it.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Picture: .png or .jpg
    input: PathBuf,
    /// Handles in pixels, y down: {"handles": [{"at": [x, y], "to": [x, y]}, …]}. Each takes hold of its own point; next to
    /// a fixed border of the nearest inner vertex of the grid, whose target is shifted by the same offset
    #[arg(long, value_name = "H.json")]
    handles: PathBuf,
    /// Where the warped picture goes, as PNG
    #[arg(short, long, value_name = "OUT.png")]
    output: PathBuf,
    /// Cells of the grid along the longer side
    #[arg(long, default_value_t = 40, value_name = "N")]
    grid: usize,
    /// Hold the border, so that the map is bijective; handles next to it take hold of inner vertices
    #[arg(long)]
    fix_border: bool,
    #[command(flatten)]
    model: ModelArgs,
    /// Write a JSON report: status, iterations, energy, residual, what is proven
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
}

/// What is minimized while vertices are pulled.
#[derive(clap::Args)]
pub(super) struct ModelArgs {
    /// Deformation energy
    #[arg(long, default_value = "arap", value_parser = word::<DeformationEnergy>(DEFORMATIONS))]
    energy: DeformationEnergy,
    /// Barrier against inversion; `none` is for comparison
    #[arg(long, default_value = "inverse-spline", value_parser = word::<BarrierKind>(BARRIERS))]
    barrier: BarrierKind,
    /// Weight β of the barrier [default: the paper's for the energy]
    #[arg(long)]
    beta: Option<f64>,
}

impl ModelArgs {
    pub(super) fn model(&self) -> Model {
        Model {
            energy: self.energy,
            barrier: self.barrier,
            beta: self.beta,
            ..Model::default()
        }
    }
}

#[derive(Serialize)]
struct Report {
    /// Where the upper left corner of the result lies, in pixels of the original.
    origin: [i64; 2],
    #[serde(flatten)]
    map: PullReport,
}

/// Runs `warp`; exit 4 if the map has an inverted triangle, or with a fixed border is not bijective.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let options = WarpOptions {
        grid: args.grid,
        boundary: if args.fix_border {
            Boundary::Fixed
        } else {
            Boundary::Free
        },
        model: args.model.model(),
    };
    let image = Image::decode(&read_file(&args.input)?)?;
    let handles = parse_handles(&read_file(&args.handles)?)?;
    let warp = warp_picture(&image, &handles, &options, &|_: &Iterate| Control::Continue)?;
    write_atomically(&args.output, &warp.picture.image.png())?;
    if let Some(path) = &args.report {
        let report = Report {
            origin: warp.picture.origin,
            map: warp.report.clone(),
        };
        write_atomically(path, &json(&report)?)?;
    }
    print_pull(&warp.report);
    let is_proven = match options.boundary {
        Boundary::Free => warp.report.certificate.is_valid(),
        Boundary::Fixed => warp.report.bijective,
    };
    if is_proven {
        Ok(())
    } else {
        Err(Failure::uncertified("the map is not valid"))
    }
}

/// One line about a map.
pub(super) fn print_pull(report: &PullReport) {
    say(format_args!(
        "{:?}: {} iterations, {} factorizations, energy {:.6e}, residual {:.1e}, {} inverted, {}",
        report.status,
        report.iterations,
        report.factorizations,
        report.energy,
        report.residual,
        report.certificate.inverted,
        if report.bijective {
            "bijective"
        } else {
            "not bijective"
        }
    ));
}

//! `unwrapd deform`: a mesh, a picture or a drawing pulled by handles.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Deserialize;

use super::failure::Failure;
use super::files::read_file;
use super::solution::{Output, Records, solve_and_write};
use super::words::{BARRIERS, DEFORMATIONS, word};
use crate::barrier::BarrierKind;
use crate::deform::outline::{self, ImageSettings, MeshSettings, Resolution, SvgSettings};
use crate::deform::{Body, DeformationEnergy, Handle, Method, Model, Problem};
use crate::mesh::io::{ElementFormat, Elements};
use crate::picture::Image;

/// Deforms a planar or tetrahedral mesh by handles, no element inverted.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Mesh (.obj, .off, .msh, .mesh, .tet), or an outline to be meshed: PNG with transparency, SVG
    input: PathBuf,
    /// JSON: {"handles": [{"vertex": 0, "to": [x, y]}, {"at": [x, y], "to": …}, {"center": …, "radius": r, "to": …}]}
    #[arg(long, value_name = "FILE")]
    handles: PathBuf,
    /// Where the deformed mesh goes: .txt (positions, 17 digits), .obj, .off, .msh, .mesh, .tet or .vtu
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Deformation energy
    #[arg(long, default_value = "arap", value_parser = word::<DeformationEnergy>(DEFORMATIONS))]
    energy: DeformationEnergy,
    /// Barrier
    #[arg(long, default_value = "inverse-spline", value_parser = word::<BarrierKind>(BARRIERS))]
    barrier: BarrierKind,
    /// Strength of the barrier; by default the paper's, 100 for green and 0.01 for the others
    #[arg(long, value_name = "X")]
    beta: Option<f64>,
    /// Share of its rest size below which an element feels the inverse spline
    #[arg(long, default_value_t = 1.0, value_name = "X")]
    s: f64,
    /// Keep the conformal distortion of every triangle, its longest over its shortest stretch, below this; plane only
    #[arg(long, value_name = "K")]
    max_conformal: Option<f64>,
    /// About how many triangles an outline is filled with
    #[arg(long, default_value_t = 5000, value_name = "N")]
    triangles: usize,
    #[command(flatten)]
    records: Records,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HandleFile {
    handles: Vec<Handle>,
}

/// Runs `deform`.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let output = Output::of(&args.output)?;
    let clock = Instant::now();
    let mesh = read_mesh(&args.input, args.triangles)?;
    let handles: HandleFile = serde_json::from_slice(&read_file(&args.handles)?)
        .map_err(|error| Failure::input(format!("{}: {error}", args.handles.display())))?;
    let body = if mesh.tets.is_empty() {
        Body::from(&mesh.clone().into_planar_mesh()?)
    } else {
        Body::from(&mesh.clone().into_tet_mesh()?)
    };
    let model = Model {
        energy: args.energy,
        barrier: args.barrier,
        beta: args.beta,
        s: args.s,
        bound: args.max_conformal,
    };
    let problem = Problem::new(body, &handles.handles, &model)?;
    let setup_seconds = clock.elapsed().as_secs_f64();
    let target = (&output, args.output.as_path());
    solve_and_write(
        &problem,
        &mesh,
        Method::Projected,
        setup_seconds,
        target,
        &args.records,
    )
}

/// The mesh of a file, or of the outline in a picture or drawing.
fn read_mesh(path: &Path, triangles: usize) -> Result<Elements, Failure> {
    let bytes = read_file(path)?;
    let name = path.to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let outline = match extension.to_str() {
        Some("svg") => outline::of_svg(&String::from_utf8_lossy(&bytes), &SvgSettings::default())?,
        Some("png") => outline::of_image(&Image::decode(&bytes)?, &ImageSettings::default())?,
        _ => {
            let format = ElementFormat::of_name(&name)
                .ok_or_else(|| Failure::input(format!("{name}: not a format that is read")))?;
            return Ok(format.read(&bytes)?);
        }
    };
    let settings = MeshSettings {
        resolution: Resolution::Triangles(triangles),
        ..MeshSettings::default()
    };
    Ok(Elements::from(&outline::triangulate(&outline, &settings)?))
}

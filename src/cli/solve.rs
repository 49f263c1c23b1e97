//! `unwrapd solve`: a problem file of handles and targets.

use std::path::{Path, PathBuf};
use std::time::Instant;

use super::failure::Failure;
use super::files::read_file;
use super::solution::{Output, Records, solve_and_write};
use super::words::{METHODS, word};
use crate::deform::{Method, Problem, ProblemFile};
use crate::mesh::io::{ElementFormat, Elements};

/// Solves a problem file: handles pulled to targets, no element inverted.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem: JSON naming a mesh, handles, targets, an energy and a barrier; paths in it are relative to it
    problem: PathBuf,
    /// Where the map goes: .txt (positions, 17 digits), .obj, .off, .msh, .mesh, .tet or .vtu
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// How: projected Newton with advancing targets, or the paper's iteration
    #[arg(long, default_value = "projected", value_parser = word::<Method>(METHODS))]
    method: Method,
    #[command(flatten)]
    records: Records,
}

/// Runs `solve`.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let output = Output::of(&args.output)?;
    let clock = Instant::now();
    let (problem, mesh) = read(&args.problem)?;
    let setup_seconds = clock.elapsed().as_secs_f64();
    let target = (&output, args.output.as_path());
    solve_and_write(
        &problem,
        &mesh,
        args.method,
        setup_seconds,
        target,
        &args.records,
    )
}

/// The problem and the mesh that its file names.
fn read(path: &Path) -> Result<(Problem, Elements), Failure> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let file = ProblemFile::parse(&read_file(path)?)?;
    let format = ElementFormat::of_name(&file.mesh)
        .ok_or_else(|| Failure::input(format!("{}: not a mesh format that is read", file.mesh)))?;
    let mesh = format.read(&read_file(&folder.join(&file.mesh))?)?;
    let start = file.initial.as_ref().map(|initial| {
        let bytes = read_file(&folder.join(initial))?;
        numbers(&bytes).ok_or_else(|| Failure::input(format!("{initial}: not numbers")))
    });
    let problem = file.with(mesh.clone(), start.transpose()?)?;
    Ok((problem, mesh))
}

/// Numbers separated by blanks.
fn numbers(bytes: &[u8]) -> Option<Vec<f64>> {
    let text = std::str::from_utf8(bytes).ok()?;
    text.split_ascii_whitespace()
        .map(|word| word.parse().ok())
        .collect()
}

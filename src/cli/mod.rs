//! Commands: each subcommand is one file that fills settings structs and calls the library.
//!
//! Exit codes: 0 done; 2 usage; 3 the input cannot be used; 4 not certified (with a file), or no valid result within the limits
//! (without one); 1 anything else.

mod deform;
mod edit_uv;
mod failure;
mod files;
mod health;
mod listen;
mod measure;
mod model;
mod progress;
mod records;
mod repack;
mod serve;
mod solve;
mod table;
mod unwrap;
mod verify;
mod warp;
mod words;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use failure::Failure;

/// Unwraps meshes: glTF in, certified flip-free UVs and a distortion report out.
#[derive(Parser)]
#[command(version, about, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Give a mesh UVs in which no triangle is flipped or degenerate
    Unwrap(Box<unwrap::Args>),
    /// Measure the UVs of a file: distortion, seams, packing, overlaps
    Measure(measure::Args),
    /// Check exactly that no face of a file's UVs is flipped or degenerate, and what else is asked for: exit 0 if so, 4 if not
    Verify(verify::Args),
    /// Pull a mesh, a picture's outline, a drawing or surfaces in a cage by handles, no element inverted
    Deform(Box<deform::Args>),
    /// Solve a problem file: handles pulled to targets, no element inverted
    Solve(solve::Args),
    /// Warp a picture by handles without folding it
    Warp(warp::Args),
    /// Pack the UV islands of all meshes into one atlas, each as it is
    Repack(repack::Args),
    /// Move anchors of a file's UVs, no face flipped
    EditUv(edit_uv::EditArgs),
    /// Align points of a surface with points of a texture, no face flipped
    TextureMap(edit_uv::TextureArgs),
    /// Run the HTTP service
    Serve(Box<serve::Args>),
    /// Print the OpenAPI document of the service
    Openapi,
    /// Ask a running service whether it is ready: exit 0 if so, 1 if not
    Health(health::Args),
    /// Run one job of the service: started by `serve`, not by hand
    #[command(hide = true)]
    Compute {
        /// The folder of the attempt: input and `job.json` in it, results are written into it.
        folder: PathBuf,
    },
}

/// Runs the command line of this process and returns its exit code.
pub fn run() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Unwrap(args) => unwrap::run(&args),
        Command::Measure(args) => measure::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Deform(args) => deform::run(&args),
        Command::Solve(args) => solve::run(&args),
        Command::Warp(args) => warp::run(&args),
        Command::Repack(args) => repack::run(&args),
        Command::EditUv(args) => edit_uv::edit(&args),
        Command::TextureMap(args) => edit_uv::texture_map(&args),
        Command::Serve(args) => serve::run(&args).map_err(Failure::other),
        Command::Openapi => {
            files::say(crate::http::openapi());
            Ok(())
        }
        Command::Health(args) => health::run(&args).map_err(Failure::other),
        Command::Compute { folder } => return crate::jobs::compute::run(&folder),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

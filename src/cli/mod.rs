//! Commands: each subcommand is one file that fills settings structs and calls the library.
//!
//! Exit codes: 0 done; 2 usage; 3 the input cannot be used; 4 not certified or no valid result within the limits;
//! 1 anything else.

mod health;
mod serve;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Unwraps meshes: glTF in, certified flip-free UVs and a distortion report out.
#[derive(Parser)]
#[command(version, about, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
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
    match Cli::parse().command {
        Command::Serve(args) => report(serve::run(&args)),
        Command::Openapi => {
            println!("{}", crate::http::openapi());
            ExitCode::SUCCESS
        }
        Command::Health(args) => report(health::run(&args)),
        Command::Compute { folder } => crate::jobs::compute::run(&folder),
    }
}

/// Prints an error as one line; anything not said otherwise exits with 1.
fn report(result: Result<(), String>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("unwrapd: {message}");
            ExitCode::FAILURE
        }
    }
}

//! The commands: each subcommand is one file that fills settings structs and calls the library.
//!
//! Exit statuses: 0 success; 2 usage error; 3 unusable input; 4 not certified (with a file), or no
//! valid result within the limits (without one); 5 targets that cannot be reached (with a file);
//! 6 ended early (with a file); 7 partly done (with a file); 1 any other error.
//!
//! Before the work starts, the library checks the options, and `output` checks that every file can
//! be written. Each input is opened once (`input`).
#![doc = include_str!("guide.md")]

mod acceptance;
mod batch;
mod bulk_args;
mod bulk_display;
mod check;
mod command;
mod completions;
mod config;
mod console;
mod deform;
mod drain;
mod edit_uv;
mod escaping;
mod exposure_args;
mod failure;
mod format;
mod health;
mod input;
mod keys;
mod listen;
mod local_call;
mod man;
mod measure;
mod output;
mod owner_args;
mod process;
mod progress;
mod queue;
mod records;
mod repack;
mod serve;
mod solve;
mod store_args;
mod submit;
mod table;
mod unwrap;
mod unwrap_args;
mod verify;
mod warp;
mod watch_args;
mod webhook_args;
mod webhook_secret;
mod work_args;
mod worker;

use std::ffi::OsString;
use std::path::Path;

use clap::ArgMatches;
use command::Command;
use failure::Failure;

use unwrapd_server::jobs::Program;

/// Runs a command line, which begins with the name of the program, and returns the exit code of the process. Children
/// are instances of `program`.
///
/// Exits the process on a usage error, and after printing help.
pub fn run(arguments: Vec<OsString>, program: std::io::Result<Program>) -> u8 {
    // Commands of child processes, each with its folder: `compute` is one job, `draw` one picture of a result,
    // `session` one live session. They are left out of help, suggestions and completions.
    if let [_, word, folder, ..] = &arguments[..] {
        if word == "compute" {
            return unwrapd_worker::compute(Path::new(folder));
        }
        if word == "draw" {
            return unwrapd_worker::draw(Path::new(folder));
        }
        if word == "session" {
            return unwrapd_worker::session::run(Path::new(folder));
        }
    }
    let (command, typed) = command::typed(arguments);
    match run_typed(command, &typed, program) {
        Ok(()) => 0,
        Err(failure) => failure.of_input(input(&typed).as_deref()).report(),
    }
}

/// Returns the name of the file that a command reads, if it reads one.
fn input(typed: &ArgMatches) -> Option<String> {
    let mut given = typed.try_get_raw("input").ok()??;
    Some(given.next()?.to_string_lossy().into_owned())
}

fn run_typed(
    command: Command,
    typed: &ArgMatches,
    program: std::io::Result<Program>,
) -> Result<(), Failure> {
    match command {
        Command::Unwrap(args) => unwrap::run(&args),
        Command::Measure(args) => measure::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Repack(args) => repack::run(&args),
        Command::EditUv(args) => edit_uv::edit(&args),
        Command::TextureMap(args) => edit_uv::texture_map(&args),
        Command::Deform(args) => deform::run(&args),
        Command::Solve(args) => solve::run(&args),
        Command::Warp(args) => warp::run(&args),
        Command::Batch(args) => batch::run(&args, own(program)?),
        Command::Submit(args) => submit::run(&args),
        Command::Serve(args) => serve::run(&args, own(program)?).map_err(Failure::other),
        Command::Worker(args) => worker::run(&args, own(program)?).map_err(Failure::other),
        Command::Keys(args) => keys::run(&args),
        Command::Queue(args) => queue::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Drain(args) => drain::run(&args),
        Command::WebhookSecret(args) => webhook_secret::run(&args),
        Command::Config(args) => config::run(&args, &command::command(), typed),
        Command::Openapi => {
            console::print(unwrapd_server::http::openapi(&unwrapd_worker::Computations));
            Ok(())
        }
        Command::Health(args) => health::run(&args).map_err(Failure::other),
        Command::Completions(args) => {
            completions::run(&args, command::command());
            Ok(())
        }
        Command::Man(args) => man::run(&args, command::command()),
    }
}

/// Returns the program of children.
fn own(program: std::io::Result<Program>) -> Result<Program, Failure> {
    program.map_err(|error| Failure::other(format!("no children can be started: {error}")))
}

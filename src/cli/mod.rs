//! The commands: each file has one subcommand, or several that are alike, which fill settings structs and call the library.
//!
//! Exit statuses: 0 success; 2 usage error; 3 unusable input; 4 not certified (with a file), or no
//! valid result within the limits (without one); 5 targets that cannot be reached (with a file);
//! 6 ended early (with a file); 7 partly done (with a file); 1 any other error.
//!
//! Before the work starts, the library checks the options, and `files` checks that every file can
//! be written. Each input is opened once.
#![doc = include_str!("guide.md")]

mod batch;
mod check;
mod command;
mod config;
mod console;
mod deform;
mod drain;
mod edit_uv;
mod files;
mod keys;
mod measure;
mod process;
mod progress;
mod queue;
mod serve;
mod store_args;
mod untangle;
mod unwrap;
mod webhook;
mod worker;

use std::ffi::OsString;
use std::path::Path;

use clap::ArgMatches;
use command::CliCommand;
use console::CommandFailure;

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
    command: CliCommand,
    typed: &ArgMatches,
    program: std::io::Result<Program>,
) -> Result<(), CommandFailure> {
    match command {
        CliCommand::Unwrap(args) => unwrap::run(&args),
        CliCommand::Measure(args) => measure::run(&args),
        CliCommand::Verify(args) => measure::verify(&args),
        CliCommand::Repack(args) => unwrap::repack(&args),
        CliCommand::EditUv(args) => edit_uv::edit(&args),
        CliCommand::TextureMap(args) => edit_uv::texture_map(&args),
        CliCommand::Deform(args) => deform::run(&args),
        CliCommand::Solve(args) => deform::solve(&args),
        CliCommand::Untangle(args) => untangle::run(&args),
        CliCommand::Warp(args) => deform::warp(&args),
        CliCommand::Batch(args) => batch::run(&args, own(program)?),
        CliCommand::Submit(args) => batch::submit(&args),
        CliCommand::Serve(args) => serve::run(&args, own(program)?).map_err(CommandFailure::other),
        CliCommand::Worker(args) => {
            worker::run(&args, own(program)?).map_err(CommandFailure::other)
        }
        CliCommand::Keys(args) => keys::run(&args),
        CliCommand::Queue(args) => queue::run(&args),
        CliCommand::Check(args) => check::run(&args),
        CliCommand::Drain(args) => drain::run(&args),
        CliCommand::WebhookSecret(args) => webhook::print_secret(&args),
        CliCommand::Config(args) => config::run(&args, &command::command(), typed),
        CliCommand::Openapi => {
            console::print(unwrapd_server::http::openapi(&unwrapd_worker::Computations));
            Ok(())
        }
        CliCommand::Health(args) => drain::health(&args).map_err(CommandFailure::other),
        CliCommand::Completions(args) => {
            command::print_completions(&args, command::command());
            Ok(())
        }
        CliCommand::Man(args) => command::print_manual(&args, command::command()),
    }
}

/// Returns the program of children.
fn own(program: std::io::Result<Program>) -> Result<Program, CommandFailure> {
    program.map_err(|error| CommandFailure::other(format!("no children can be started: {error}")))
}

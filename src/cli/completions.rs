//! `unwrapd completions`: scripts for shells.

use std::io;

use clap_complete::Shell;

use super::command::command;

/// Prints a completion script for a shell.
#[derive(clap::Args)]
pub(super) struct Args {
    /// The shell
    shell: Shell,
}

/// Runs `completions`.
pub(super) fn run(args: &Args) {
    clap_complete::generate(args.shell, &mut command(), "unwrapd", &mut io::stdout());
}

//! `unwrapd completions`: scripts for shells.

use std::io;

use clap_complete::Shell;

/// Prints what makes a shell complete commands and options.
#[derive(clap::Args)]
pub(super) struct Args {
    /// The shell
    shell: Shell,
}

/// Runs `completions` of a program.
pub(super) fn run(args: &Args, mut program: clap::Command) {
    clap_complete::generate(args.shell, &mut program, "unwrapd", &mut io::stdout());
}

//! `unwrapd completions`: shell completion scripts.

use std::io::{self, Write};

use clap_complete::Shell;

/// Prints a completion script for a shell.
#[derive(clap::Args)]
pub(super) struct Args {
    /// The shell
    shell: Shell,
}

/// Runs `completions` of a program.
pub(super) fn run(args: &Args, mut program: clap::Command) {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut program, "unwrapd", &mut script);
    // The reader may have closed the pipe, as with any output.
    let _ = io::stdout().write_all(&script);
}

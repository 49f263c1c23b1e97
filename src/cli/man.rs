//! `unwrapd man`: manual pages.

use std::io::{self, Write};

use clap_mangen::Man;

use super::failure::Failure;

/// Prints the manual page of the program or of a command.
#[derive(clap::Args)]
pub(super) struct Args {
    /// The command [default: the manual page of the program, which lists all commands]
    command: Option<String>,
}

/// Runs `man` of a program.
pub(super) fn run(args: &Args, mut program: clap::Command) -> Result<(), Failure> {
    program.build();
    let page = match &args.command {
        None => &program,
        Some(name) => program
            .find_subcommand(name)
            .ok_or_else(|| Failure::usage(format!("unknown command {name}: see unwrapd --help")))?,
    };
    let mut text = Vec::new();
    let rendered = Man::new(page.clone()).render(&mut text);
    rendered.map_err(|error| Failure::other(error.to_string()))?;
    // The reader may have closed the pipe, as with any output.
    let _ = io::stdout().write_all(&text);
    Ok(())
}

//! The `unwrapd` binary: everything is in the library's `cli` module.

use std::process::ExitCode;

use unwrapd::cli;
use unwrapd::jobs::Program;

/// Gives memory back to the system and reserves no address space, so that a memory limit means what it says.
#[cfg(feature = "jemalloc")]
#[global_allocator]
static ALLOCATOR: tikv_jemallocator::Jemalloc = tikv_jemallocator::Jemalloc;

fn main() -> ExitCode {
    cli::run(std::env::args_os().collect(), Program::current()).into()
}

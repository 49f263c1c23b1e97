//! The `unwrapd` binary: everything is in the library's `cli` module.

use std::process::ExitCode;

/// Gives memory back to the system and reserves no address space, so that a memory limit means what it says.
#[global_allocator]
static ALLOCATOR: tikv_jemallocator::Jemalloc = tikv_jemallocator::Jemalloc;

fn main() -> ExitCode {
    unwrapd::cli::run()
}

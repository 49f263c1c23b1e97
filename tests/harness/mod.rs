//! What tests and benchmarks of several processes share: the processes, the servers that they
//! need, faults, clients, and a judge.

pub mod children;
pub mod client;
pub mod clock;
pub mod crash;
pub mod disk;
pub mod fault;
pub mod history;
pub mod judge;
pub mod live;
pub mod machines;
pub mod memory;
pub mod ports;
pub mod postgres;
pub mod process;
pub mod proxy;
pub mod s3;
pub mod update;

use std::path::PathBuf;
use std::time::Duration;

/// For what must happen soon, on however busy a machine.
pub const SOON: Duration = Duration::from_mins(1);

/// The program: that of the same build, or the one that a variable names.
pub fn program() -> PathBuf {
    let named = std::env::var_os("UNWRAPD_PROGRAM");
    named.map_or_else(|| env!("CARGO_BIN_EXE_unwrapd").into(), PathBuf::from)
}

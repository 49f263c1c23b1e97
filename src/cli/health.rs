//! `unwrapd health`: the container's health check.

use super::local_call::Local;

/// The arguments of `health`.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    local: Local,
}

/// Requests `/readyz`; fails unless the service is ready.
pub(super) fn run(args: &Args) -> Result<(), String> {
    let answer = args.local.call("GET /readyz", None)?;
    if answer.is_ok() {
        return Ok(());
    }
    let address = args.local.address()?;
    Err(format!("{address} is not ready: {}", answer.status_line))
}

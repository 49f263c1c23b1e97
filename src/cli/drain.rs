//! `unwrapd drain`: draining of a service before it is stopped.

use std::time::Duration;

use serde::Deserialize;

use super::console::print;
use super::failure::Failure;
use super::local_call::Local;

/// Interval between checks of running jobs. A longer interval delays the end of the command, a shorter one sends more
/// requests.
const PAUSE: Duration = Duration::from_millis(500);

/// The arguments of `drain`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Wait until no job runs in it
    #[arg(long, conflicts_with = "undo")]
    wait: bool,
    /// Have it take in and start jobs again
    #[arg(long)]
    undo: bool,
    /// API key with the scope admin, if the service asks for one
    #[arg(long, value_name = "KEY", env = "UNWRAPD_KEY", hide_env_values = true)]
    key: Option<String>,
    #[command(flatten)]
    local: Local,
}

/// Part of the response that is read.
#[derive(Deserialize)]
struct DrainAnswer {
    draining: bool,
    running: usize,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let method = if args.undo { "DELETE" } else { "PUT" };
    let mut drain = call(args, method)?;
    while args.wait && 0 < drain.running {
        std::thread::sleep(PAUSE);
        drain = call(args, "GET")?;
        if !drain.draining {
            return Err(Failure::other("somebody ended the draining"));
        }
    }
    let state = if drain.draining {
        "draining"
    } else {
        "accepting"
    };
    print(format!("{state}\t{} running", drain.running));
    Ok(())
}

fn call(args: &Args, method: &str) -> Result<DrainAnswer, Failure> {
    let answer = args
        .local
        .call(&format!("{method} /v1/drain"), args.key.as_deref());
    let answer = answer.map_err(Failure::other)?;
    if !answer.is_ok() {
        return Err(Failure::other(format!("refused: {}", answer.body)));
    }
    let drain = serde_json::from_str(&answer.body);
    drain.map_err(|error| Failure::other(format!("the answer is not that of a service: {error}")))
}

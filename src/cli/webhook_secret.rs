//! `unwrapd webhook-secret`: the secret with which an owner verifies deliveries.

use super::console::print;
use super::failure::Failure;
use unwrapd_server::jobs::access::Owner;
use unwrapd_server::webhooks::Secrets;

/// The arguments of `webhook-secret`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Owner of the jobs [default: that of jobs made without a key]
    #[arg(long, value_name = "NAME")]
    owner: Option<Owner>,
    /// Secret of the service
    #[arg(
        long,
        value_name = "SECRET",
        env = "UNWRAPD_WEBHOOK_SECRET",
        hide_env_values = true
    )]
    webhook_secret: Secrets,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let owner = args.owner.clone().unwrap_or_default();
    let secret = args.webhook_secret.present();
    let secret = secret.ok_or_else(|| Failure::usage("there is no secret"))?;
    print(secret.told_to(&owner));
    Ok(())
}

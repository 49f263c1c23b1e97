//! Webhooks: arguments of `serve`, and `unwrapd webhook-secret`.

use clap::builder::BoolishValueParser;

use super::console::{CommandFailure, print};
use unwrapd_server::jobs::access::Owner;
use unwrapd_server::webhooks::{DeliverySettings, Reachable, Secrets};

/// Webhooks that announce the ends of jobs.
#[derive(clap::Args)]
#[command(next_help_heading = "Webhooks")]
pub(super) struct WebhookArgs {
    /// Secret of the service, at least 24 characters, from which `unwrapd webhook-secret` derives that
    /// of each owner. Without it, jobs with a webhook are refused. While one is replaced: NEW,OLD
    #[arg(
        long,
        value_name = "SECRET",
        env = "UNWRAPD_WEBHOOK_SECRET",
        hide_env_values = true
    )]
    pub(super) webhook_secret: Option<Secrets>,
    /// Deliver webhooks also to loopback and to private networks
    #[arg(
        long,
        env = "UNWRAPD_WEBHOOK_ALLOW_PRIVATE",
        value_parser = BoolishValueParser::new()
    )]
    webhook_allow_private: bool,
}

impl WebhookArgs {
    /// Returns the settings of deliveries; `None` without a secret.
    pub(super) fn settings(&self) -> Option<DeliverySettings> {
        Some(DeliverySettings {
            secrets: self.webhook_secret.clone()?,
            reachable: self.reachable(),
        })
    }

    fn reachable(&self) -> Reachable {
        if self.webhook_allow_private {
            Reachable::Any
        } else {
            Reachable::Public
        }
    }
}

// `unwrapd webhook-secret`: the secret with which an owner verifies deliveries.

/// The arguments of `webhook-secret`.
#[derive(clap::Args)]
pub(super) struct SecretArgs {
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
pub(super) fn print_secret(args: &SecretArgs) -> Result<(), CommandFailure> {
    let owner = args.owner.clone().unwrap_or_default();
    let secret = args.webhook_secret.present();
    let secret = secret.ok_or_else(|| CommandFailure::usage("there is no secret"))?;
    print(secret.told_to(&owner));
    Ok(())
}

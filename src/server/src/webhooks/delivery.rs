//! Delivery of notices, with retries.

use std::sync::Arc;
use std::time::Duration;

use metrics::{counter, describe_counter};
use reqwest::header::CONTENT_TYPE;
use reqwest::redirect::Policy;
use reqwest::{Client, StatusCode};
use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

use super::guard::{AddressGuard, Reachable, check};
use super::secret::Secrets;
use crate::jobs::{Notice, Outbox, Timestamp};

/// Interval between polls of the outbox. A longer interval delays notices; a shorter one queries the store more often.
const PAUSE: Duration = Duration::from_secs(1);
/// Maximum number of concurrent deliveries, so that a slow receiver does not delay others. Each holds a connection.
const TOGETHER: usize = 32;
/// Timeout of a receiver. Standard Webhooks recommends 15 to 30 s.
const PATIENCE: Duration = Duration::from_secs(15);
/// Lease of this process on a notice, four times the timeout. After a crash, a notice is delivered again this much
/// later.
const LEASE: Duration = Duration::from_mins(1);
/// Pauses before retries; after the last retry a notice is given up. They are the first seven of the example schedule
/// of Standard Webhooks.
const RETRIES: [Duration; 7] = [
    Duration::from_secs(5),
    Duration::from_mins(5),
    Duration::from_mins(30),
    Duration::from_hours(2),
    Duration::from_hours(5),
    Duration::from_hours(10),
    Duration::from_hours(14),
];

const DELIVERIES: &str = "unwrapd_webhook_deliveries_total";

/// Settings of deliveries.
#[derive(Clone, Debug)]
pub struct DeliverySettings {
    /// Secrets for signing.
    pub secrets: Secrets,
    /// Addresses that deliveries may go to.
    pub reachable: Reachable,
}

/// Delivers the notices of an outbox until told to stop.
pub async fn deliver(outbox: Arc<dyn Outbox>, settings: DeliverySettings, stop: CancellationToken) {
    describe_counter!(DELIVERIES, "Tries to deliver a webhook by this process");
    for result in ["delivered", "failed", "given_up"] {
        counter!(DELIVERIES, "result" => result).absolute(0);
    }
    // The call fails if another part of the process has chosen a provider already.
    let _ = rustls::crypto::ring::default_provider().install_default();
    // Build a client that follows no redirects, uses no proxy and resolves names with the guard.
    let client = Client::builder()
        .user_agent(concat!("unwrapd/", env!("CARGO_PKG_VERSION")))
        .redirect(Policy::none())
        .no_proxy()
        .timeout(PATIENCE)
        .dns_resolver(Arc::new(AddressGuard(settings.reachable)))
        .build();
    let client = match client {
        Ok(client) => client,
        Err(error) => return tracing::error!(%error, "no webhooks are delivered"),
    };
    let courier = Arc::new(Courier {
        outbox,
        settings,
        client,
    });
    // Take notices as delivery slots become free.
    let mut under_way = JoinSet::new();
    loop {
        let room = TOGETHER - under_way.len();
        match courier.outbox.take(room as u32, LEASE).await {
            Ok(notices) => {
                for notice in notices {
                    let courier = Arc::clone(&courier);
                    under_way.spawn(async move { courier.carry(&notice).await });
                }
            }
            Err(error) => tracing::warn!(%error, "webhooks not looked for"),
        }
        tokio::select! {
            // On a stop, notices under way are dropped; they are due again after their lease.
            () = tokio::time::sleep(PAUSE) => {}
            () = stop.cancelled() => return,
        }
        // Wait for a free slot.
        while under_way.try_join_next().is_some() {}
        if under_way.len() == TOGETHER {
            under_way.join_next().await;
        }
    }
}

struct Courier {
    outbox: Arc<dyn Outbox>,
    settings: DeliverySettings,
    client: Client,
}

/// Outcome of a delivery.
enum DeliveryAnswer {
    Heard,
    /// Reason for the failure.
    Unheard(String),
    /// The receiver wants no more notices of this job.
    Gone,
}

impl Courier {
    /// Delivers a notice, and settles it or schedules a retry.
    async fn carry(&self, notice: &Notice) {
        // Deliver, and choose what to do with the notice.
        let host = notice.webhook.url().host_str().unwrap_or_default();
        let (id, attempt) = (&*notice.id, notice.attempt);
        let retry = RETRIES.get(attempt.saturating_sub(1) as usize);
        let (result, settled) = match (self.post(notice).await, retry) {
            (DeliveryAnswer::Heard, _) => {
                tracing::info!(id, host, attempt, "webhook delivered");
                ("delivered", self.outbox.settle(id).await)
            }
            (DeliveryAnswer::Unheard(why), Some(&pause)) => {
                tracing::warn!(id, host, attempt, why, "webhook not delivered yet");
                ("failed", self.outbox.defer(id, pause).await)
            }
            (DeliveryAnswer::Unheard(why), None) => {
                tracing::error!(id, host, attempt, why, "webhook given up");
                ("given_up", self.outbox.settle(id).await)
            }
            (DeliveryAnswer::Gone, _) => {
                tracing::warn!(id, host, attempt, "webhook refused for good");
                ("given_up", self.outbox.settle(id).await)
            }
        };
        counter!(DELIVERIES, "result" => result).increment(1);
        // The notice is due again after its lease, and its receiver gets it twice.
        if let Err(error) = settled {
            tracing::warn!(id, %error, "delivery of a webhook not recorded");
        }
    }

    async fn post(&self, notice: &Notice) -> DeliveryAnswer {
        if let Err(refused) = check(&notice.webhook, self.settings.reachable) {
            return DeliveryAnswer::Unheard(refused.to_string());
        }
        let time = Timestamp::now().0.div_euclid(1000);
        let secrets = &self.settings.secrets;
        let signature = secrets.sign(&notice.owner, &notice.id, time, &notice.body);
        let request = self
            .client
            .post(notice.webhook.url().clone())
            .header(CONTENT_TYPE, "application/json")
            .header("webhook-id", &notice.id)
            .header("webhook-timestamp", time)
            .header("webhook-signature", signature)
            .body(notice.body.clone());
        match request.send().await {
            Ok(answer) if answer.status().is_success() => DeliveryAnswer::Heard,
            Ok(answer) if answer.status() == StatusCode::GONE => DeliveryAnswer::Gone,
            Ok(answer) => DeliveryAnswer::Unheard(format!("the answer is {}", answer.status())),
            Err(error) => DeliveryAnswer::Unheard(text(&error.without_url())),
        }
    }
}

/// Formats an error with its causes on one line. Callers remove URLs, which may contain secrets of the receiver.
fn text(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    let mut words: Vec<String> = causes.map(ToString::to_string).collect();
    words.dedup();
    words.join(": ")
}
